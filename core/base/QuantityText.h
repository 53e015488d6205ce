// QuantityText.h - how a number with a unit is written, the same in the terminal, in reports and in sentences.
//
// GUM 7.2.6: an expanded uncertainty U has two significant digits, and its value is rounded to the same place. A value
// far below its U (one that rounds to 0 at U's first digit) stands as "0.0 ± 0.6 %": of such a U one digit is kept,
// two where the first is 1 or 2 and dropping one would round by a quarter. Units that take prefixes are scaled (µs,
// mA, kΩ); other numbers too small or too large to be written out have a power of ten, never an "e".
//
// UTF-8; a plain space before the unit; "-" for a minus; "–" for an unknown value.
#pragma once

#include <string>
#include <string_view>

namespace tacto {

/// A unit as people write it: "uC" → "µC", "ohm" → "Ω", "W/cm2" → "W/cm²".
[[nodiscard]] std::string writtenUnit(std::string_view unit);

/// "2.26 mA", "10.0 kΩ", "12.3 %" with `digits` significant digits; whole numbers without a prefix stay whole.
[[nodiscard]] std::string scaledText(double value, std::string_view unit, int digits = 4);

/// A setting or a limit, without padding zeros: "10 mA", "100 µs", "0.25 W/cm²".
[[nodiscard]] std::string exactText(double value, std::string_view unit);

/// "40.12 ± 0.46 V", "0.0 ± 0.6 %". An `expanded` of 0 means that the value is exact, as a command is; one that is not
/// finite or below 0 is unknown, and is said to be: "40.12 V (U unknown)".
[[nodiscard]] std::string measuredText(double value, double expanded, std::string_view unit);

/// The value with as many decimals as asked for: "0.98", never "-0.00". "–" for a value that is not finite.
[[nodiscard]] std::string decimalText(double value, int decimals);

/// The parts of texts with units, for columns that share a prefix.
struct UnitParts {
    double factor = 1;  ///< factor from the given unit to its base
    std::string base;   ///< "A" of "mA"; empty for a unit that takes no prefix
};
/// `written`: as writtenUnit() gives it.
[[nodiscard]] UnitParts partsOfUnit(std::string_view written);
struct UnitPrefix {
    int exponent = 0;
    const char* symbol = "";
};
/// The prefix for numbers of 10^exponent and up, p to G.
[[nodiscard]] UnitPrefix prefixOf(int exponent) noexcept;
/// The prefix for numbers in the unit `base`: forces are read in N down to 0.01 N, on axes and in words alike.
[[nodiscard]] UnitPrefix prefixFor(std::string_view base, int exponent) noexcept;
/// The decimal exponent of `value` rounded to `digits` significant digits: 999.96 with four is 3. 0 for 0.
[[nodiscard]] int decimalExponent(double value, int digits);

}  // namespace tacto
