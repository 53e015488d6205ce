// NaN.h - the value of a number that is not known.
//
// Thread-safety: a constant.
#pragma once

#include <limits>

namespace tacto {

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

}  // namespace tacto
