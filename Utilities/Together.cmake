# With CMAKE_UNITY_BUILD the files of a folder are compiled together, up to eight as if they were
# one: most of a first build is the reading of VTK's and Qt's headers. So what a file defines for
# itself alone has a name that no other file of its folder has.

function (brainshift_group_files target)
  get_target_property(sources ${target} SOURCES)
  get_target_property(folder ${target} SOURCE_DIR)
  list(FILTER sources INCLUDE REGEX "^[^$]*[.]cxx$")
  foreach (source IN LISTS sources)
    cmake_path(ABSOLUTE_PATH source BASE_DIRECTORY "${folder}" NORMALIZE)
    cmake_path(GET source PARENT_PATH group)
    string(REPLACE "${PROJECT_BINARY_DIR}/" "made/" group "${group}")
    string(REPLACE "${PROJECT_SOURCE_DIR}/" "" group "${group}")
    string(MAKE_C_IDENTIFIER "${group}" group)
    math(EXPR part "0${count_of_${group}} / 8")
    math(EXPR count_of_${group} "0${count_of_${group}} + 1")
    set_property(SOURCE "${source}" TARGET_DIRECTORY ${target}
      PROPERTY UNITY_GROUP "${group}_${part}")
  endforeach ()
  # ParaView makes files for the plugin that define the same macros.
  foreach (kind IN ITEMS widget group_widget widget_decorator)
    string(APPEND before "#undef _paraview_property_widget_kind_${kind}\n")
  endforeach ()
  set_target_properties(${target} PROPERTIES
    UNITY_BUILD_MODE GROUP
    UNITY_BUILD_CODE_BEFORE_INCLUDE "${before}")
endfunction ()

# Does so for all targets of a folder and of those below it.
function (brainshift_compile_together folder)
  get_property(targets DIRECTORY "${folder}" PROPERTY BUILDSYSTEM_TARGETS)
  foreach (target IN LISTS targets)
    brainshift_group_files(${target})
  endforeach ()
  get_property(folders DIRECTORY "${folder}" PROPERTY SUBDIRECTORIES)
  foreach (below IN LISTS folders)
    brainshift_compile_together("${below}")
  endforeach ()
endfunction ()
