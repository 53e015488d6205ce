// QuantityText.h - writes numbers with units, in the same way in the terminal, in reports and in sentences.
//
// GUM 7.2.6: an expanded uncertainty U (95 %) has two significant digits, and its value is rounded to the same place.
// If a value is far below its U (rounds to 0 at U's first digit), U has one digit, as in "0.0 ± 0.6 %", or two if the
// first is 1 or 2 and dropping one would round by a quarter. Units with prefixes are scaled (µs, mA, kΩ); other numbers
// too small or too large to be written out have a power of ten, never an "e".
//
// UTF-8; a plain space before the unit; "-" for a minus; "–" for an unknown value.
#pragma once

#include <string>
#include <string_view>

namespace tacto {

/// Returns a unit as people write it: "uC" → "µC", "ohm" → "Ω", "W/cm2" → "W/cm²".
[[nodiscard]] std::string writtenUnit(std::string_view unit);

/// Returns "2.26 mA", "10.0 kΩ", "12.3 %" with `digits` significant digits; whole numbers without prefix stay whole.
[[nodiscard]] std::string scaledText(double value, std::string_view unit, int digits = 4);

/// Writes a setting or a limit, without padding zeros: "10 mA", "100 µs", "0.25 W/cm²".
[[nodiscard]] std::string exactText(double value, std::string_view unit);

/// Returns "40.12 ± 0.46 V", "0.0 ± 0.6 %". An `expanded` of 0 means an exact value, such as a command; if it is not
/// finite or is negative, U is unknown: "40.12 V (U unknown)".
[[nodiscard]] std::string measuredText(double value, double expanded, std::string_view unit);

/// Returns the value with `decimals` decimals: "0.98", never "-0.00"; "–" for a value that is not finite.
[[nodiscard]] std::string decimalText(double value, int decimals);

/// The parts of a unit, for columns that share a prefix.
struct UnitParts {
    double factor = 1;  ///< from the given unit to its base
    std::string base;   ///< "A" for "mA"; empty for a unit that takes no prefix
};
/// `written`: as writtenUnit() returns it.
[[nodiscard]] UnitParts partsOfUnit(std::string_view written);
struct UnitPrefix {
    int exponent = 0;
    const char* symbol = "";
};
/// Returns the prefix for numbers from 10^exponent, from p to G.
[[nodiscard]] UnitPrefix prefixOf(int exponent) noexcept;
/// Returns the prefix for numbers in the unit `base`; forces from 0.01 N stay in N, on axes and in words.
[[nodiscard]] UnitPrefix prefixFor(std::string_view base, int exponent) noexcept;
/// Returns the decimal exponent of `value` rounded to `digits` significant digits: 3 for 999.96 with four. 0 for 0.
[[nodiscard]] int decimalExponent(double value, int digits);

}  // namespace tacto
