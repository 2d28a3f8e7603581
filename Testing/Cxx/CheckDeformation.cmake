# Proves that the deformation core needs no VTK: its test program loads no library of VTK, its files
# include nothing but the core, Common without VTK, the solver's GLSL, GLM and the standard library,
# and it configures
# alone. Variables: program (of its tests), core (its folder), build (a folder for the last check),
# and generator, make and compiler of this build. No others need to be installed.
cmake_minimum_required(VERSION 3.22)

file(GET_RUNTIME_DEPENDENCIES
  EXECUTABLES "${program}"
  RESOLVED_DEPENDENCIES_VAR loaded
  UNRESOLVED_DEPENDENCIES_VAR missing)
foreach (library IN LISTS loaded missing)
  if (library MATCHES "[Vv][Tt][Kk]|[Pp]ara[Vv]iew")
    message(SEND_ERROR "${program} loads ${library}")
  endif ()
endforeach ()

set(allowed "\"Common/(Export|Grid|Numbers|Parallel|Problem)\\.h\"|\"Filters/Deformation/")
string(APPEND allowed "|\"Shaders/Field/inversion.glsl\"|<glm/|<[a-z_]+>")
file(GLOB sources "${core}/*.h" "${core}/*.cxx")
if (NOT sources)
  message(SEND_ERROR "${core} has no source files")
endif ()
foreach (source IN LISTS sources)
  file(STRINGS "${source}" includes REGEX "^#include")
  foreach (include IN LISTS includes)
    if (NOT include MATCHES "${allowed}")
      message(SEND_ERROR "${source} has ${include}")
    endif ()
  endforeach ()
endforeach ()

execute_process(
  COMMAND "${CMAKE_COMMAND}" -S "${core}" -B "${build}" -G "${generator}"
    "-DCMAKE_MAKE_PROGRAM=${make}" "-DCMAKE_CXX_COMPILER=${compiler}"
  RESULT_VARIABLE result
  OUTPUT_VARIABLE output
  ERROR_VARIABLE output)
if (NOT result EQUAL 0)
  message(SEND_ERROR "${core} does not configure alone:\n${output}")
endif ()
