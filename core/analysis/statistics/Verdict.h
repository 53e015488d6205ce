// Verdict.h - what a judgement says, and how verdicts add up.
//
// A verdict with a guard band (ISO 14253-1, science.md section 9) is a pass or a fail only where the uncertainty cannot
// turn it round.
//
// Thread-safety: pure functions.
#pragma once

#include <string_view>

namespace tacto {

enum class Verdict { Pass, Fail, Indeterminate };
[[nodiscard]] std::string_view nameOf(Verdict verdict) noexcept;  // "pass", "fail", "indeterminate"

/// Pass when |error| + U ≤ tolerance, fail when |error| - U > tolerance, else indeterminate. What is NaN, a negative U
/// or a tolerance that is not above 0 can prove nothing: indeterminate (hazard H9).
[[nodiscard]] Verdict guardBanded(double error, double expandedUncertainty, double tolerance) noexcept;
/// The name of guardBanded(); "not evaluated" where the error or its uncertainty is NaN.
[[nodiscard]] std::string_view guardBandedName(double error, double expandedUncertainty, double tolerance) noexcept;

/// Fail if either fails, else indeterminate if either is, else pass.
[[nodiscard]] Verdict worseOf(Verdict a, Verdict b) noexcept;

}  // namespace tacto
