// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sigloc/signature/Signature.h"

#include "signature/binary_constraint.h"

namespace sigloc
{
std::vector<Signature> signaturesOf(const std::vector<Feature>& features)
{
  std::vector<DirectedFeature> views;
  views.reserve(features.size());
  for (const Feature& feature : features) views.push_back(directed(feature));
  std::vector<Signature> signatures;
  for (std::uint32_t i = 0; i < views.size(); ++i)
  {
    Signature signature;
    signature.feature = i;
    for (std::uint32_t j = 0; j < views.size(); ++j)
    {
      if (j != i) signature.relations.push_back({j, binaryKey(views[i], views[j])});
    }
    signatures.push_back(std::move(signature));
  }
  return signatures;
}
}  // namespace sigloc
