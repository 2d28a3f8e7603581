# Writes every assembled shader into `folder`. `validator` compiles and links each program as GLSL
# 1.50, and again to SPIR-V for OpenGL, which its validator of SPIR-V reads. A warning is an error.

# Sets `variable` to what is wrong with the program of some stages, and to nothing if it is right.
function (find_faults stages variable)
  set(faults "")
  # SPIR-V begins with GLSL 3.30; 4.50 is its own version. OpenGL has locations without numbers.
  set(as_spirv --target-env opengl --glsl-version 450 --auto-map-bindings --auto-map-locations
    --spirv-val)
  foreach (options IN ITEMS "" "${as_spirv}")
    execute_process(COMMAND "${validator}" -l ${options} ${stages}
      WORKING_DIRECTORY "${folder}"
      RESULT_VARIABLE failed OUTPUT_VARIABLE log ERROR_VARIABLE log)
    if (failed OR log MATCHES "[Ww][Aa][Rr][Nn][Ii][Nn][Gg]")
      string(APPEND faults "${log}\n")
    endif ()
  endforeach ()
  set(${variable} "${faults}" PARENT_SCOPE)
endfunction ()

file(REMOVE_RECURSE "${folder}")
file(MAKE_DIRECTORY "${folder}/warns")
# An extension that no compiler has is a warning, so it is found, or the check does nothing.
set(known "#version 150\nin vec4 place;\nvoid main()\n{\n  gl_Position = place;\n}\n")
file(WRITE "${folder}/warns/right.vert" "${known}")
string(REPLACE "\nin" "\n#extension GL_BRAINSHIFT_none : enable\nin" warns "${known}")
file(WRITE "${folder}/warns/wrong.vert" "${warns}")
find_faults("${folder}/warns/right.vert" faults)
if (faults)
  message(FATAL_ERROR "A shader without a fault was refused:\n${faults}")
endif ()
find_faults("${folder}/warns/wrong.vert" faults)
if (NOT faults)
  message(FATAL_ERROR "A shader that ${validator} warns of was accepted")
endif ()

execute_process(COMMAND "${writer}" "${folder}" RESULT_VARIABLE failed)
if (failed)
  message(FATAL_ERROR "The shaders could not be written to ${folder}")
endif ()
file(GLOB vertex_stages "${folder}/*.vert")
list(LENGTH vertex_stages programs)
if (programs LESS 4)
  message(FATAL_ERROR "${folder} holds ${programs} programs; it must hold at least 4")
endif ()
foreach (vertex IN LISTS vertex_stages)
  string(REGEX REPLACE "vert$" "" stem "${vertex}")
  file(GLOB stages "${stem}vert" "${stem}geom" "${stem}frag")
  find_faults("${stages}" faults)
  if (faults)
    message(SEND_ERROR "${vertex}:\n${faults}")
  endif ()
endforeach ()
