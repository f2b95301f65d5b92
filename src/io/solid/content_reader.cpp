// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/solid/content_reader.h"

#include <mrpt/math/CQuaternion.h>

#include <cmath>

#include "io/archive/gzip_input.h"

namespace sigloc::detail
{
namespace
{
constexpr std::uint8_t kEnd = 0x88;  // after an object
constexpr double kRounding = 1e-3;

/// True where the rows are of length one and at right angles; not where a number is none.
bool isRotation(const mrpt::math::CMatrixDouble33& matrix)
{
  bool sound = true;
  for (int i = 0; i < 3; ++i)
  {
    for (int j = 0; j < 3; ++j)
    {
      double product = 0;
      for (int k = 0; k < 3; ++k) product += matrix(i, k) * matrix(j, k);
      sound = sound && std::abs(product - (i == j ? 1 : 0)) < kRounding;
    }
  }
  return sound;
}
}  // namespace

int ContentReader::anyObject(std::string& name)
{
  const auto header = objectHeaderIn(left_.substr(0, kLongestObjectHeader));
  if (!header || header->old) throw Unusable("damaged");
  const std::size_t colon = header->name.rfind(':');
  name = header->name.substr(colon == std::string_view::npos ? 0 : colon + 1);
  take(header->size);
  return value<std::int8_t>();
}

int ContentReader::object(std::string_view name)
{
  std::string found;
  const int version = anyObject(found);
  if (found != name) throw Unusable("damaged");
  return version;
}

void ContentReader::end()
{
  if (value<std::uint8_t>() != kEnd) throw Unusable("damaged");
}

mrpt::poses::CPose3D ContentReader::pose()
{
  constexpr int kWithQuaternion = 2;
  constexpr int kWithMatrix = 3;
  const int version = object("CPose3D");
  if (version < kWithQuaternion || version > kWithMatrix)
    throw Unusable("its sensor's pose is stored in version " + std::to_string(version));
  mrpt::poses::CPose3D pose;
  double at[3];
  for (double& coordinate : at) coordinate = value<double>();
  mrpt::math::CMatrixDouble33 rotation;
  if (version == kWithQuaternion)
  {
    mrpt::math::CQuaternionDouble turn(mrpt::math::UNINITIALIZED_QUATERNION);
    for (int i = 0; i < 4; ++i) turn[i] = value<double>();
    const double norm = turn.normSqr();
    if (!(std::abs(norm - 1) < kRounding)) throw Unusable("its sensor has no pose");
    turn.rotationMatrixNoResize(rotation);
  }
  else
  {
    for (int row = 0; row < 3; ++row)
    {
      for (int column = 0; column < 3; ++column) rotation(row, column) = value<double>();
    }
    if (!isRotation(rotation)) throw Unusable("its sensor has no pose");
  }
  end();
  pose = mrpt::poses::CPose3D(at[0], at[1], at[2]);
  pose.setRotationMatrix(rotation);
  return pose;
}
}  // namespace sigloc::detail
