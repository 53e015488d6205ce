// SessionComparison.h - how two sessions differ, A and B: settings and verdicts as words, quantities with the expanded
// uncertainty of their difference. Shown in the tables of its kind, like results.
//
// Thread-safety: values and pure functions.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/base/Statistics.h"
#include "core/results/ResultKind.h"

namespace tacto {

/// A setting, a device, a label or a verdict that is not the same in both. Null: not recorded.
struct DifferentSetting {
    std::string name;
    nlohmann::json a, b;
};

struct ComparedQuantity {
    std::string name;
    std::string unit;  ///< empty for plain numbers
    double a = kNaN, b = kNaN;
    double expanded = kNaN;  ///< U (95 %) of the difference, in `unit`; NaN: not known
    [[nodiscard]] double difference() const noexcept { return b - a; }
    /// Whether the difference is more than U; nothing if U is not known.
    [[nodiscard]] std::optional<bool> more() const noexcept;
};

struct SessionComparison {
    std::vector<DifferentSetting> settings;
    std::vector<ComparedQuantity> quantities;  ///< the most significant first; those of unknown U last
};

/// Sorts by |difference| / U; quantities without U follow, by their relative difference.
void sortBySignificance(std::vector<ComparedQuantity>& quantities);

[[nodiscard]] nlohmann::json toJson(const SessionComparison& comparison);
[[nodiscard]] ResultTraits comparisonKind();

}  // namespace tacto
