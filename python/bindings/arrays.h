// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/CMatrixFixed.h>
#include <mrpt/math/TPose2D.h>
#include <pybind11/numpy.h>

#include <functional>
#include <vector>

namespace sigloc::python
{
/// What numpy makes of any sequence of numbers.
using Numbers = pybind11::array_t<double, pybind11::array::c_style | pybind11::array::forcecast>;

/// Throws std::invalid_argument unless `numbers` has this shape; -1 allows any size. `what` begins
/// the message.
void requireShape(const pybind11::array& numbers, const std::vector<pybind11::ssize_t>& shape,
                  const char* what);

/// A pose of three numbers: x [m], y [m], heading [rad]. Throws std::invalid_argument for others.
mrpt::math::TPose2D poseOf(const Numbers& numbers, const char* what);

/// A 3x3 covariance. Throws std::invalid_argument for another shape.
mrpt::math::CMatrixDouble33 covarianceOf(const Numbers& numbers, const char* what);

Numbers arrayOf(const mrpt::math::TPose2D& pose);

/// A matrix of fixed size, as an array of its own.
template <class Matrix>
Numbers arrayOfMatrix(const Matrix& matrix)
{
  const auto rows = static_cast<pybind11::ssize_t>(matrix.rows());
  const auto columns = static_cast<pybind11::ssize_t>(matrix.cols());
  Numbers array({rows, columns});
  auto values = array.template mutable_unchecked<2>();
  for (pybind11::ssize_t r = 0; r < rows; ++r)
  {
    for (pybind11::ssize_t c = 0; c < columns; ++c)
    {
      values(r, c) = matrix(static_cast<int>(r), static_cast<int>(c));
    }
  }
  return array;
}

/// Calls what reads or writes a file, without the interpreter's lock. A file's error becomes an
/// OSError, that of a missing one a FileNotFoundError.
void withFile(const std::function<void()>& work);
}  // namespace sigloc::python
