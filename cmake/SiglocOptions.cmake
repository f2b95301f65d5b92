# SPDX-FileCopyrightText: 2026 the sigloc authors
# SPDX-License-Identifier: BSD-3-Clause
# Debian's folder for libraries, where its linker, pkg-config and CMake look below every prefix. CMake
# takes it by itself for the prefix /usr only, which packages have no earlier than when they are made.
if(EXISTS /etc/debian_version AND CMAKE_LIBRARY_ARCHITECTURE)
  set(CMAKE_INSTALL_LIBDIR "lib/${CMAKE_LIBRARY_ARCHITECTURE}" CACHE PATH
      "Folder of the prefix for libraries")
endif()
include(GNUInstallDirs)
set(CMAKE_CXX_STANDARD 17)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/bin")
set(CMAKE_LIBRARY_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/lib")
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()

option(SIGLOC_BUILD_TESTS "Build the tests" ON)
option(SIGLOC_CORE_ONLY "Build the core library and its tests only: no plug-in, no apps" OFF)
option(SIGLOC_PYTHON "Build the module for Python" ON)
option(SIGLOC_ROS1 "Build the node for ROS 1" OFF)
option(SIGLOC_WERROR "Treat warnings as errors" ON)
set(SIGLOC_SANITIZE "" CACHE STRING "Sanitizers, as -fsanitize takes them (address,undefined)")
option(SIGLOC_COVERAGE "Instrument for coverage" OFF)
option(SIGLOC_FUZZ "Build the fuzz targets with libFuzzer, which takes clang" OFF)

add_library(sigloc_flags INTERFACE)
# No code reads errno after a call of <cmath>.
target_compile_options(sigloc_flags INTERFACE -Wall -Wextra -Wpedantic -Wconversion -Wshadow
                       -fno-math-errno)
if(SIGLOC_WERROR)
  target_compile_options(sigloc_flags INTERFACE -Werror)
endif()
# g++ takes the files of a unity build for headers, where the warning would be right.
if(CMAKE_UNITY_BUILD AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  target_compile_options(sigloc_flags INTERFACE -Wno-subobject-linkage)
endif()
if(SIGLOC_SANITIZE)
  target_compile_options(sigloc_flags INTERFACE -fsanitize=${SIGLOC_SANITIZE}
                         -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(sigloc_flags INTERFACE -fsanitize=${SIGLOC_SANITIZE})
endif()
if(SIGLOC_FUZZ)
  target_compile_options(sigloc_flags INTERFACE -fsanitize=fuzzer-no-link
    "-fsanitize-coverage-ignorelist=${PROJECT_SOURCE_DIR}/tests/fuzz/driver/uncounted.txt")
endif()
if(SIGLOC_COVERAGE)
  # Threads count together.
  target_compile_options(sigloc_flags INTERFACE --coverage -fprofile-update=atomic)
  target_link_options(sigloc_flags INTERFACE --coverage)
endif()

# sigloc_add_library(NAME [INTERNAL] PARTS part... LINK target... [PRIVATE_LINK target...]): a library
# from src/<part>/**.cpp. It is shared and installed; INTERNAL: static, for our own programs alone.
# Users see include/ only, and do without what PRIVATE_LINK names; what is built here may add
# SIGLOC_PRIVATE_HEADERS.
set(SIGLOC_PRIVATE_HEADERS "${PROJECT_SOURCE_DIR}/src")
function(sigloc_add_library name)
  cmake_parse_arguments(ARG "INTERNAL" "" "PARTS;LINK;PRIVATE_LINK" ${ARGN})
  set(sources)
  foreach(part IN LISTS ARG_PARTS)
    file(GLOB_RECURSE part_sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/src/${part}/*.cpp")
    list(APPEND sources ${part_sources})
  endforeach()
  if(ARG_INTERNAL)
    add_library(${name} STATIC ${sources})
  else()
    add_library(${name} SHARED ${sources})
    add_library(sigloc::${name} ALIAS ${name})
    set_property(GLOBAL APPEND PROPERTY SIGLOC_LIBRARIES ${name})
    set_target_properties(${name} PROPERTIES VERSION ${PROJECT_VERSION} SOVERSION 0)
  endif()
  # Most of the time goes into the headers of MRPT. Where CMAKE_UNITY_BUILD is on, a folder is compiled
  # as one file, so a name in an unnamed namespace must be unique in its folder.
  set_target_properties(${name} PROPERTIES UNITY_BUILD_MODE GROUP)
  foreach(source IN LISTS sources)
    cmake_path(RELATIVE_PATH source BASE_DIRECTORY "${PROJECT_SOURCE_DIR}/src" OUTPUT_VARIABLE folder)
    cmake_path(GET folder PARENT_PATH folder)
    string(REPLACE "/" "_" folder "${folder}")
    set_source_files_properties("${source}" PROPERTIES UNITY_GROUP "${folder}")
  endforeach()
  target_include_directories(${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_include_directories(${name} PRIVATE "${SIGLOC_PRIVATE_HEADERS}")
  target_link_libraries(${name} PUBLIC ${ARG_LINK}
    PRIVATE "$<BUILD_INTERFACE:${ARG_PRIVATE_LINK};sigloc_flags>")
endfunction()

# sigloc_add_manual(NAME COMPONENT component COMMAND command [DEPENDS what...]): the man page and the
# completion that a program prints, by the target NAME-manual.
function(sigloc_add_manual name)
  cmake_parse_arguments(ARG "" "COMPONENT;COMMAND" "DEPENDS" ${ARGN})
  set(man_page "${PROJECT_BINARY_DIR}/manual/${name}.1")
  set(completion "${PROJECT_BINARY_DIR}/manual/completions/${name}")
  file(MAKE_DIRECTORY "${PROJECT_BINARY_DIR}/manual/completions")
  add_custom_command(OUTPUT "${man_page}" "${completion}"
    COMMAND ${ARG_COMMAND} --print-man-page > "${man_page}"
    COMMAND ${ARG_COMMAND} --print-completion > "${completion}"
    DEPENDS ${ARG_DEPENDS} VERBATIM)
  add_custom_target(${name}-manual ALL DEPENDS "${man_page}" "${completion}")
  set_property(GLOBAL APPEND PROPERTY SIGLOC_MANUALS ${name}-manual)
  install(FILES "${man_page}" DESTINATION "${CMAKE_INSTALL_MANDIR}/man1" COMPONENT ${ARG_COMPONENT})
  install(FILES "${completion}" DESTINATION "${CMAKE_INSTALL_DATADIR}/bash-completion/completions"
          COMPONENT ${ARG_COMPONENT})
endfunction()

# sigloc_add_app(NAME [LOADED] [COMPONENT component] [SOURCES file...] LINK target...): an executable from
# apps/<NAME>/*.cpp or the files, with the man page and the completion that it prints. They are of the
# component `tools` unless another is named. Its target is called NAME-app where a library has the name
# already. LOADED: main.cpp alone is the executable, and parses the arguments. The rest is a library,
# target NAME-work, that is loaded once they are right: MRPT takes most of a program's start.
function(sigloc_add_app name)
  cmake_parse_arguments(ARG "LOADED" "COMPONENT" "SOURCES;LINK" ${ARGN})
  set(component tools)
  if(ARG_COMPONENT)
    set(component ${ARG_COMPONENT})
  endif()
  set(target ${name})
  if(TARGET ${name})
    set(target ${name}-app)
  endif()
  file(GLOB sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/apps/${name}/*.cpp")
  if(ARG_LOADED)
    set(main "${PROJECT_SOURCE_DIR}/apps/${name}/main.cpp")
    list(REMOVE_ITEM sources "${main}")
    sigloc_add_work(${name} SOURCES ${sources} LINK ${ARG_LINK})
    set(sources "${main}")
    set(ARG_LINK sigloc_launcher)
  endif()
  add_executable(${target} ${sources} ${ARG_SOURCES} "${PROJECT_SOURCE_DIR}/apps/common/manual.cpp"
                 "${PROJECT_SOURCE_DIR}/apps/common/wrong_use.cpp")
  set_target_properties(${target} PROPERTIES OUTPUT_NAME ${name})
  target_include_directories(${target} PRIVATE "${PROJECT_SOURCE_DIR}/apps/common")
  target_link_libraries(${target} PRIVATE ${ARG_LINK} CLI11::CLI11 fmt::fmt sigloc_flags)
  target_compile_definitions(${target} PRIVATE SIGLOC_VERSION="${PROJECT_VERSION}")
  if(ARG_LOADED)
    add_dependencies(${target} ${name}-work)
    target_sources(${target} PRIVATE "${PROJECT_SOURCE_DIR}/apps/common/load_work.cpp")
    target_compile_definitions(${target} PRIVATE SIGLOC_WORK="${SIGLOC_WORK_FROM_BIN}/${name}.so"
      SIGLOC_OSMESA="${SIGLOC_OSMESA}" SIGLOC_LOADED_FIRST="${SIGLOC_LOADED_FIRST}")
  endif()
  set_property(GLOBAL APPEND PROPERTY SIGLOC_APPS ${target})
  sigloc_add_manual(${name} COMPONENT ${component} COMMAND ${target})
endfunction()

# sigloc_add_work(NAME SOURCES file... LINK target...): the library of a program's work, at the same
# place from its executable when built as when installed.
set(SIGLOC_WORK_FOLDER "${CMAKE_INSTALL_LIBDIR}/sigloc")
file(RELATIVE_PATH SIGLOC_WORK_FROM_BIN "/${CMAKE_INSTALL_BINDIR}" "/${SIGLOC_WORK_FOLDER}")
function(sigloc_add_work name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  add_library(${name}-work MODULE ${ARG_SOURCES})
  set_target_properties(${name}-work PROPERTIES PREFIX "" OUTPUT_NAME ${name}
    LIBRARY_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/${SIGLOC_WORK_FOLDER}")
  target_include_directories(${name}-work PRIVATE "${PROJECT_SOURCE_DIR}/apps/common")
  target_link_libraries(${name}-work PRIVATE ${ARG_LINK} CLI11::CLI11 fmt::fmt sigloc_flags)
  set_property(GLOBAL APPEND PROPERTY SIGLOC_WORK ${name}-work)
endfunction()
