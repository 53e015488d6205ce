// Verdict.h - what a judgement says, and how verdicts add up.
//
// A verdict with a guard band (ISO 14253-1, science.md section 9) is a pass or a fail only where the uncertainty cannot
// turn it round.
#pragma once

#include <cmath>
#include <string_view>

#include "core/base/Words.h"

namespace tacto {

enum class Verdict { Pass, Fail, Indeterminate };
inline constexpr Word<Verdict> kVerdicts[] = {
    {"pass", Verdict::Pass}, {"fail", Verdict::Fail}, {"indeterminate", Verdict::Indeterminate}};
[[nodiscard]] constexpr std::string_view nameOf(Verdict verdict) noexcept { return wordFor(kVerdicts, verdict); }

/// Pass when |error| + U ≤ tolerance, fail when |error| - U > tolerance, else indeterminate. What is NaN, a negative U
/// or a tolerance that is not above 0 can prove nothing: indeterminate (hazard H9).
[[nodiscard]] inline Verdict guardBanded(double error, double expandedUncertainty, double tolerance) noexcept {
    if (!(expandedUncertainty >= 0) || !(tolerance > 0)) return Verdict::Indeterminate;
    if (std::abs(error) + expandedUncertainty <= tolerance) return Verdict::Pass;
    if (std::abs(error) - expandedUncertainty > tolerance) return Verdict::Fail;
    return Verdict::Indeterminate;
}
/// The name of guardBanded(); "not evaluated" where the error or its uncertainty is NaN.
[[nodiscard]] inline std::string_view guardBandedName(double error, double expandedUncertainty,
                                                      double tolerance) noexcept {
    if (std::isnan(error) || std::isnan(expandedUncertainty)) return "not evaluated";
    return nameOf(guardBanded(error, expandedUncertainty, tolerance));
}

/// Fail if either fails, else indeterminate if either is, else pass.
[[nodiscard]] constexpr Verdict worseOf(Verdict a, Verdict b) noexcept {
    if (a == Verdict::Fail || b == Verdict::Fail) return Verdict::Fail;
    return a == Verdict::Indeterminate ? a : b;
}

}  // namespace tacto
