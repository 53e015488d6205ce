#include "core/analysis/statistics/Verdict.h"

#include <cmath>

#include "core/base/Words.h"

namespace tacto {

namespace {
constexpr Word<Verdict> kVerdictWords[] = {
    {"pass", Verdict::Pass}, {"fail", Verdict::Fail}, {"indeterminate", Verdict::Indeterminate}};
}  // namespace

std::string_view nameOf(Verdict verdict) noexcept { return wordFor(kVerdictWords, verdict); }

Verdict guardBanded(double error, double expandedUncertainty, double tolerance) noexcept {
    if (!(expandedUncertainty >= 0) || !(tolerance > 0)) return Verdict::Indeterminate;
    if (std::abs(error) + expandedUncertainty <= tolerance) return Verdict::Pass;
    if (std::abs(error) - expandedUncertainty > tolerance) return Verdict::Fail;
    return Verdict::Indeterminate;
}

std::string_view guardBandedName(double error, double expandedUncertainty, double tolerance) noexcept {
    if (std::isnan(error) || std::isnan(expandedUncertainty)) return "not evaluated";
    return nameOf(guardBanded(error, expandedUncertainty, tolerance));
}

Verdict worseOf(Verdict a, Verdict b) noexcept {
    if (a == Verdict::Fail || b == Verdict::Fail) return Verdict::Fail;
    if (a == Verdict::Indeterminate || b == Verdict::Indeterminate) return Verdict::Indeterminate;
    return Verdict::Pass;
}

}  // namespace tacto
