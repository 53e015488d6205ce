#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/analysis/calibration/Calibration.h"
#include "core/analysis/calibration/CalibrationJson.h"
#include "core/base/Statistics.h"
#include "tests/analysis/calibration/CalibrationTwin.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;

/// Fits a line by the textbook's sums, in the readings' own unit.
std::pair<double, double> lineThrough(const std::vector<CalibrationReading>& readings) {
    double n = 0, x = 0, y = 0, xx = 0, xy = 0;
    for (const auto& r : readings) {
        const double w = r.uncertainty > 0 ? 1 / (r.uncertainty * r.uncertainty) : 1;
        n += w;
        x += w * r.commanded;
        y += w * r.measured;
        xx += w * r.commanded * r.commanded;
        xy += w * r.commanded * r.measured;
    }
    const double gain = (n * xy - x * y) / (n * xx - x * x);
    return {gain, (y - gain * x) / n};
}

TEST(Calibration, FindsTheLineOfTheTextbook) {
    const auto readings = CalibrationTwin{}.run(3);
    const auto found = fitCalibration(readings);
    ASSERT_TRUE(found);
    const auto [gain, offset] = lineThrough(readings);
    EXPECT_NEAR(found->gain, gain, 1e-12);
    EXPECT_NEAR(found->offset, offset, 1e-10);
    EXPECT_FALSE(found->weighted);
    EXPECT_TRUE(found->complete);
    EXPECT_TRUE(found->warnings.empty());
}

TEST(Calibration, FindsWhatATwinWithoutScatterIsMadeOf) {
    CalibrationTwin twin;
    twin.jitter = 0;
    const auto found = fitCalibration(twin.run(1));
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->gain, twin.gain, 1e-12);
    EXPECT_NEAR(found->offset, twin.offset, 1e-10);
    EXPECT_NEAR(found->hysteresis_pct, 100 * 0.08 / 40, 1e-10);
    EXPECT_NEAR(found->repeatability_pct, 0, 1e-10);
    EXPECT_NEAR(found->residualMax_pct, 0, 1e-10);  // hysteresis cancels in the level means
    EXPECT_DOUBLE_EQ(found->fullScale, 40);
}

TEST(Calibration, PoolsWithinLevelAndDirection) {
    // s of 1, 2, 3 is 1, and s of 10, 14 is √8; pooled √((2·1 + 1·8)/3). The step between up and down is not scatter.
    const auto found = fitCalibration(std::vector<CalibrationReading>{{10, 1, SweepDirection::Up},
                                                                      {10, 2, SweepDirection::Up},
                                                                      {10, 3, SweepDirection::Up},
                                                                      {10, 10, SweepDirection::Down},
                                                                      {10, 14, SweepDirection::Down},
                                                                      {20, 5, SweepDirection::Up}});
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->repeatability, std::sqrt(10.0 / 3), 1e-12);
    EXPECT_NEAR(found->repeatability_pct, 100 * std::sqrt(10.0 / 3) / 20, 1e-10);
    EXPECT_NEAR(found->hysteresis_pct, 100 * 10.0 / 20, 1e-10);
    EXPECT_DOUBLE_EQ(found->degreesOfFreedom, 3);
    EXPECT_FALSE(found->complete);
}

TEST(Calibration, TheResidualIsThatOfTheLevelMean) {
    std::vector<CalibrationReading> readings;
    for (int k = 0; k <= 4; ++k) {
        const double bow = k == 2 ? 1.0 : 0.0;
        readings.push_back({k * 10.0, k * 10.0 + bow + 0.5});
        readings.push_back({k * 10.0, k * 10.0 + bow - 0.5});
    }
    const auto found = fitCalibration(readings);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->gain, 1, 1e-12);
    EXPECT_NEAR(found->offset, 0.2, 1e-10);
    EXPECT_NEAR(found->residualMax_pct, 100 * 0.8 / 40, 1e-10);
    EXPECT_TRUE(std::isnan(found->hysteresis_pct));  // the direction was not stated
}

