# Proves that `cmake --install` installs what a user needs and nothing else.
# build: the build folder; folder: where to install, with the prefix below it; expected: a file with
# the paths.
cmake_minimum_required(VERSION 3.22) # globbing then follows no links
file(REMOVE_RECURSE "${folder}")
set(ENV{DESTDIR} "${folder}")
execute_process(
  COMMAND "${CMAKE_COMMAND}" --install "${build}"
  OUTPUT_QUIET
  COMMAND_ERROR_IS_FATAL ANY)
# a link to a folder counts as a file
file(GLOB_RECURSE installed RELATIVE "${folder}${prefix}" "${folder}/*")
list(SORT installed)
file(STRINGS "${expected}" expected REGEX "^[^#]")
list(SORT expected)
if (NOT installed STREQUAL expected)
  list(JOIN installed "\n  " installed)
  list(JOIN expected "\n  " expected)
  message(FATAL_ERROR "Installed:\n  ${installed}\nExpected:\n  ${expected}")
endif ()
