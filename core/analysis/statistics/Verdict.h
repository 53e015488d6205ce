// Verdict.h - the outcome of a judgement, and how to combine several outcomes.
//
// A verdict with a guard band (ISO 14253-1, science.md section 9) is a pass or a fail only if the uncertainty cannot
// reverse it.
#pragma once

#include <cmath>
#include <string_view>

#include "core/base/Words.h"

namespace tacto {

enum class Verdict { Pass, Fail, Indeterminate };
inline constexpr Word<Verdict> kVerdicts[] = {
    {"pass", Verdict::Pass}, {"fail", Verdict::Fail}, {"indeterminate", Verdict::Indeterminate}};
[[nodiscard]] constexpr std::string_view nameOf(Verdict verdict) noexcept { return wordFor(kVerdicts, verdict); }

/// Pass if |error| + U ≤ tolerance, fail if |error| - U > tolerance, otherwise indeterminate. Also indeterminate if a
/// value is NaN, U is negative or the tolerance is not positive (hazard H9).
[[nodiscard]] inline Verdict guardBanded(double error, double expandedUncertainty, double tolerance) noexcept {
    if (!(expandedUncertainty >= 0) || !(tolerance > 0)) return Verdict::Indeterminate;
    if (std::abs(error) + expandedUncertainty <= tolerance) return Verdict::Pass;
    if (std::abs(error) - expandedUncertainty > tolerance) return Verdict::Fail;
    return Verdict::Indeterminate;
}
/// Name of the guardBanded() verdict; "not evaluated" if the error or its uncertainty is NaN.
[[nodiscard]] inline std::string_view guardBandedName(double error, double expandedUncertainty,
                                                      double tolerance) noexcept {
    if (std::isnan(error) || std::isnan(expandedUncertainty)) return "not evaluated";
    return nameOf(guardBanded(error, expandedUncertainty, tolerance));
}

/// Fail if either is a fail, otherwise indeterminate if either is indeterminate, otherwise pass.
[[nodiscard]] constexpr Verdict worseOf(Verdict a, Verdict b) noexcept {
    if (a == Verdict::Fail || b == Verdict::Fail) return Verdict::Fail;
    return a == Verdict::Indeterminate ? a : b;
}

}  // namespace tacto