TEST(Calibration, IsWeightedOnlyWhenEveryReadingCarriesItsUncertainty) {
    std::vector<CalibrationReading> readings{{1, 1.1}, {2, 2.3}, {3, 2.9}, {4, 4.6}};
    for (std::size_t i = 0; i < readings.size(); ++i) readings[i].uncertainty = 0.1 * static_cast<double>(i + 1);
    const auto weighted = fitCalibration(readings);
    ASSERT_TRUE(weighted);
    EXPECT_TRUE(weighted->weighted);
    EXPECT_NEAR(weighted->gain, lineThrough(readings).first, 1e-12);
    EXPECT_NEAR(weighted->offset, lineThrough(readings).second, 1e-12);

    readings[1].uncertainty = kNaN;
    const auto partly = fitCalibration(readings);
    ASSERT_TRUE(partly);
    EXPECT_FALSE(partly->weighted);
    for (auto& r : readings) r.uncertainty = kNaN;
    EXPECT_DOUBLE_EQ(partly->gain, fitCalibration(readings)->gain);
    EXPECT_THAT(partly->warnings, testing::Contains(HasSubstr("3 of 4 readings carry an uncertainty")));
}

TEST(Calibration, AReadingThatStandsOutIsMarkedAndKept) {
    RecordProperty("hazard", "H9");
    auto readings = CalibrationTwin{}.run(5);
    const auto clean = fitCalibration(readings);
    ASSERT_TRUE(clean);
    EXPECT_EQ(clean->outliers, 0U);
    readings[17].measured += 2;
    const auto found = fitCalibration(readings);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->outliers, 1U);
    EXPECT_TRUE(found->readings[17].outlier);
    EXPECT_THAT(found->warnings, testing::Contains(HasSubstr("1 of 110 readings stand out")));
    EXPECT_NEAR(found->gain, lineThrough(readings).first, 1e-12);
    EXPECT_GT(found->repeatability, clean->repeatability);
}

TEST(Calibration, WhatLiesWithinTheResolutionDoesNotStandOut) {
    // Nearly all repeats agree. One differs by less than the step of the clock that timed them.
    CalibrationTwin twin;
    twin.jitter = 1e-6;
    auto readings = twin.run(5);
    readings[40].measured += 0.002;
    EXPECT_EQ(fitCalibration(readings)->outliers, 1U);
    EXPECT_EQ(fitCalibration(readings, {.resolution = 0.0025})->outliers, 0U);
    EXPECT_FALSE(fitCalibration(readings, {.resolution = kNaN}));
}

TEST(Calibration, CommandsThatDifferALittleAreOneLevelAndTheirDifferenceNoScatter) {
    CalibrationTwin twin;
    twin.gain = 1;
    twin.jitter = 0;
    twin.hysteresis = 0;
    auto readings = twin.run(1);
    for (std::size_t i = 0; i < readings.size(); ++i) {
        const double programmed = 0.05 * std::sin(static_cast<double>(i));
        readings[i].commanded += programmed;
        readings[i].measured += programmed;
    }
    const auto found = fitCalibration(readings, {.sameLevel = 0.01});
    ASSERT_TRUE(found);
    EXPECT_EQ(found->levels.size(), 11U);
    EXPECT_NEAR(found->repeatability, 0, 1e-9);
    EXPECT_NEAR(found->offset, 0.15, 1e-9);
    EXPECT_GT(fitCalibration(readings)->levels.size(), 100U);
    EXPECT_FALSE(fitCalibration(readings, {.sameLevel = -1}));
    EXPECT_FALSE(fitCalibration(readings, {.sameLevel = kNaN}));
}

TEST(Calibration, MarksFewOfAHealthyDevicesReadings) {
    std::size_t marked = 0;
    for (std::uint64_t seed = 1; seed <= 200; ++seed) marked += fitCalibration(CalibrationTwin{}.run(seed))->outliers;
    EXPECT_LE(marked, 1U);  // of 22 000
}

TEST(Calibration, AReadingThatWasNotMeasuredIsCounted) {
    auto readings = CalibrationTwin{}.run(5);
    readings[3].measured = kNaN;
    const auto found = fitCalibration(readings);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->notMeasured, 1U);
    EXPECT_FALSE(found->complete);
    EXPECT_THAT(found->warnings, testing::Contains(HasSubstr("1 of 110 readings")));
}

