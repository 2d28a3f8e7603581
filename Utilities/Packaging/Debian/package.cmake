# CPack makes a Debian package of what is installed. It is called brainshift and not
# paraview-plugin-brainshift: it holds a Python module and a launcher entry as well, and users
# look for the name they know. ./brainshift package builds it.
set(BRAINSHIFT_MAINTAINER "The BrainShift developers <brainshift@example.org>" CACHE STRING
  "Maintainer of the Debian package: a name and an address")
set(BRAINSHIFT_HOMEPAGE "https://doi.org/10.1117/12.808491" CACHE STRING
  "Homepage of the Debian package: where the method is described")

# ParaView keeps its binary interface within a release only; the number orders the packages of two.
set(paraview_release "${ParaView_VERSION_MAJOR}.${ParaView_VERSION_MINOR}")
math(EXPR next_minor "${ParaView_VERSION_MINOR} + 1")
set(next_paraview_release "${ParaView_VERSION_MAJOR}.${next_minor}")
set(debian_revision "1+pv${paraview_release}")

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME brainshift)
set(CPACK_PACKAGE_VERSION "${BrainShift_VERSION}")
set(CPACK_PACKAGE_VENDOR BrainShift)
set(CPACK_PACKAGE_CONTACT "${BRAINSHIFT_MAINTAINER}")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "bend a medical volume by hand inside ParaView")
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION
"This plugin for ParaView bends a volume, such as a magnetic resonance image
of a head, by strokes of the mouse or of a Python script, and draws it bent
at once. It shows the bent volume beside a reference, measures how far traced
points lie from its surface and saves the displacement field.
.
The package holds the plugin for ParaView ${paraview_release}, the Python module
brainshift and a launcher entry. It is research software and not a medical
device.")
set(CPACK_PACKAGING_INSTALL_PREFIX "${CMAKE_INSTALL_PREFIX}")
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS # whatever the umask is
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)

set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE "${debian_revision}")
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_HOMEPAGE "${BRAINSHIFT_HOMEPAGE}")
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
# dpkg-shlibdeps adds the libraries, and the exact version of ParaView that the plugin links.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
string(JOIN ", " CPACK_DEBIAN_PACKAGE_DEPENDS
  "paraview (>= ${paraview_release})"
  "paraview (<< ${next_paraview_release})"
  python3
  python3-numpy
  python3-paraview
  qt6-svg-plugins) # draws the icons; ParaView itself does without
# The plugin's own libraries, which only the plugin loads.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS
  "${CMAKE_BINARY_DIR}/${CMAKE_INSTALL_LIBDIR}/${PARAVIEW_PLUGIN_SUBDIR}/BrainShift")
set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA
  "${CMAKE_CURRENT_LIST_DIR}/postinst"
  "${CMAKE_CURRENT_LIST_DIR}/prerm")
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

# Files that only a Debian package has: component debian, which plain `cmake --install` leaves out.
find_program(GZIP gzip REQUIRED)
mark_as_advanced(GZIP)
string(TIMESTAMP changelog_date "%a, %d %b %Y %H:%M:%S +0000" UTC)
configure_file(Debian/changelog.in changelog.Debian @ONLY)
configure_file("${PROJECT_SOURCE_DIR}/CHANGELOG.md" changelog COPYONLY)
foreach (file IN ITEMS changelog changelog.Debian)
  execute_process(
    COMMAND "${GZIP}" -9nf "${CMAKE_CURRENT_BINARY_DIR}/${file}"
    COMMAND_ERROR_IS_FATAL ANY)
  install(FILES "${CMAKE_CURRENT_BINARY_DIR}/${file}.gz"
    DESTINATION "${BRAINSHIFT_INSTALL_DOCDIR}"
    COMPONENT debian
    EXCLUDE_FROM_ALL)
endforeach ()
install(FILES Debian/lintian-overrides
  DESTINATION "${CMAKE_INSTALL_DATADIR}/lintian/overrides"
  RENAME brainshift
  COMPONENT debian
  EXCLUDE_FROM_ALL)
set(CPACK_INSTALL_CMAKE_PROJECTS
  "${CMAKE_BINARY_DIR};BrainShift;ALL;/"
  "${CMAKE_BINARY_DIR};BrainShift;debian;/")
include(CPack)
