// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "bindings/arrays.h"

#include <fmt/format.h>

#include <stdexcept>
#include <string>

#include "sigloc/io/file_output.h"

namespace sigloc::python
{
namespace py = pybind11;

namespace
{
std::string textOf(const std::vector<py::ssize_t>& shape)
{
  std::string text;
  for (const py::ssize_t size : shape)
  {
    text += fmt::format("{}{}", text.empty() ? "" : ", ", size < 0 ? "N" : std::to_string(size));
  }
  return "(" + text + (shape.size() == 1 ? ",)" : ")");
}
}  // namespace

void requireShape(const py::array& numbers, const std::vector<py::ssize_t>& shape, const char* what)
{
  const std::vector<py::ssize_t> found(numbers.shape(), numbers.shape() + numbers.ndim());
  bool same = found.size() == shape.size();
  for (std::size_t i = 0; same && i < shape.size(); ++i)
    same = shape[i] < 0 || shape[i] == found[i];
  if (same) return;
  throw std::invalid_argument(
      fmt::format("{} must be of shape {}, not {}", what, textOf(shape), textOf(found)));
}

mrpt::math::TPose2D poseOf(const Numbers& numbers, const char* what)
{
  requireShape(numbers, {3}, what);
  const auto values = numbers.unchecked<1>();
  return {values(0), values(1), values(2)};
}

mrpt::math::CMatrixDouble33 covarianceOf(const Numbers& numbers, const char* what)
{
  requireShape(numbers, {3, 3}, what);
  const auto values = numbers.unchecked<2>();
  mrpt::math::CMatrixDouble33 covariance;
  for (int r = 0; r < 3; ++r)
  {
    for (int c = 0; c < 3; ++c) covariance(r, c) = values(r, c);
  }
  return covariance;
}

Numbers arrayOf(const mrpt::math::TPose2D& pose)
{
  Numbers array(3);
  auto values = array.mutable_unchecked<1>();
  values(0) = pose.x;
  values(1) = pose.y;
  values(2) = pose.phi;
  return array;
}

void withFile(const std::function<void()>& work)
{
  try
  {
    const py::gil_scoped_release unlocked;
    work();
  }
  catch (const std::runtime_error& error)
  {
    const std::string reason = oneLine(error.what());
    const bool missing = reason.find("no such file") != std::string::npos;
    PyErr_SetString(missing ? PyExc_FileNotFoundError : PyExc_OSError, reason.c_str());
    throw py::error_already_set();
  }
}
}  // namespace sigloc::python