TEST(Calibration, RefusesWhatHasNoLine) {
    const auto refusal = [](std::vector<CalibrationReading> readings) {
        const auto found = fitCalibration(readings);
        EXPECT_FALSE(found);
        return found ? std::string() : found.error().message;
    };
    EXPECT_THAT(refusal({}), HasSubstr("at least two levels"));
    EXPECT_THAT(refusal({{10, 1}, {10, 2}}), HasSubstr("1 levels"));
    EXPECT_THAT(refusal({{10, 1}, {20, kNaN}}), HasSubstr("1 levels"));
    EXPECT_THAT(refusal({{0, 1}, {0, 2}}), HasSubstr("other than 0"));
    EXPECT_THAT(refusal({{kNaN, 1}, {20, 1}}), HasSubstr("reading 1"));
    EXPECT_THAT(refusal({{10, 1}, {20, INFINITY}}), HasSubstr("reading 2"));
    EXPECT_THAT(refusal({{10, 1}, {20, 1, SweepDirection::Up, -0.1}}), HasSubstr("uncertainty -0.1"));
}

TEST(CalibrationVerdict, PassesFailsOrLeavesOpen) {
    RecordProperty("hazard", "H9");
    CalibrationTwin twin;
    twin.gain = 1;
    twin.offset = 0;
    twin.hysteresis = 0.02;
    const InstrumentErrors stated{.gainTolerance = 0.005, .offsetTolerance = 0.05, .resolution = 0.025};
    const auto verdict = [&](double tolerance) {
        const auto judged = judgeCalibration(*fitCalibration(twin.run(2)), stated, tolerance, {1, 5000});
        EXPECT_TRUE(judged);
        return judged->verdict;
    };
    EXPECT_EQ(verdict(2), Verdict::Pass);
    EXPECT_EQ(verdict(0.5), Verdict::Indeterminate);  // the oscilloscope is not accurate enough to decide
    twin.gain = 1.05;
    EXPECT_EQ(verdict(2), Verdict::Fail);
    EXPECT_EQ(verdict(20), Verdict::Pass);
    twin.levels = 10;
    EXPECT_EQ(verdict(20), Verdict::Indeterminate);  // too few levels to pass
    EXPECT_EQ(verdict(2), Verdict::Fail);
}

TEST(CalibrationVerdict, HysteresisCannotHideInTheMean) {
    RecordProperty("hazard", "H9");
    CalibrationTwin twin;
    twin.gain = 1;
    twin.offset = 0;
    twin.jitter = 0.001;
    twin.hysteresis = 3;  // ± 1.5 V around a mean without error
    twin.instrument.unit = "V";
    const auto judged = judgeCalibration(*fitCalibration(twin.run(2)), twin.instrument, 2, {1, 5000});
    ASSERT_TRUE(judged);
    EXPECT_EQ(judged->verdict, Verdict::Fail);
    EXPECT_NEAR(judged->fullScale().error, 0, 0.01);
    EXPECT_NEAR(std::abs(judged->fullScale().worstError), 1.5, 0.01);
    EXPECT_NE(judged->reasons.front().find(" V, tolerance"), std::string::npos) << judged->reasons.front();
}

TEST(CalibrationVerdict, WithoutRepeatsThereIsNoUncertainty) {
    const auto found = fitCalibration(std::vector<CalibrationReading>{{10, 10}, {20, 20}, {30, 30}});
    ASSERT_TRUE(found);
    const auto judged = judgeCalibration(*found, {}, 2);
    ASSERT_FALSE(judged);
    EXPECT_THAT(judged.error().message, HasSubstr("not repeated"));
    EXPECT_FALSE(judgeCalibration(*fitCalibration(CalibrationTwin{}.run(1)), {}, 0));
    EXPECT_FALSE(judgeCalibration(*fitCalibration(CalibrationTwin{}.run(1)), {}, kNaN));
}

TEST(CalibrationVerdict, SamplingCountsWhereTheScatterDoesNotShowIt) {
    CalibrationTwin twin;
    twin.jitter = 1e-9;
    twin.instrument.samplingStep = 0.01;
    const auto locked = judgeCalibration(*fitCalibration(twin.run(1)), twin.instrument, 2, {1, 5000});
    ASSERT_TRUE(locked);
    EXPECT_EQ(locked->fullScale().budget.rows.back().name, "sampling");
    EXPECT_NEAR(locked->fullScale().budget.combined, 0.01 / std::sqrt(6.0), 1e-6);
    twin.jitter = 0.01;
    const auto free = judgeCalibration(*fitCalibration(twin.run(1)), twin.instrument, 2, {1, 5000});
    ASSERT_TRUE(free);
    EXPECT_NE(free->fullScale().budget.rows.back().name, "sampling");
}

