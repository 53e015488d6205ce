#include "core/kinds/SessionComparison.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

#include "core/results/ResultRecord.h"

namespace tacto {

namespace {

using namespace describe;

ResultRecord<DifferentSetting> describeSetting() {
    using S = DifferentSetting;
    ResultRecord<S> all;
    all.shown(text("Setting or verdict", "name"), &S::name);
    all.shown(text("A", "a"), &S::a);
    all.shown(text("B", "b"), &S::b);
    return all;
}

ResultRecord<ComparedQuantity> describeQuantity() {
    using Q = ComparedQuantity;
    ResultRecord<Q> all;
    all.shown(text("Quantity", "name"), &Q::name);
    all.kept("unit", &Q::unit);
    all.shown(number("A", "a", "@unit"), &Q::a);
    all.shown(number("B", "b", "@unit"), &Q::b);
    all.shown(number("B less A, ± U", "difference", "@unit", "expanded_uncertainty"), &Q::difference);
    all.kept("expanded_uncertainty", &Q::expanded);
    all.shown(as(As::YesNo, "More than U", "more_than_u"), &Q::more);
    return all;
}

std::string summaryOf(const SessionComparison& comparison) {
    if (comparison.settings.empty() && comparison.quantities.empty()) return "The two sessions do not differ.";
    const auto more = std::ranges::count_if(comparison.quantities, [](const auto& q) { return q.more() == true; });
    const auto unknown = std::ranges::count_if(comparison.quantities, [](const auto& q) { return !q.more(); });
    return fmt::format("{} of {} quantities {} by more than U{}.", more, comparison.quantities.size(),
                       more == 1 ? "differs" : "differ",
                       unknown == 0 ? "" : fmt::format("; of {} that differ, U is not known", unknown));
}

ResultRecord<SessionComparison> describeComparison() {
    using C = SessionComparison;
    ResultRecord<C> all;
    all.kept("kind", [](const C&) { return std::string("comparison"); });
    all.kept("summary", summaryOf);
    all.table(sentences("Result", "summary"));
    all.rows("What was set or judged differently", "settings", &C::settings, describeSetting());
    all.rows("Quantities, the most significant first", "quantities", &C::quantities, describeQuantity()).note =
        "U is the 95 % uncertainty of the difference: of both readings, taken as independent. Quantities that are the "
        "same, and have no U, are left out.";
    return all;
}

/// Returns how far a quantity stands out; one with U before any without.
std::pair<bool, double> significanceOf(const ComparedQuantity& quantity) {
    const double size = std::abs(quantity.difference());
    const bool known = quantity.more().has_value();
    const double against = known ? quantity.expanded : std::max(std::abs(quantity.a), std::abs(quantity.b));
    const double ratio = size > 0 && against == 0 ? std::numeric_limits<double>::infinity()
                         : size == 0              ? 0
                                                  : size / against;
    return {known, ratio};
}

}  // namespace

std::optional<bool> ComparedQuantity::more() const noexcept {
    if (!std::isfinite(expanded) || !std::isfinite(difference())) return std::nullopt;
    return std::abs(difference()) > expanded;
}

void sortBySignificance(std::vector<ComparedQuantity>& quantities) {
    std::ranges::stable_sort(quantities, std::ranges::greater{}, significanceOf);
}

nlohmann::json toJson(const SessionComparison& comparison) { return describeComparison().write(comparison); }

ResultTraits comparisonKind() {
    return {.name = "comparison",
            .decisionRule = "A comparison: a difference counts if it is more than its uncertainty.",
            .tables = describeComparison().tables()};
}

}  // namespace tacto
