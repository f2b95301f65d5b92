# SPDX-FileCopyrightText: 2026 the sigloc authors
# SPDX-License-Identifier: BSD-3-Clause
# The Debian packages that scripts/package makes: one for each component that is installed.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME sigloc)
set(CPACK_PACKAGE_DIRECTORY "${PROJECT_BINARY_DIR}/packages")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_PRE_BUILD_SCRIPTS "${PROJECT_SOURCE_DIR}/cmake/debian/files.cmake")
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
# Not Debian's own: a package of theirs would take the place of these.
set(CPACK_DEBIAN_PACKAGE_RELEASE 0local1)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS "${CMAKE_LIBRARY_OUTPUT_DIRECTORY}")
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS_POLICY ">=")
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS ON)

# sigloc_package(COMPONENT NAME SECTION CONTENTS [NEEDS component...] [DEPENDS text] [RECOMMENDS text]):
# what Debian's tools do not find out by themselves.
macro(sigloc_package component name section contents)
  cmake_parse_arguments(ARG "" "DEPENDS;RECOMMENDS" "NEEDS" ${ARGN})
  string(TOUPPER ${component} key)
  list(APPEND CPACK_COMPONENTS_ALL ${component})
  set(CPACK_COMPONENT_${key}_DEPENDS ${ARG_NEEDS})
  set(CPACK_DEBIAN_${key}_PACKAGE_NAME ${name})
  set(CPACK_DEBIAN_${key}_PACKAGE_SECTION ${section})
  set(CPACK_DEBIAN_${key}_DESCRIPTION
"sigloc finds a robot that woke up lost in a known map from what its laser
sees, says how sure it is, and follows every possible pose until one is left.

This package has ${contents}.")
  if(ARG_DEPENDS)
    set(CPACK_DEBIAN_${key}_PACKAGE_DEPENDS "${ARG_DEPENDS}")
  endif()
  if(ARG_RECOMMENDS)
    set(CPACK_DEBIAN_${key}_PACKAGE_RECOMMENDS "${ARG_RECOMMENDS}")
  endif()
endmacro()

set(CPACK_COMPONENTS_ALL)
sigloc_package(library libsigloc0 libs "the libraries")
sigloc_package(dev libsigloc-dev libdevel "the headers and what else a build needs"
  NEEDS library plugins DEPENDS "libmrpt-dev, libeigen3-dev")
sigloc_package(tools sigloc-tools science "the programs, sample ini files and demo maps"
  NEEDS library RECOMMENDS "mrpt-common")
sigloc_package(plugins sigloc-plugins science "the plug-ins for MRPT's programs"
  NEEDS library)
sigloc_package(doc sigloc-doc doc "the documentation and examples")
set(CPACK_DEBIAN_DOC_PACKAGE_ARCHITECTURE all)
if(SIGLOC_PYTHON AND NOT SIGLOC_CORE_ONLY)
  math(EXPR next_python "${Python_VERSION_MINOR} + 1")
  sigloc_package(python python3-sigloc python "the module for Python"
    NEEDS library
    DEPENDS "python3 (>= 3.${Python_VERSION_MINOR}), python3 (<< 3.${next_python}), python3-numpy"
    RECOMMENDS "python3-lz4")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA
      "${PROJECT_SOURCE_DIR}/cmake/debian/python/postinst" "${PROJECT_SOURCE_DIR}/cmake/debian/python/prerm")
endif()
if(SIGLOC_ROS1 AND NOT SIGLOC_CORE_ONLY)
  sigloc_package(ros1 sigloc-ros1 science "the node for ROS 1"
    NEEDS library)
endif()
set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_EXTRA "${PROJECT_SOURCE_DIR}/cmake/debian/triggers")
include(CPack)
