# SPDX-FileCopyrightText: 2026 the sigloc authors
# SPDX-License-Identifier: BSD-3-Clause
include(CMakePackageConfigHelpers)

# Where Debian's Python looks for modules: below /usr in a folder for every version, elsewhere, as
# below /usr/local, in one of its own version.
if(CMAKE_INSTALL_PREFIX STREQUAL "/usr")
  set(python_folder python3)
else()
  set(python_folder "python${Python_VERSION_MAJOR}.${Python_VERSION_MINOR}")
endif()
set(SIGLOC_PYTHON_DIR "lib/${python_folder}/dist-packages" CACHE STRING
    "Folder of the prefix for the module for Python")

# sigloc_install(): install rules for every library and app added so far, the headers, share/sigloc
# and the package that find_package(sigloc) reads.
function(sigloc_install)
  get_property(libraries GLOBAL PROPERTY SIGLOC_LIBRARIES)
  get_property(apps GLOBAL PROPERTY SIGLOC_APPS)
  # Installed binaries find their libraries wherever the prefix is moved to.
  set_target_properties(${libraries} ${apps} PROPERTIES
    INSTALL_RPATH "$ORIGIN:$ORIGIN/../${CMAKE_INSTALL_LIBDIR}")

  set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/sigloc")
  install(TARGETS ${libraries} EXPORT siglocTargets)
  if(apps)
    install(TARGETS ${apps})
  endif()
  install(DIRECTORY "${PROJECT_SOURCE_DIR}/include/sigloc" TYPE INCLUDE FILES_MATCHING PATTERN *.h)
  install(DIRECTORY "${PROJECT_SOURCE_DIR}/share/sigloc" TYPE DATA OPTIONAL)
  install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" TYPE DOC)
  install(EXPORT siglocTargets NAMESPACE sigloc:: DESTINATION "${package_dir}")

  configure_package_config_file("${PROJECT_SOURCE_DIR}/cmake/siglocConfig.cmake.in"
    "${PROJECT_BINARY_DIR}/siglocConfig.cmake" INSTALL_DESTINATION "${package_dir}")
  write_basic_package_version_file("${PROJECT_BINARY_DIR}/siglocConfigVersion.cmake"
    COMPATIBILITY SameMinorVersion)
  install(FILES "${PROJECT_BINARY_DIR}/siglocConfig.cmake"
    "${PROJECT_BINARY_DIR}/siglocConfigVersion.cmake"
    "${PROJECT_SOURCE_DIR}/cmake/SiglocDependencies.cmake" DESTINATION "${package_dir}")
endfunction()
