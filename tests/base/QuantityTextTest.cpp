#include <cmath>
#include <gtest/gtest.h>
#include <limits>

#include "core/base/QuantityText.h"

namespace tacto {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

TEST(QuantityText, GivesUTwoDigitsAndItsValueTheSamePlace) {
    EXPECT_EQ(measuredText(40.123, 0.4567, "V"), "40.12 ± 0.46 V");
    EXPECT_EQ(measuredText(10, 3, "V"), "10.0 ± 3.0 V");
    EXPECT_EQ(measuredText(2.00004, 4e-5, "s"), "2.000040 ± 0.000040 s");
    EXPECT_EQ(measuredText(0.4573, 0.123, "V"), "0.46 ± 0.12 V") << "zeros of 460 ± 120 mV would say nothing";
    EXPECT_EQ(measuredText(1, 0.0996, "V"), "1.00 ± 0.10 V") << "0.0996 rounds to 0.10, not to 0.100";
    EXPECT_EQ(measuredText(12345, 678, ""), "12350 ± 680");
}

TEST(QuantityText, ScalesTheUnitToTheValue) {
    EXPECT_EQ(measuredText(1.679e-5, 4.2e-7, "s"), "16.79 ± 0.42 µs");
    EXPECT_EQ(measuredText(0.0042, 1.1e-4, "A"), "4.20 ± 0.11 mA");
    EXPECT_EQ(measuredText(7.9, 0.12, "uC"), "7.90 ± 0.12 µC");
    EXPECT_EQ(measuredText(1003, 11, "ohm"), "1.003 ± 0.011 kΩ");
    EXPECT_EQ(scaledText(0.25, "W/cm2", 3), "250 mW/cm²");
    EXPECT_EQ(scaledText(1.679e-05, "s", 3), "16.8 µs");
}

TEST(QuantityText, ZeroHasNoSign) {
    EXPECT_EQ(decimalText(-0.004, 2), "0.00");
    EXPECT_EQ(decimalText(-0.0, 1), "0.0");
    EXPECT_EQ(decimalText(-0.006, 2), "-0.01");
}

TEST(QuantityText, RoundsBeforeItChoosesThePrefix) {
    EXPECT_EQ(scaledText(999.96, "V", 3), "1.00 kV");
    EXPECT_EQ(scaledText(1e6, "S/s", 4), "1.000 MS/s");
    EXPECT_EQ(scaledText(-0.5, "V", 3), "-500 mV");
    EXPECT_EQ(scaledText(std::nan(""), "V"), "–");
    EXPECT_EQ(scaledText(std::numeric_limits<double>::infinity(), "Ω"), "–");
}

TEST(QuantityText, WritesAValueFarBelowItsUncertaintyAsZero) {
    EXPECT_EQ(measuredText(-5.5e-11, 4e-7, "s"), "0.0 ± 0.4 µs");
    EXPECT_EQ(measuredText(0, 4e-7, "s"), "0.0 ± 0.4 µs");
    EXPECT_EQ(measuredText(0.012, 0.61, "%"), "0.0 ± 0.6 %");
    EXPECT_EQ(measuredText(-0.012, 0.61, "%"), "0.0 ± 0.6 %") << "zero has no sign";
    EXPECT_EQ(measuredText(0.002, 0.14, "%"), "0.00 ± 0.14 %") << "0.1 would be a quarter too small";
    EXPECT_EQ(measuredText(0.32, 0.61, "%"), "0.32 ± 0.61 %");
}

TEST(QuantityText, SaysThatAnUncertaintyIsUnknownAndNeverZero) {
    RecordProperty("hazard", "H9");
    EXPECT_EQ(measuredText(40.12, kUnknown, "V"), "40.12 V (U unknown)");
    EXPECT_EQ(measuredText(40.12, -1, "V"), "40.12 V (U unknown)");
    EXPECT_EQ(measuredText(kUnknown, 1, "V"), "–");
    EXPECT_EQ(measuredText(40, 0, "V"), "40.00 V") << "a command is exact";
}

TEST(QuantityText, WritesNoExponentWithAnE) {
    EXPECT_EQ(scaledText(1.679e-5, "", 3), "1.68 × 10⁻⁵");
    EXPECT_EQ(scaledText(2.5e8, "", 3), "2.50 × 10⁸");
    EXPECT_EQ(measuredText(1.2e-7, 3e-9, ""), "(1.200 ± 0.030) × 10⁻⁷");
    for (const double value : {1e-12, 3.3e-9, 1.679e-5, 0.02, 7.0, 1e5, 1e9}) {
        for (const auto* unit : {"", "s", "V", "%", "mA/cm2"}) {
            EXPECT_EQ(scaledText(value, unit).find('e'), std::string::npos) << value << unit;
            EXPECT_EQ(measuredText(value, value / 7, unit).find('e'), std::string::npos) << value << unit;
        }
    }
}

TEST(QuantityText, PadsNothingThatWasSet) {
    EXPECT_EQ(exactText(10, "mA"), "10 mA");
    EXPECT_EQ(exactText(1e-4, "s"), "100 µs");
    EXPECT_EQ(exactText(0.25, "W/cm2"), "250 mW/cm²");
    EXPECT_EQ(exactText(0.5, "s"), "500 ms");
    EXPECT_EQ(exactText(2.5, "%"), "2.5 %");
    EXPECT_EQ(exactText(40, ""), "40");
    EXPECT_EQ(exactText(12'345'678, ""), "12345678");
    EXPECT_EQ(exactText(-0.0, "mA"), "0 mA");
    EXPECT_EQ(exactText(2e-5, ""), "2 × 10⁻⁵");
    EXPECT_EQ(exactText(std::nan(""), "V"), "–");
}

TEST(QuantityText, KnowsUnitsAndTheirPrefixes) {
    EXPECT_EQ(writtenUnit("uC"), "µC");
    EXPECT_EQ(writtenUnit("kohm"), "kΩ");
    EXPECT_EQ(writtenUnit("degC"), "°C");
    EXPECT_EQ(partsOfUnit("mA").base, "A");
    EXPECT_DOUBLE_EQ(partsOfUnit("µs").factor, 1e-6);
    EXPECT_EQ(partsOfUnit("m").base, "") << "a metre, not a thousandth of nothing";
    EXPECT_EQ(partsOfUnit("%").base, "");
    EXPECT_EQ(decimalExponent(999.96, 4), 3);
}

}  // namespace
}  // namespace tacto