TEST(Calibration, MoreReadingsThanAnyRunTakesAreRefusedAtOnce) {
    RecordProperty("hazard", "H10");
    // Each repeat is compared with all others: 400 000 at one level would need too much memory, and time before a stop.
    std::vector<CalibrationReading> many(kMaxReadings + 1);
    for (std::size_t i = 0; i < many.size(); ++i) {
        many[i].commanded = 1 + static_cast<double>(i % 2);
        many[i].measured = many[i].commanded;
    }
    const auto refused = fitCalibration(many, {});
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().message, "calibration: 5001 readings; at most 5000 are expected");
    many.pop_back();
    EXPECT_TRUE(fitCalibration(many, {}));
}

TEST(CalibrationFile, ReadsColumnsInAnyOrderAndNamesFileAndLine) {
    const auto read = parseCalibrationReadings(
        "# bench 3\n u , direction, commanded ,note, measured\n0.1,up,10,a,10.2\n,down,20,b,\n", "levels.csv");
    ASSERT_TRUE(read) << read.error().message;
    ASSERT_EQ(read->size(), 2U);
    EXPECT_EQ((*read)[0].direction, SweepDirection::Up);
    EXPECT_DOUBLE_EQ((*read)[0].uncertainty, 0.1);
    EXPECT_DOUBLE_EQ((*read)[0].measured, 10.2);
    EXPECT_EQ((*read)[1].direction, SweepDirection::Down);
    EXPECT_TRUE(std::isnan((*read)[1].measured));

    const auto refusal = [](std::string_view text) {
        const auto made = parseCalibrationReadings(text, "bad.csv");
        EXPECT_FALSE(made) << text;
        return made ? std::string() : made.error().message;
    };
    EXPECT_THAT(refusal(""), HasSubstr("empty"));
    EXPECT_THAT(refusal("commanded,reading\n1,2\n"), HasSubstr("bad.csv:1: no column 'measured'"));
    EXPECT_THAT(refusal("measured\n1\n"), HasSubstr("'commanded'"));
    EXPECT_THAT(refusal("commanded,measured\n"), HasSubstr("nothing after"));
    EXPECT_THAT(refusal("commanded,measured\n1,2\nten,2\n"), HasSubstr("bad.csv:3: commanded 'ten'"));
    EXPECT_THAT(refusal("commanded,measured\n,2\n"), HasSubstr("bad.csv:2: commanded ''"));
    EXPECT_THAT(refusal("commanded,measured\n1,inf\n"), HasSubstr("measured 'inf'"));
    EXPECT_THAT(refusal("commanded,measured\n1\n"), HasSubstr("1 fields"));
    EXPECT_THAT(refusal("commanded,measured,direction\n1,2,sideways\n"), HasSubstr("'sideways'"));
    EXPECT_THAT(refusal("commanded,measured,u\n1,2,-0.1\n"), HasSubstr("u '-0.1'"));
}

TEST(CalibrationJson, HasTheContractsKeysAndNullForWhatIsNotKnown) {
    const auto json = toJson(*fitCalibration(std::vector<CalibrationReading>{{10, 10}, {20, 21}}));
    for (const char* key : {"gain", "offset", "residual_max_pct_fs"}) EXPECT_TRUE(json.at(key).is_number()) << key;
    EXPECT_TRUE(json.at("hysteresis_pct_fs").is_null());
    EXPECT_TRUE(json.at("repeatability_pct_fs").is_null());
    CalibrationTwin twin;
    const auto judged = toJson(*judgeCalibration(*fitCalibration(twin.run(1)), twin.instrument, 2, {1, 5000}));
    for (const char* key : {"expanded_uncertainty", "hysteresis_pct_fs", "repeatability_pct_fs"}) {
        EXPECT_TRUE(judged.at(key).is_number()) << key;
    }
    EXPECT_EQ(judged.at("verdict"), "fail");
    EXPECT_EQ(judged.at("budget").at("rows").at(0).at("name"), "repeatability");
    EXPECT_EQ(judged.at("levels").size(), 11U);
}

}  // namespace
}  // namespace tacto::test
