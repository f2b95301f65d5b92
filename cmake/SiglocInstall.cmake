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

# The plug-ins for MRPT's programs, by names without a version in a folder of their own: the one that
# nobody links with lies there, the other is a link to the library that programs use.
function(sigloc_install_plugins)
  set(folder "${CMAKE_INSTALL_LIBDIR}/sigloc")
  install(TARGETS sigloc-hwdrivers EXPORT siglocTargets
          LIBRARY DESTINATION "${folder}" COMPONENT plugins)
  set(link "${PROJECT_BINARY_DIR}/plugins/libsigloc-mrpt.so")
  file(MAKE_DIRECTORY "${PROJECT_BINARY_DIR}/plugins")
  file(CREATE_LINK ../libsigloc-mrpt.so.0 "${link}" SYMBOLIC)
  install(FILES "${link}" DESTINATION "${folder}" COMPONENT plugins)
endfunction()

# find_package(sigloc), and pkg-config for those without CMake.
function(sigloc_install_package_files)
  set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/sigloc")
  install(EXPORT siglocTargets NAMESPACE sigloc:: DESTINATION "${package_dir}" COMPONENT dev)
  configure_package_config_file("${PROJECT_SOURCE_DIR}/cmake/siglocConfig.cmake.in"
    "${PROJECT_BINARY_DIR}/siglocConfig.cmake" INSTALL_DESTINATION "${package_dir}")
  write_basic_package_version_file("${PROJECT_BINARY_DIR}/siglocConfigVersion.cmake"
    COMPATIBILITY SameMinorVersion)
  install(FILES "${PROJECT_BINARY_DIR}/siglocConfig.cmake"
    "${PROJECT_BINARY_DIR}/siglocConfigVersion.cmake"
    "${PROJECT_SOURCE_DIR}/cmake/SiglocDependencies.cmake"
    DESTINATION "${package_dir}" COMPONENT dev)

  # MRPT has no files for pkg-config: ours names its folders and libraries, too.
  set(mrpt_folders)
  foreach(target mrpt::math mrpt::config mrpt::obs mrpt::maps mrpt::slam mrpt::opengl)
    if(TARGET ${target})
      list(APPEND mrpt_folders "$<TARGET_PROPERTY:${target},INTERFACE_INCLUDE_DIRECTORIES>")
    endif()
  endforeach()
  set(SIGLOC_CFLAGS "-I$<JOIN:$<REMOVE_DUPLICATES:${mrpt_folders}>, -I>")
  string(REGEX REPLACE "[^/]+" ".." SIGLOC_TO_PREFIX "${CMAKE_INSTALL_LIBDIR}/pkgconfig")
  configure_file("${PROJECT_SOURCE_DIR}/cmake/sigloc.pc.in" "${PROJECT_BINARY_DIR}/sigloc.pc.in"
                 @ONLY)
  file(GENERATE OUTPUT "${PROJECT_BINARY_DIR}/sigloc.pc" INPUT "${PROJECT_BINARY_DIR}/sigloc.pc.in")
  install(FILES "${PROJECT_BINARY_DIR}/sigloc.pc" DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig"
          COMPONENT dev)
endfunction()

# sigloc_install(): install rules for every library and app added so far, the headers, what is in
# share/sigloc, the demo maps, the examples and the pages.
function(sigloc_install)
  get_property(libraries GLOBAL PROPERTY SIGLOC_LIBRARIES)
  get_property(apps GLOBAL PROPERTY SIGLOC_APPS)
  get_property(work GLOBAL PROPERTY SIGLOC_WORK)
  # Installed binaries find their libraries wherever the prefix is moved to.
  set_target_properties(${libraries} ${apps} ${work} PROPERTIES
    INSTALL_RPATH "$ORIGIN:$ORIGIN/..:$ORIGIN/../${CMAKE_INSTALL_LIBDIR}")
  # All that is installed and nothing else, for those who make packages.
  add_custom_target(sigloc-installed)
  add_dependencies(sigloc-installed ${libraries} ${apps})
  get_property(manuals GLOBAL PROPERTY SIGLOC_MANUALS)
  foreach(made IN LISTS manuals ITEMS sigloc-python)
    if(TARGET ${made})
      add_dependencies(sigloc-installed ${made})
    endif()
  endforeach()
  list(REMOVE_ITEM libraries sigloc-hwdrivers)
  # The plain-named links are what linking needs.
  install(TARGETS ${libraries} EXPORT siglocTargets
          LIBRARY COMPONENT library NAMELINK_COMPONENT dev)
  if(NOT SIGLOC_CORE_ONLY)
    sigloc_install_plugins()
  endif()
  foreach(app IN LISTS apps)
    set(component tools)
    if(app MATCHES "ros1")
      set(component ros1)
    endif()
    install(TARGETS ${app} COMPONENT ${component})
  endforeach()
  foreach(target IN LISTS work)
    install(TARGETS ${target} LIBRARY DESTINATION "${SIGLOC_WORK_FOLDER}" COMPONENT tools)
  endforeach()

  install(DIRECTORY "${PROJECT_SOURCE_DIR}/include/sigloc" TYPE INCLUDE COMPONENT dev
          FILES_MATCHING PATTERN *.h)
  install(DIRECTORY "${PROJECT_SOURCE_DIR}/share/sigloc" TYPE DATA COMPONENT tools)
  install(DIRECTORY "${PROJECT_SOURCE_DIR}/maps" "${PROJECT_SOURCE_DIR}/rawlogs"
          DESTINATION "${CMAKE_INSTALL_DATADIR}/sigloc" COMPONENT tools)
  install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" TYPE DOC COMPONENT license)
  set(doc "${CMAKE_INSTALL_DATADIR}/doc/sigloc-doc")
  file(GLOB examples "${PROJECT_SOURCE_DIR}/examples/*.cpp" "${PROJECT_SOURCE_DIR}/examples/*.py")
  install(FILES ${examples} DESTINATION "${doc}/examples" COMPONENT doc)
  file(GLOB pages "${PROJECT_SOURCE_DIR}/docs/*.md")
  install(FILES "${PROJECT_SOURCE_DIR}/README.md" ${pages} DESTINATION "${doc}" COMPONENT doc)
  # Made by the target sigloc-api, where it was.
  install(DIRECTORY "${PROJECT_BINARY_DIR}/api/html/" DESTINATION "${doc}/html" COMPONENT doc OPTIONAL)
  sigloc_install_package_files()
endfunction()
