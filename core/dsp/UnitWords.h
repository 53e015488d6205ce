// UnitWords.h - the units that a fingertip's streams may have, by the words that profiles and results use.
//
// Thread-safety: constants.
#pragma once

#include "core/base/Stream.h"
#include "core/base/Words.h"

namespace tacto {

inline constexpr Word<StreamUnit> kRestUnits[] = {{"m/s2", StreamUnit::MetrePerSecondSquared},
                                                  {"count", StreamUnit::Count}};
inline constexpr Word<StreamUnit> kForceUnits[] = {{"N", StreamUnit::Newton}, {"count", StreamUnit::Count}};
inline constexpr Word<StreamUnit> kTaxelUnits[] = {{"Pa", StreamUnit::Pascal}, {"count", StreamUnit::Count}};

}  // namespace tacto
