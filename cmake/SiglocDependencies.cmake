# SPDX-FileCopyrightText: 2026 the sigloc authors
# SPDX-License-Identifier: BSD-3-Clause
find_package(Eigen3 REQUIRED NO_MODULE)
foreach(module math config poses obs maps slam opengl tfest)
  find_package(mrpt-${module} 2.5 REQUIRED)
endforeach()
find_package(CLI11 REQUIRED)
find_package(nlohmann_json REQUIRED)
if(SIGLOC_BUILD_TESTS)
  find_package(GTest REQUIRED)
endif()
