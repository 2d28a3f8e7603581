# brainshift_add_room(NAME [SOURCES file…] [CLASSES class…] [XMLS file…])
#
# Adds a folder of this module. SOURCES are C++ files, CLASSES are classes of VTK, each a pair of
# files, XMLS describe proxies.
function (brainshift_add_room name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "SOURCES;CLASSES;XMLS")
  if (arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "brainshift_add_room does not know ${arg_UNPARSED_ARGUMENTS}")
  endif ()
  foreach (list IN ITEMS SOURCES CLASSES XMLS)
    list(TRANSFORM arg_${list} PREPEND "${name}/")
    set_property(GLOBAL APPEND PROPERTY brainshift_formats_${list} ${arg_${list}})
  endforeach ()
  set_property(GLOBAL APPEND PROPERTY brainshift_formats_ROOMS "${name}")
endfunction ()

# brainshift_add_format(NAME KINDS kind… [LAST] [FOLDER folder] [SOURCES …] [CLASSES …] [XMLS …]
#   [EXTENSIONS ending… [DETAILS text] [READER name] [LABEL text] [READS text] [SHORT text]
#    [ENDINGS text] [FILES text] [MENU text]])
#
# Adds a format, whose folder has its name unless FOLDER says another. KINDS are what its files
# hold: Volumes, Fields, Surfaces, Tracts or Landmarks. For each of them the format defines one
# constant of that kind, such as `extern const VolumeFormat VolumesOfNRRD{ … };`, and readers of
# that kind ask it. Formats are asked in the order in which they are added, and the one of each kind
# that is LAST after all others: of surfaces and tracts, it says what is wrong with a file that none
# recognises.
#
# With EXTENSIONS, the endings of names without a full stop, ParaView gets a reader of its volumes:
# a proxy made from Volumes/VolumeReader.xml.in. A reader with properties of its own has a file in
# XMLS instead. DETAILS ends the documentation of the proxy. The other words have these defaults:
#   READER   NAMEVolumeReader       name of the proxy
#   LABEL    NAME                   its label, before "Volume Reader"
#   READS    "a LABEL volume"       what it reads, in its documentation
#   SHORT    READS                  the same, in its short help
#   ENDINGS  ".one, .other"         in its help
#   FILES    ".one, .other"         in the documentation of FileName
#   MENU     "LABEL volume"         in the list of File > Open
# Utilities/documentation/format_reference.py reads these calls, too.
function (brainshift_add_format name)
  set(words READER LABEL READS SHORT ENDINGS FILES MENU DETAILS)
  cmake_parse_arguments(PARSE_ARGV 1 arg "LAST" "FOLDER;${words}"
    "KINDS;SOURCES;CLASSES;XMLS;EXTENSIONS")
  if (arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "brainshift_add_format does not know ${arg_UNPARSED_ARGUMENTS}")
  endif ()
  if (NOT arg_FOLDER)
    set(arg_FOLDER "${name}")
  endif ()
  foreach (kind IN LISTS arg_KINDS)
    if (NOT kind MATCHES "^(Volumes|Fields|Surfaces|Tracts|Landmarks)$")
      message(FATAL_ERROR "brainshift_add_format knows no files of ${kind}")
    endif ()
    set(list "brainshift_formats_OF_${kind}")
    if (arg_LAST)
      set(list "brainshift_formats_LAST_OF_${kind}")
    endif ()
    set_property(GLOBAL APPEND PROPERTY ${list} "${kind}Of${name}")
  endforeach ()
  if (arg_SOURCES OR arg_CLASSES OR arg_XMLS)
    brainshift_add_room("${arg_FOLDER}"
      SOURCES ${arg_SOURCES} CLASSES ${arg_CLASSES} XMLS ${arg_XMLS})
  endif ()
  if (arg_EXTENSIONS)
    brainshift_write_volume_reader("${name}")
  endif ()
endfunction ()

# Writes the proxy of a reader of volumes from the arguments of brainshift_add_format.
function (brainshift_write_volume_reader format)
  list(JOIN arg_EXTENSIONS ", ." dotted)
  macro (choose word default)
    string(TOLOWER "${word}" variable)
    set("${variable}" "${default}")
    if (arg_${word})
      set("${variable}" "${arg_${word}}")
    endif ()
  endmacro ()
  choose(READER "${format}VolumeReader")
  choose(LABEL "${format}")
  choose(READS "a ${label} volume")
  choose(SHORT "${reads}")
  choose(ENDINGS ".${dotted}")
  choose(FILES ".${dotted}")
  choose(MENU "${label} volume")
  choose(DETAILS "")
  list(JOIN arg_EXTENSIONS " " extensions)
  set(xml "${CMAKE_CURRENT_BINARY_DIR}/${reader}.xml")
  configure_file("${CMAKE_CURRENT_FUNCTION_LIST_DIR}/Volumes/VolumeReader.xml.in" "${xml}" @ONLY)
  set_property(GLOBAL APPEND PROPERTY brainshift_formats_READERS "${xml}")
endfunction ()

# brainshift_write_formats(FILE [kind…]): the lists of formats as C++, of all kinds or of some.
function (brainshift_write_formats file)
  set(header_of_Volume Volumes/VolumeFile.h)
  set(header_of_Field Fields/FieldFile.h)
  set(header_of_Surface Surfaces/SurfaceFile.h)
  set(header_of_Tract Surfaces/SurfaceFile.h)
  set(header_of_Landmark Landmarks/LandmarkFormats.h)
  set(kinds ${ARGN})
  if (NOT kinds)
    set(kinds Volume Field Surface Tract Landmark)
  endif ()
  set(includes "")
  foreach (kind IN LISTS kinds)
    list(APPEND includes "#include \"Formats/${header_of_${kind}}\"\n")
  endforeach ()
  list(REMOVE_DUPLICATES includes)
  list(JOIN includes "" includes)
  set(text "// Written by AddFormat.cmake: the formats of each kind.\n${includes}\n")
  string(APPEND text "namespace brainshift\n{\n")
  foreach (kind IN LISTS kinds)
    get_property(formats GLOBAL PROPERTY "brainshift_formats_OF_${kind}s")
    get_property(last GLOBAL PROPERTY "brainshift_formats_LAST_OF_${kind}s")
    list(APPEND formats ${last})
    string(TOLOWER "${kind}" word)
    foreach (format IN LISTS formats)
      string(APPEND text "extern const ${kind}Format ${format};\n")
    endforeach ()
    list(TRANSFORM formats PREPEND "&")
    list(JOIN formats ", " formats)
    string(APPEND text "const std::vector<const ${kind}Format*>& ${word}Formats()\n{\n"
      "  static const std::vector<const ${kind}Format*> all{ ${formats} };\n  return all;\n}\n\n")
  endforeach ()
  string(APPEND text "}\n")
  file(CONFIGURE OUTPUT "${file}" CONTENT "${text}" @ONLY)
endfunction ()
