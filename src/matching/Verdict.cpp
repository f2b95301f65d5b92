// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sigloc/matching/Verdict.h"

namespace sigloc
{
const char* toString(Verdict verdict)
{
  switch (verdict)
  {
    case Verdict::localized:
      return "localized";
    case Verdict::ambiguous:
      return "ambiguous";
    case Verdict::not_here:
      return "not here";
    case Verdict::too_little_seen:
      return "too little seen";
  }
  return "unknown";
}
}  // namespace sigloc
