// GivenFigure.h - numbers that a caller gives, checked by one table: what each is called and what is accepted of it.
#pragma once

#include <initializer_list>

#include "core/base/ValueKind.h"

namespace tacto {

struct GivenFigure {
    std::string_view name;  ///< begins the sentence: "the last estimate of the threshold"
    double value;
    AcceptedNumbers accepted;
};

/// Errors: InvalidArgument naming the first that is not accepted, its value and what is.
[[nodiscard]] inline Result<void> checkFigures(std::initializer_list<GivenFigure> figures) {
    for (const auto& each : figures) {
        if (!each.accepted.contain(each.value))
            return invalid("{} is {}; {} is accepted", each.name, each.value, each.accepted.text());
    }
    return {};
}

/// A count.
[[nodiscard]] inline GivenFigure givenCount(std::string_view name, std::size_t count, double low, double high) {
    return {name, static_cast<double>(count), {.low = low, .high = high, .whole = true}};
}
/// A figure above 0.
[[nodiscard]] inline GivenFigure givenAboveZero(std::string_view name, double value,
                                                double high = AcceptedNumbers{}.high) {
    return {name, value, {.low = 0, .high = high, .openLow = true}};
}

}  // namespace tacto
