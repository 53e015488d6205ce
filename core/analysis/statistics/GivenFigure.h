// GivenFigure.h - checks numbers from a caller against a table of their names and accepted values.
#pragma once

#include <initializer_list>

#include "core/base/ValueKind.h"

namespace tacto {

struct GivenFigure {
    std::string_view name;  ///< first words of the error message: "the last estimate of the threshold"
    double value;
    AcceptedNumbers accepted;
};

/// Errors: InvalidArgument for the first number that is not accepted, with its value and the accepted values.
[[nodiscard]] inline Result<void> checkFigures(std::initializer_list<GivenFigure> figures) {
    for (const auto& each : figures) {
        if (!each.accepted.contain(each.value))
            return invalid("{} is {}; {} is accepted", each.name, each.value, each.accepted.text());
    }
    return {};
}

/// Makes an entry for a whole number.
[[nodiscard]] inline GivenFigure givenCount(std::string_view name, std::size_t count, double low, double high) {
    return {name, static_cast<double>(count), {.low = low, .high = high, .whole = true}};
}
/// Makes an entry for a number above 0.
[[nodiscard]] inline GivenFigure givenAboveZero(std::string_view name, double value,
                                                double high = AcceptedNumbers{}.high) {
    return {name, value, {.low = 0, .high = high, .openLow = true}};
}

}  // namespace tacto
