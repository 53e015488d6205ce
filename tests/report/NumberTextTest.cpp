#include <QFontMetricsF>
#include <QJsonObject>
#include <QRegularExpression>
#include <cmath>
#include <gtest/gtest.h>
#include <random>

#include "app/report/Fonts.h"
#include "app/report/NumberText.h"
#include "core/base/QuantityText.h"

namespace tacto {
namespace {

// Replaces narrow no-break spaces by spaces.
std::string plain(QString text) { return text.replace(QChar(0x202f), ' ').toStdString(); }

TEST(NumberText, UsesEngineeringPrefixesAndFourDigits) {
    EXPECT_EQ(plain(quantityText(0.00226, "A", 3)), "2.26 mA");
    EXPECT_EQ(plain(quantityText(40, "V")), "40.00 V");
    EXPECT_EQ(plain(quantityText(1.28, "mJ", 3)), "1.28 mJ");
    EXPECT_EQ(plain(quantityText(0.25, "W/cm2", 3)), "250 mW/cm²");
    EXPECT_EQ(plain(quantityText(1500, "ohm", 3)), "1.50 kΩ");
    EXPECT_EQ(plain(quantityText(0.8, "uC", 3)), "800 nC");
}

TEST(NumberText, ZeroHasNoSignHoweverItIsWritten) {
    std::mt19937 random(49);
    std::uniform_real_distribution<double> exponent(-12, 0);
    for (int i = 0; i < 2000; ++i) {
        const double tiny = i % 10 == 0 ? -0.0 : -std::pow(10.0, exponent(random));
        for (const char* unit : {"", "mA", "%", "bit", "ohm"}) {
            const auto u = std::pow(10.0, exponent(random));
            for (const auto& text :
                 {quantityText(tiny, unit), quantityText(tiny, u, unit), spreadText(tiny, u, unit),
                  uncertainText(tiny, u, unit), settingText(tiny, unit), toleranceText(tiny, unit),
                  intervalText({tiny, tiny - u, u}, unit), proportionText({tiny, tiny, u}),
                  cellText(QJsonValue(tiny), unit), QString::fromStdString(decimalText(tiny, i % 5))})
                EXPECT_FALSE(text.contains(QRegularExpression("[-\u2212]0+([.]0+)?(?![0-9.])")))
                    << plain(text) << " of " << tiny;
        }
    }
}

TEST(NumberText, ATolerancesDigitsAreThoseThatAreKnown) {
    EXPECT_EQ(plain(toleranceText(80.1807e-6, "A")), "80 µA");
    EXPECT_EQ(plain(toleranceText(0.5, "%")), "0.5 %");
    EXPECT_EQ(plain(toleranceText(12.345, "ppm")), "12 ppm");
}

TEST(NumberText, RoundsBeforeItChoosesThePrefix) { EXPECT_EQ(plain(quantityText(0.99996, "s")), "1.000 s"); }

TEST(NumberText, GivesValueAndUncertaintyTheSameDecimals) {
    EXPECT_EQ(plain(quantityText(40.123, 0.4567, "V")), "40.12 ± 0.46 V");
    EXPECT_EQ(plain(quantityText(0.5, 0.0123, "s")), "500 ± 12 ms");
    EXPECT_EQ(plain(quantityText(10.0, 3.0, "V")), "10.0 ± 3.0 V");
}

TEST(NumberText, RoundsTheValueToThePlaceOfItsUncertainty) {
    EXPECT_EQ(plain(quantityText(2.00004, 4e-5, "s")), "2.000040 ± 0.000040 s");
    EXPECT_EQ(plain(uncertainText(0.012, 0.61, "%")), "0.0 ± 0.6 %");
    EXPECT_EQ(plain(uncertainText(1.679e-5, 4.2e-7, "s")), "16.79 ± 0.42 µs");
}

TEST(NumberText, SaysThatAnUncertaintyIsUnknown) {
    RecordProperty("hazard", "H9");
    EXPECT_EQ(plain(uncertainText(40.12, kUnknown, "V")), "40.12 V (U unknown)");
    EXPECT_EQ(plain(quantityText(40.12, kUnknown, "V")), "40.12 V") << "the spread of one reading is left out";
    const QJsonObject cell{{"value", 40.12}, {"expanded", QJsonValue::Null}, {"unit", "V"}};
    EXPECT_EQ(plain(cellText(cell, "")), "40.12 V (U unknown)");
}

TEST(NumberText, WritesNoNumberWithAnE) {
    EXPECT_EQ(plain(quantityText(-1.679e-5, "", 3)), "−1.68 × 10⁻⁵");
    EXPECT_EQ(plain(settingText(2e-5, "")), "2 × 10⁻⁵");
    EXPECT_EQ(plain(settingText(12'000'000, "")), "12000000");
}

TEST(NumberText, GivesAnAxisAPrefixOnlyWhereItsUnitTakesOne) {
    EXPECT_EQ(axisUnit(0.004, "%").unit, "%");
    EXPECT_EQ(axisUnit(0.004, "V").unit, "mV");
    EXPECT_EQ(axisUnit(0.004, "mA").unit, "µA");
    EXPECT_DOUBLE_EQ(axisUnit(0.004, "mA").factor, 1000);
}

TEST(NumberText, AnAxisHasTheUnitOfItsReadings) {
    for (const auto* unit : {"N", "V", "mA", "s", "Pa", "uC", "Hz"}) {
        for (const double most : {0.004, 0.012, 0.15, 0.5, 0.9999, 1.5, 40.0, 2e3}) {
            const auto reading = plain(quantityText(most, unit));
            EXPECT_EQ(reading.substr(reading.find(' ') + 1), axisUnit(most, unit).unit.toStdString()) << reading;
        }
    }
    EXPECT_EQ(axisUnit(0.5, "N").unit, "N") << "as Touch reads a weak force";
    EXPECT_EQ(axisUnit(0.5, "N").factor, 1);
    EXPECT_EQ(axisUnit(0.004, "N").unit, "mN");
    EXPECT_EQ(plain(uncertainText(0.153, 0.012, "N")), "0.153 ± 0.012 N");
    EXPECT_EQ(plain(quantityText(0.12, "N", *columnFormat({0.12, 0.15}, "N"))), "0.1200 N");
}

TEST(NumberText, SaysUnknownAsADash) {
    EXPECT_EQ(quantityText(kUnknown, "V"), QString("–"));
    EXPECT_EQ(quantityText(kUnknown, 1, "V"), QString("–"));
    EXPECT_EQ(quantityText(std::numeric_limits<double>::infinity(), "V"), QString("–"));
    EXPECT_EQ(cellText(QJsonValue::Null, "V"), QString("–"));
    EXPECT_EQ(proportionText({}), QString("–"));
}

TEST(NumberText, SaysHowLongSomethingTook) {
    EXPECT_EQ(plain(durationText(45.4)), "45 s");
    EXPECT_EQ(plain(durationText(98.6)), "1 min 39 s");
    EXPECT_EQ(plain(durationText(7500)), "2 h 5 min");
}

TEST(NumberText, UsesATrueMinus) { EXPECT_EQ(plain(quantityText(-0.5, "V", 3)), "−500 mV"); }

TEST(NumberText, WritesWhatRoundsToZeroWithoutAMinus) {
    EXPECT_EQ(plain(quantityText(-0.002, "N", ColumnFormat{0, 2})), "0.00 N");
    EXPECT_EQ(plain(quantityText(-0.006, "N", ColumnFormat{0, 2})), "−0.01 N");
    EXPECT_EQ(plain(quantityText(0.0, "N", ColumnFormat{0, 2})), "0.00 N");
}

TEST(NumberText, KeepsSettingsAsTheyWereSet) {
    EXPECT_EQ(plain(settingText(1000, "ohm")), "1 kΩ");
    EXPECT_EQ(plain(settingText(25, "")), "25");
    EXPECT_EQ(plain(settingText(0.15, "N")), "0.15 N");
}

TEST(NumberText, ReadsUnitsFromAColumnsKey) {
    EXPECT_EQ(columnName("net_charge_uc").title, "Net charge");
    EXPECT_EQ(columnName("net_charge_uc").unit, "µC");
    EXPECT_EQ(columnName("power_density_w_cm2").unit, "W/cm²");
    EXPECT_EQ(columnName("rms_5s_ma").title.toStdString(), "RMS 5\u202fs");
    EXPECT_EQ(columnName("n").title, "n");
    EXPECT_EQ(columnName("verdict").unit, "");
}

TEST(NumberText, WritesStatisticsAndEstimatesInCells) {
    EXPECT_EQ(plain(cellText(QJsonObject{{"mean", 40.123}, {"sd", 0.4567}}, "V")), "40.12, s.d. 0.46 V")
        << "± is kept for uncertainties";
    EXPECT_EQ(plain(cellText(QJsonObject{{"value", 1.5}, {"low", 1.2}, {"high", 1.8}}, "V")),
              "1.50 V (1.20 to 1.80 V)");
    EXPECT_EQ(cellText(true, ""), "yes");
}

QStringList shared(QStringList cells) {
    sharePrefix(cells);
    for (auto& cell : cells) cell.replace(QChar(0x202f), ' ');
    return cells;
}

TEST(NumberText, AColumnHasOnePrefixForEachUnit) {
    RecordProperty("hazard", "H8");
    EXPECT_EQ(shared({"−622.0 µV", "45.25 mV", "0 V"}), (QStringList{"−0.6220 mV", "45.25 mV", "0 mV"}));
    EXPECT_EQ(shared({"0.00 ± 0.06 V", "−6 ± 74 mV"}), (QStringList{"0.00 ± 0.06 V", "−0.006 ± 0.074 V"}));
    EXPECT_EQ(shared({"500.0 ms", "1.250 s", "500 Ω"}), (QStringList{"0.5000 s", "1.250 s", "500 Ω"}));
    EXPECT_EQ(shared({"500.0 ms", "2.000 s", "100.0 µs", "1.000 ms", "40.00 µs"}),
              (QStringList{"0.5000 s", "2.000 s", "0.1000 ms", "1.000 ms", "0.04000 ms"}))
        << "nothing becomes 0.0001000 s";
    EXPECT_EQ(shared({"12.74 ± 0.63 mV", "−0.6 ± 1.6 µs", "0 ± 4 ns"}),
              (QStringList{"12.74 ± 0.63 mV", "−0.6 ± 1.6 µs", "0.000 ± 0.004 µs"}));
    EXPECT_EQ(shared({"1.50 V (1.20 to 1.80 V)", "62 mV (U unknown)", "± 800 mV", "≤ 2 V", "–", ""}),
              (QStringList{"1.50 V (1.20 to 1.80 V)", "0.062 V (U unknown)", "± 0.800 V", "≤ 2 V", "–", ""}));
    EXPECT_EQ(shared({"40.12, s.d. 0.46 V", "120, s.d. 5 mV"}),
              (QStringList{"40.12, s.d. 0.46 V", "0.120, s.d. 0.005 V"}));
    EXPECT_EQ(shared({"40.0000 V", "3 pV"}), (QStringList{"40.0000 V", "3 pV"})) << "more than a thousand times apart";
    const QStringList sentences{"off by 3 mV into 2 V", "1 V and 2 mV", "200 Ω + 10 kΩ", "3 % of 2 V"};
    EXPECT_EQ(shared(sentences), sentences) << "a sentence keeps its words";
}

/// In the shared unit, each cell shows the same number with the same digits as it does alone. What is at least a
/// thousandth of the largest shares its unit.
TEST(NumberText, APrefixThatIsSharedChangesNoNumber) {
    RecordProperty("hazard", "H8");
    std::mt19937_64 random(20261129);
    const std::vector<std::pair<QString, double>> prefixes{{"p", 1e-12}, {"n", 1e-9}, {"µ", 1e-6}, {"m", 1e-3},
                                                           {"", 1},      {"k", 1e3},  {"M", 1e6}};
    const auto valueOf = [&](const QString& cell) {
        const auto number = cell.section(' ', 0, 0).replace(QString("−"), "-").toDouble();
        const auto unit = cell.section(' ', 1);
        for (const auto& [symbol, factor] : prefixes)
            if (unit == symbol + "V") return number * factor;
        ADD_FAILURE() << cell.toStdString();
        return kUnknown;
    };
    for (int round = 0; round < 500; ++round) {
        QStringList cells;
        for (auto rows = 1 + random() % 12; rows > 0; --rows) {
            const auto& prefix = prefixes[random() % prefixes.size()].first;
            const auto number = QString::number(double(random() % 1'000'000) / std::pow(10, random() % 6), 'f',
                                                static_cast<int>(random() % 5));
            cells << (random() % 2 == 0 ? "−" : "") + number + " " + prefix + "V";
        }
        const auto out = shared(cells);
        const auto smaller = [&](const QString& a, const QString& b) {
            return std::abs(valueOf(a)) < std::abs(valueOf(b));
        };
        const auto largest = std::ranges::max_element(out, smaller);
        for (qsizetype i = 0; i < cells.size(); ++i) {
            if (std::abs(valueOf(out[i])) > 1.0001e-3 * std::abs(valueOf(*largest))) {
                EXPECT_EQ(out[i].section(' ', 1), largest->section(' ', 1)) << cells.join(" | ").toStdString();
            }
            EXPECT_NEAR(valueOf(out[i]), valueOf(cells[i]), 1e-12 * std::abs(valueOf(cells[i])))
                << cells[i].toStdString() << " became " << out[i].toStdString();
        }
    }
}

TEST(NumberText, AnIntervalHasTwoDigitsOfItsHalfAndItsValueTheSamePlace) {
    EXPECT_EQ(plain(intervalText({273.9, 143.0, 405.5}, "")), "270 (140 to 410)");
    EXPECT_EQ(plain(intervalText({1, 0.6317, 1}, "")), "1.00 (0.63 to 1.00)");
    EXPECT_EQ(plain(intervalText({-0.3, -1.21, 0.6}, "%")), "−0.30 % (−1.21 to 0.60 %)");
    EXPECT_EQ(plain(intervalText({0.01234, 0.01201, 0.01267}, "A")), "12.34 mA (12.01 to 12.67 mA)");
    EXPECT_EQ(plain(intervalText({0.457, 0.337, 0.577}, "V")), "0.46 V (0.34 to 0.58 V)") << "no zero says nothing";
    EXPECT_EQ(plain(intervalText({1.5, kUnknown, 1.8}, "V")), "1.500 V");
    EXPECT_EQ(plain(intervalText({1.5, 1.5, 1.5}, "V")), "1.500 V (1.500 V to 1.500 V)");
    EXPECT_EQ(plain(intervalText({2.5, 2.5, 2.5 + 1e-12}, "")), "2.500 (2.500 to 2.500)");
    EXPECT_EQ(plain(intervalText({kUnknown, 1, 2}, "V")), "–");
}

TEST(NumberText, GivesComparableColumnsOneFormat) {
    const auto format = columnFormat({0.5, 2.0}, "s");
    ASSERT_TRUE(format);
    EXPECT_EQ(plain(quantityText(0.5, "s", *format)), "0.500 s");
    EXPECT_EQ(plain(quantityText(2.0, "s", *format)), "2.000 s");
    EXPECT_FALSE(columnFormat({1e-6, 2.0}, "s")) << "numbers that far apart keep their own prefixes";
    EXPECT_FALSE(columnFormat({1, 2, 3}, "")) << "counts stay counts";
}

TEST(NumberText, HasTheSignsOfAPage) {
    EXPECT_EQ(withSigns("off by -2.1 us (-3)"), "off by −2.1 us (−3)");
    EXPECT_EQ(withSigns("2026-11-26, EN 60601-2-10, x-1"), "2026-11-26, EN 60601-2-10, x-1");
    EXPECT_EQ(plain(withSigns("10 mA at 100 ohm, 1 kohm")), "10 mA at 100 Ω, 1 kΩ");
    EXPECT_EQ(withSigns("0.25 W/cm2, ohmic"), "0.25 W/cm², ohmic");
}

TEST(NumberText, TellsAFigureFromWords) {
    for (const char* figure : {"5", "−5.25", "± 200 mV", "−0.3 ± 1.2 %", "1.412 ± 0.071 mA/cm²", "10.0\u202fkΩ"})
        EXPECT_TRUE(isFigure(figure)) << figure;
    for (const char* words :
         {"", "–", "pass", "2026-11-26", "79 of 80", "99 % (93 to 100)", "5 to 6 V", "4, at least 3"})
        EXPECT_FALSE(isFigure(words)) << words;
}

TEST(NumberText, AUnitThatAColumnSharesIsTakenForItsHeader) {
    QStringList shared{"5.03\u202fmA", "–", "12.1 ± 0.4\u202fmA"};
    EXPECT_EQ(takeUnit(shared), "mA");
    EXPECT_EQ(shared, (QStringList{"5.03", "–", "12.1 ± 0.4"}));
    QStringList mixed{"5.03\u202fmA", "870\u202fµA"};
    EXPECT_EQ(takeUnit(mixed), "");
    EXPECT_EQ(mixed.front(), "5.03\u202fmA");
    QStringList bare{"5", "6"};
    EXPECT_EQ(takeUnit(bare), "");
}

TEST(NumberText, DecimalPointsStandOneBelowTheOther) {
    QStringList cells{"7 ± 11", "−2.1 ± 6.65", "–"};
    alignPoints(cells);
    const QString point(QChar(0x2008)), digit(QChar(0x2007));
    EXPECT_EQ(cells[0], "7" + point + digit + " ± 11" + point + digit + digit);
    EXPECT_EQ(cells[1], "−2.1 ± 6.65");
    EXPECT_EQ(cells[2], "–");
    // The widths of the values in the font of the reports.
    const QFontMetricsF metrics(textFont(11));
    EXPECT_NEAR(metrics.horizontalAdvance(digit), metrics.horizontalAdvance("0"), 0.01);
    EXPECT_NEAR(metrics.horizontalAdvance(point), metrics.horizontalAdvance("."), 0.01);
    QStringList units{"7\u202fmA", "2.25\u202fµA"};
    alignPoints(units);
    EXPECT_EQ(units.front(), "7\u202fmA") << "numbers of other units are not compared";
}

TEST(NumberText, GivesProportionsAsPercentages) {
    EXPECT_EQ(plain(proportionText({0.99, 0.9455, 0.9982})), "99.0 % (94.5 to 99.8 %)");
}

TEST(NumberText, WhatCannotBeSeenOrTurnsTheReadingDirectionIsNotShown) {
    RecordProperty("hazard", "H10");
    const auto shown = [](char32_t code) { return visible("a" + QString::fromUcs4(&code, 1) + "b"); };
    for (const char32_t code : {U'\u202e', U'\u200b', U'\ufff9', U'\U000e0041', U'\u0007', U'\u009b'})
        EXPECT_EQ(shown(code), QString("a") + QChar(QChar::ReplacementCharacter) + "b") << std::uint32_t(code);
    for (const char32_t code : {U'\n', U'\t', U'Ω', U'\U0001f600'})
        EXPECT_EQ(shown(code), "a" + QString::fromUcs4(&code, 1) + "b") << std::uint32_t(code);
}

}  // namespace
}  // namespace tacto
