// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "eval/methods/features/FeatureOpponent.h"

namespace sigloc
{
/// The opponent for landmark maps: relocation by random sampling with locality, a variant of Neira,
/// Tardos and Castellanos (2003). Draws p = 4 observed features. Each map feature is tried as the
/// first pairing. The others are searched by unary and binary constraints in its locality, without
/// a star branch. A full set that passes the joint chi-square test gives a pose. The other features
/// are then paired with their nearest neighbours, each only where the whole set stays jointly
/// compatible. The number of draws follows P_good = 0.5, P_fail = 0.05 and the best so far.
class JcbbRelocation : public FeatureOpponent
{
 public:
  using FeatureOpponent::FeatureOpponent;

 private:
  struct Draw;
  void search(Query& query) const override;
  std::uint32_t baseSize() const override;
  void extend(Query& query, Draw& draw, std::size_t level) const;
  void complete(Query& query, const Draw& draw) const;
};
}  // namespace sigloc
