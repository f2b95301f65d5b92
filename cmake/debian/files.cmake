# SPDX-FileCopyrightText: 2026 the sigloc authors
# SPDX-License-Identifier: BSD-3-Clause
# Run by CPack on the folder of every component, before it becomes a package: what Debian's policy
# wants otherwise than `cmake --install` does it.
file(READ "${CMAKE_CURRENT_LIST_DIR}/../../LICENSE" license)
string(REGEX REPLACE "\n\n" "\n.\n" license "${license}")
string(REGEX REPLACE "\n" "\n " license "${license}")
# That of the commit, where SOURCE_DATE_EPOCH tells it.
string(TIMESTAMP now "%a, %d %b %Y %H:%M:%S +0000" UTC)

function(compress file)
  execute_process(COMMAND gzip -9nf "${file}" COMMAND_ERROR_IS_FATAL ANY)
endfunction()

file(GLOB component_folders "${CPACK_TEMPORARY_DIRECTORY}/*")
foreach(folder IN LISTS component_folders)
  get_filename_component(component "${folder}" NAME)
  string(TOUPPER "${component}" key)
  set(package "${CPACK_DEBIAN_${key}_PACKAGE_NAME}")
  if(NOT package)
    continue()
  endif()

  # The libraries are where the system looks.
  file(GLOB binaries "${folder}/usr/bin/*" "${folder}/usr/lib/*/*.so.*.*"
       "${folder}/usr/lib/*/sigloc/*.so.*.*"
       "${folder}/usr/lib/*/sigloc/sigloc-*.so"
       "${folder}/usr/lib/python*/dist-packages/sigloc/*.so")
  foreach(binary IN LISTS binaries)
    file(RPATH_REMOVE FILE "${binary}")
  endforeach()
  # Debian's own modules lie in a folder for every version of Python 3.
  file(GLOB python_folder "${folder}/usr/lib/python3.*")
  if(python_folder)
    file(RENAME "${python_folder}" "${folder}/usr/lib/python3")
  endif()

  file(GLOB man_pages "${folder}/usr/share/man/man1/*.1")
  foreach(page IN LISTS man_pages)
    compress("${page}")
  endforeach()
  if(component STREQUAL "library")
    file(WRITE "${folder}/usr/share/lintian/overrides/${package}"
"# CPack writes these scripts beside the trigger; they do what it does.
${package}: maintscript-calls-ldconfig *
")
  endif()
  set(doc "${folder}/usr/share/doc/${package}")
  file(WRITE "${doc}/copyright"
"Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/

Files: *
Copyright: 2026 the sigloc authors
License: BSD-3-Clause
 ${license}
")
  file(WRITE "${doc}/changelog.Debian"
"sigloc (${CPACK_PACKAGE_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}) unstable; urgency=medium

  * See CHANGELOG.md of the sources.

 -- ${CPACK_PACKAGE_CONTACT}  ${now}
")
  compress("${doc}/changelog.Debian")
  file(CHMOD_RECURSE "${folder}/usr/share" FILE_PERMISSIONS OWNER_READ OWNER_WRITE GROUP_READ WORLD_READ
       DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
endforeach()
