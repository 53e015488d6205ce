#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "core/analysis/load_safety/LimitMatrix.h"
#include "core/analysis/load_safety/LoadSafety.h"
#include "core/analysis/load_safety/LoadSafetyJson.h"
#include "tests/analysis/load_safety/LoadCaptures.h"
#include "tests/support/Limits.h"
#include "tests/support/Support.h"

namespace tacto {
namespace {

using test::loadCaptures;
using test::LoadTruth;

/// A check without faults: every load of the set (for the skin equivalent, its final resistance), every trip, and the
/// strongest command of the paper if it is allowed.
class LoadSafetyCheck : public testing::Test {
protected:
    void SetUp() override {
        input.limits = test::limitSets();
        input.source.amplitudeMax = 100;
        input.source.compliance = Volts(100);
        input.area_cm2 = 3.0;
        for (const auto& named : benchLoads()) {
            LoadRecord record;
            record.name = named.name;
            record.load = named.load;
            const bool skin = named.load.kind == LoadKind::SkinEquivalent;
            if (named.load.kind == LoadKind::Resistor || skin) {
                LoadTruth truth;
                truth.ohms = skin ? 10'200 : named.load.series.value();
                truth.volts = truth.ohms < 200 ? 20 : 40;
                record.steps.push_back(step(truth));
            }
            input.loads.push_back(record);
        }
        for (const auto name : kRequiredTrips) input.trips.push_back({std::string(name), true, true, 0.1, "tripped"});
        input.reference = judgeReference(input.loads[2], input);
        input.openCircuit = step({});
    }

    static LoadStep step(const LoadTruth& truth, double command = 0) {
        LoadStep out;
        out.command_v = command > 0 ? command : truth.volts;
        out.interval_s = 0.5;
        out.reading =
            readLoad(loadCaptures(truth), ExpectedTrain{.programmed = {out.command_v, out.command_v}}).value();
        return out;
    }
    /// Records trains of three pulses into each load, at the rate that the device makes of 100 Hz.
    void driveTrains(double hz) {
        input.train.pulses = 3;
        input.train.rate = Hertz(100);
        for (auto& record : input.loads) {
            for (auto& each : record.steps) {
                LoadTruth truth;
                truth.pulses = 3;
                truth.train_hz = hz;
                truth.rate_hz = 2e6;
                truth.ohms = record.load.kind == LoadKind::SkinEquivalent ? 10'200 : record.load.series.value();
                truth.volts = truth.ohms < 250 ? 10 : 40;
                each.command_v = truth.volts;
                const ExpectedTrain expected{.pulses = 3, .rate_hz = 100, .programmed = {truth.volts, truth.volts}};
                each.reading = readLoad(loadCaptures(truth), expected).value();
            }
        }
    }
    LoadRecord& at(std::string_view name) {
        return *std::find_if(input.loads.begin(), input.loads.end(), [&](const auto& r) { return r.name == name; });
    }
    static const SafetyRow& rowOf(const LoadSafety& found, std::string_view load, std::string_view item) {
        const auto row = std::find_if(found.rows.begin(), found.rows.end(),
                                      [&](const auto& r) { return r.load == load && r.item == item; });
        if (row == found.rows.end()) throw std::runtime_error("no such row");
        return *row;
    }

    LoadSafetyInput input;
};

TEST_F(LoadSafetyCheck, PassesWhenEverythingIsMeasuredAndWithin) {
    const auto found = judgeLoadSafety(input);
    EXPECT_EQ(found.verdict, Verdict::Pass) << found.reasons.front();
    const auto passed = std::count_if(found.rows.begin(), found.rows.end(),
                                      [](const SafetyRow& row) { return row.verdict == RowVerdict::Pass; });
    ASSERT_EQ(found.reasons.size(), 1U);
    // The sentence about passed rows is true for each row, since commands and trips have no uncertainty.
    const auto those = [&found](auto wanted) {
        return std::count_if(found.rows.begin(), found.rows.end(),
                             [&](const SafetyRow& row) { return row.verdict == RowVerdict::Pass && wanted(row); });
    };
    const auto withU = those([](const SafetyRow& row) {
        return row.basis == RowBasis::Measured && row.item != "trip" && std::isfinite(row.expanded);
    });
    const auto commanded = those([](const SafetyRow& row) { return row.basis == RowBasis::Commanded; });
    const auto trips = those([](const SafetyRow& row) { return row.item == "trip"; });
    EXPECT_GT(commanded, 0);
    EXPECT_GT(trips, 0);
    EXPECT_EQ(withU + commanded + trips, passed);
    EXPECT_TRUE(found.reasons.front().starts_with(
        fmt::format("{} checks on {} loads passed: {} values with their uncertainty inside their limits, {} as "
                    "commanded, {} by the end of output in time",
                    passed, benchLoads().size(), withU, commanded, trips)))
        << found.reasons.front();
    EXPECT_EQ(found.loads.size(), benchLoads().size());
    for (const auto& line : found.loads) EXPECT_EQ(line.verdict, RowVerdict::Pass) << line.name;
    EXPECT_EQ(found.worstCase.verdict, RowVerdict::Pass);
    EXPECT_GE(found.worstCase.amplitudeFactor.value, 1.0);
    EXPECT_LE(found.worstCase.amplitudeFactor.value, 1.01);
}

/// The line of the matrix for what must end by itself, with its cells for an open and a short circuit.
class LoadSafetyTrips : public LoadSafetyCheck {
protected:
    TripTrial& trip(std::string_view name) {
        return *std::find_if(input.trips.begin(), input.trips.end(), [&](const auto& t) { return t.name == name; });
    }
    LimitLine line() {
        matrix = limitMatrixOf(judgeLoadSafety(input), input.limits);
        return *std::find_if(matrix.lines.begin(), matrix.lines.end(), [](const auto& l) { return l.item == "trip"; });
    }
    LimitCell cell(std::string_view load) {
        const auto cells = line().cells;
        const auto at = std::find(matrix.loads.begin(), matrix.loads.end(), load) - matrix.loads.begin();
        return cells.at(static_cast<std::size_t>(at)).value();
    }

    LimitMatrix matrix;  // the matrix that line() or cell() last looked at
};

TEST_F(LoadSafetyTrips, AreALineOfTheMatrixWithTheLongerTime) {
    trip("open while delivering").after_s = 0.49;
    const auto found = line();
    EXPECT_EQ(found.title, "output ends by itself");
    EXPECT_EQ(found.verdict, RowVerdict::Pass);
    EXPECT_EQ(std::count_if(found.cells.begin(), found.cells.end(), [](const auto& c) { return c.has_value(); }), 2);
    EXPECT_EQ(cell("open").value, 0.49);
    EXPECT_EQ(cell("short").value, 0.1);
    EXPECT_TRUE(std::isnan(cell("open").margin_pct)) << "a time before the next train, and no limit in seconds";
    EXPECT_EQ(matrix.lines.front().item, "trip") << "no margin is a number nearer to its limit than it";
    EXPECT_TRUE(toJson(matrix)["lines"].front()["limit"].is_null());
}

TEST_F(LoadSafetyTrips, OneThatWasTimedSaysHowMuchOfTheTimeToTheNextTrainItTook) {
    trip("open while delivering").stop_s = 0.02;
    trip("open while delivering").allowed_s = 0.5;
    trip("open while delivering").after_s = 0.49;
    EXPECT_NEAR(cell("open").margin_pct, 96, 1e-9);
    EXPECT_EQ(cell("open").value, 0.02) << "from the train that found it";
    EXPECT_TRUE(std::isnan(cell("short").margin_pct)) << "not timed";
    EXPECT_NEAR(line().margin_pct, 96, 1e-9);
    EXPECT_TRUE(std::isnan(line().limit)) << "the rule is the next train, not a number of seconds";
    const auto found = judgeLoadSafety(input);
    const auto row = std::ranges::find(found.rows, "trip: open while delivering", &SafetyRow::title);
    EXPECT_EQ(row->value, 0.49) << "from the change, as ever";
    EXPECT_EQ(row->note, "ended within 20 ms of the train that found it; the next was due after 500 ms");
    // A time has no meaning if the output did not end.
    trip("open").tripped = false;
    EXPECT_EQ(cell("open").verdict, RowVerdict::Fail);
    EXPECT_TRUE(std::isnan(cell("open").margin_pct));
}

TEST_F(LoadSafetyTrips, OneThatDidNotEndTheOutputFailsItsLoadAndStandsFirst) {
    RecordProperty("hazard", "H3");
    for (const auto* name : {"short", "short while delivering"}) {
        trip(name).tripped = false;
        EXPECT_EQ(cell("short").verdict, RowVerdict::Fail) << name;
        EXPECT_EQ(cell("open").verdict, RowVerdict::Pass) << name;
        EXPECT_EQ(matrix.lines.front().item, "trip") << name;
        for (const auto& load : judgeLoadSafety(input).loads) {
            EXPECT_EQ(load.verdict, load.name == "short" ? RowVerdict::Fail : RowVerdict::Pass) << load.name;
        }
        trip(name).tripped = true;
        trip(name).evaluated = false;
        EXPECT_EQ(cell("short").verdict, RowVerdict::NotEvaluated) << name << " unknown is not a pass";
        trip(name).evaluated = true;
    }
}

TEST_F(LoadSafetyCheck, WithoutAnElectrodeAreaIsNoPassAndSaysSoOnce) {
    RecordProperty("hazard", "H9");
    input.area_cm2.reset();
    const auto found = judgeLoadSafety(input);
    EXPECT_EQ(found.verdict, Verdict::Indeterminate);
    EXPECT_EQ(rowOf(found, "500 ohm", "power_density").verdict, RowVerdict::NotEvaluated);
    EXPECT_EQ(found.reasons.size(), 1U) << found.reasons.back();
}

TEST_F(LoadSafetyCheck, AnythingLeftOutIsNoPass) {
    RecordProperty("hazard", "H9");
    const LoadSafetyInput whole = input;
    for (std::size_t k = 0; k < whole.loads.size(); ++k) {
        input = whole;
        input.loads.erase(input.loads.begin() + static_cast<std::ptrdiff_t>(k));
        EXPECT_EQ(judgeLoadSafety(input).verdict, Verdict::Indeterminate) << whole.loads[k].name;
        input = whole;
        if (!input.loads[k].steps.empty()) {
            input.loads[k].steps.clear();
            EXPECT_EQ(judgeLoadSafety(input).verdict, Verdict::Indeterminate) << whole.loads[k].name;
        }
        input = whole;
        if (!input.loads[k].steps.empty()) {
            input.loads[k].problem = "the device was unplugged";
            EXPECT_EQ(judgeLoadSafety(input).verdict, Verdict::Indeterminate) << whole.loads[k].name;
        }
    }
    for (std::size_t k = 0; k < whole.trips.size(); ++k) {
        input = whole;
        input.trips.erase(input.trips.begin() + static_cast<std::ptrdiff_t>(k));
        EXPECT_EQ(judgeLoadSafety(input).verdict, Verdict::Indeterminate) << whole.trips[k].name;
        input = whole;
        input.trips[k].evaluated = false;
        EXPECT_EQ(judgeLoadSafety(input).verdict, Verdict::Indeterminate) << whole.trips[k].name;
        input = whole;
        input.trips[k].tripped = false;
        EXPECT_EQ(judgeLoadSafety(input).verdict, Verdict::Fail) << whole.trips[k].name;
    }
    input = whole;
    input.reference.reset();
    EXPECT_EQ(judgeLoadSafety(input).verdict, Verdict::Indeterminate);
    input = whole;
    input.limits.clear();
    EXPECT_EQ(judgeLoadSafety(input).verdict, Verdict::Indeterminate);
    input = LoadSafetyInput{};
    EXPECT_EQ(judgeLoadSafety(input).verdict, Verdict::Indeterminate);
}

TEST_F(LoadSafetyCheck, AnyFigureThatWasNotMeasuredIsNoPass) {
    RecordProperty("hazard", "H9");
    const LoadSafetyInput whole = input;
    for (const auto member :
         {&LoadReading::delivered, &LoadReading::width_s, &LoadReading::interval_s, &LoadReading::impedance_ohm,
          &LoadReading::imbalance, &LoadReading::rms_5s_ma, &LoadReading::peak_v, &LoadReading::rms_5s_v,
          &LoadReading::power_1s_w, &LoadReading::energy_mj, &LoadReading::dc_ma}) {
        input = whole;
        at("500 ohm").steps[0].reading.*member = {};
        EXPECT_EQ(judgeLoadSafety(input).verdict, Verdict::Indeterminate);
    }
}

TEST_F(LoadSafetyCheck, MoreThanTenMilliampsRmsFailsWithItsNumbers) {
    RecordProperty("hazard", "H1");
    LoadTruth truth;
    truth.ohms = 100;
    at("100 ohm").steps.push_back(step(truth));  // 40 V every 0.5 s: 11.3 mA
    const auto found = judgeLoadSafety(input);
    EXPECT_EQ(found.verdict, Verdict::Fail);
    const auto& row = rowOf(found, "100 ohm", "rms_current_5s");
    EXPECT_NEAR(row.value, 400 * std::sqrt(10 * 400e-6 / 5), 0.02);
    const bool named = std::any_of(found.reasons.begin(), found.reasons.end(),
                                   [](const auto& text) { return text.find("11.31") != std::string::npos; });
    EXPECT_TRUE(named);
}

TEST_F(LoadSafetyCheck, OfACurrentSourceTheVoltageIsJudgedToo) {
    RecordProperty("hazard", "H1");
    // Z| was read a tenth too low: the current is as programmed, and the voltage at the load is 10 % above A.
    input.source.drive = Drive::Current;
    LoadTruth truth;
    truth.volts = 44;
    auto& wrong = at("500 ohm").steps[0];
    wrong = step(truth, 40);
    wrong.reading.delivered = {1, 0.003};
    const auto found = judgeLoadSafety(input);
    EXPECT_EQ(found.verdict, Verdict::Fail);
    EXPECT_EQ(rowOf(found, "500 ohm", "voltage_over").verdict, RowVerdict::Fail);
    EXPECT_NEAR(rowOf(found, "500 ohm", "voltage_over").value, 10, 0.1);
    EXPECT_EQ(rowOf(found, "1 kohm", "voltage_over").verdict, RowVerdict::Pass);
}

TEST_F(LoadSafetyCheck, ARateWithinTheTrainThatIsTooFastFails) {
    RecordProperty("hazard", "H9");
    EXPECT_THROW(rowOf(judgeLoadSafety(input), "500 ohm", "train_rate_over"), std::runtime_error)
        << "single pulses have none";
    LimitSet own;
    own.id = "own";
    LimitRow inTrain;
    inTrain.quantity = Quantity::RmsCurrentTrain;
    inTrain.max = 1000;
    own.rows.push_back(inTrain);
    input.limits.push_back(own);
    const auto worst = [&](const LoadSafety& found) {
        return *std::ranges::find(found.worstCase.rows, "rms_current_train", &SafetyRow::item);
    };
    driveTrains(100);
    const auto sound = judgeLoadSafety(input);
    EXPECT_EQ(sound.verdict, Verdict::Pass) << sound.reasons.front();
    EXPECT_EQ(rowOf(sound, "500 ohm", "train_rate_over").verdict, RowVerdict::Pass);
    driveTrains(104);
    const auto fast = judgeLoadSafety(input);
    EXPECT_EQ(fast.verdict, Verdict::Fail);
    EXPECT_NEAR(rowOf(fast, "500 ohm", "train_rate_over").value, 4, 0.01);
    EXPECT_EQ(rowOf(fast, "500 ohm", "train_rate_over").verdict, RowVerdict::Fail);
    EXPECT_NEAR(rowOf(fast, "500 ohm", "rate_accuracy").value, 4, 0.01) << "the interval alone is exact";
    const double denser = std::sqrt(1.04);
    EXPECT_NEAR(rowOf(fast, "500 ohm", "rms_current_train").value,
                denser * rowOf(sound, "500 ohm", "rms_current_train").value, 0.01);
    EXPECT_NEAR(worst(fast).value, denser * worst(sound).value, 0.01);

    driveTrains(100);
    at("500 ohm").steps[0].reading.rate_hz.expanded = 4;
    EXPECT_NEAR(std::hypot(worst(sound).expanded, (denser - 1) * worst(sound).value),
                worst(judgeLoadSafety(input)).expanded, 0.01)
        << "what is extrapolated is in doubt as the rate is";
    at("500 ohm").steps[0].reading.rate_hz = {};
    EXPECT_EQ(judgeLoadSafety(input).verdict, Verdict::Indeterminate) << "one that was not measured";
    for (auto& record : input.loads)
        for (auto& each : record.steps) each.reading.rate_hz = {};
    EXPECT_EQ(worst(judgeLoadSafety(input)).verdict, RowVerdict::NotEvaluated);
}

TEST_F(LoadSafetyCheck, WhatTheLimitsForbidMustHaveBeenRefused) {
    RecordProperty("hazard", "H1");
    at("100 ohm").refusals.push_back({40, 0.5, true, true, "11.3 mA", "refused: 11.3 mA"});
    auto found = judgeLoadSafety(input);
    EXPECT_EQ(found.verdict, Verdict::Pass);
    EXPECT_EQ(rowOf(found, "100 ohm", "refusal").verdict, RowVerdict::RefusedAsExpected);
    EXPECT_TRUE(found.reasons.front().ends_with("; the one command that must be refused was refused"));
    at("100 ohm").refusals.push_back({30, 0.5, true, true, "10.5 mA", "refused: 10.5 mA"});
    EXPECT_TRUE(judgeLoadSafety(input).reasons.front().ends_with("; both commands that must be refused were refused"))
        << judgeLoadSafety(input).reasons.front();
    at("100 ohm").refusals.back().refused = false;
    EXPECT_EQ(judgeLoadSafety(input).verdict, Verdict::Fail);
    at("100 ohm").refusals.back() = {10, 0.5, false, true, "", "refused"};
    EXPECT_EQ(judgeLoadSafety(input).verdict, Verdict::Indeterminate);
}

TEST_F(LoadSafetyCheck, ALoadTheDeviceCannotDriveIsNamedAndHoldsUpNoPass) {
    at("100 kohm").steps.clear();
    at("100 kohm").notApplicable = "100 kohm cannot be driven by one step of 0.5 mA";
    const auto found = judgeLoadSafety(input);
    EXPECT_EQ(found.verdict, Verdict::Pass);
    ASSERT_EQ(found.reasons.size(), 2U);
    EXPECT_EQ(found.reasons.back(), "100 kohm cannot be driven by one step of 0.5 mA");
}

TEST_F(LoadSafetyCheck, AWrongResistorIsFoundBeforeAnythingIsBelieved) {
    LoadTruth truth;
    truth.ohms = 465;
    at("500 ohm").steps = {step(truth)};
    EXPECT_EQ(rowOf(judgeLoadSafety(input), "500 ohm", "load_value").verdict, RowVerdict::Fail);
    at("500 ohm").dmm_ohm = {465, 0.5, 1};  // the multimeter's reading
    EXPECT_EQ(rowOf(judgeLoadSafety(input), "500 ohm", "load_value").verdict, RowVerdict::Pass);
}

TEST_F(LoadSafetyCheck, AMultimeterWithoutAnUncertaintyIsNoPerfectOne) {
    RecordProperty("hazard", "H9");
    const auto read = [](double u) {
        return loadRecordFrom(
                   {{"name", "500 ohm"}, {"dmm_ohm", 500}, {"dmm_u_ohm", u}, {"steps", nlohmann::json::array()}})
            .value()
            .dmm_ohm;
    };
    EXPECT_EQ(read(0.5).expanded, 1);
    EXPECT_TRUE(std::isnan(read(0).expanded));
    at("500 ohm").dmm_ohm = read(0);
    const auto found = judgeLoadSafety(input);
    const auto row = rowOf(found, "500 ohm", "load_value");
    EXPECT_EQ(row.verdict, RowVerdict::NotEvaluated);
    EXPECT_THAT(row.reason, testing::HasSubstr("the uncertainty of the multimeter's reading is not known"));
    EXPECT_EQ(found.verdict, Verdict::Indeterminate);
}

TEST_F(LoadSafetyCheck, WhatWasMeasuredNowhereLeavesTheWorstCaseOpen) {
    RecordProperty("hazard", "H1");
    for (auto& record : input.loads)
        for (auto& step : record.steps) step.reading.interval_s = {};
    const auto interval = judgeLoadSafety(input);
    EXPECT_EQ(interval.worstCase.verdict, RowVerdict::NotEvaluated);
    EXPECT_EQ(interval.verdict, Verdict::Indeterminate);
}

TEST_F(LoadSafetyCheck, StatesTheOutputsOfTheGuidance) {
    const auto found = judgeLoadSafety(input);
    const struct {
        const char* output;
        const char* load;
        double value;
    } expected[] = {{"maximum output voltage", "500 ohm", 40},
                    {"maximum output voltage", "2 kohm", 40},
                    {"maximum output voltage", "10 kohm", 40},
                    {"maximum output current", "500 ohm", 80},
                    {"maximum output current", "2 kohm", 20},
                    {"maximum output current", "10 kohm", 4},
                    {"maximum phase charge", "500 ohm", 16},
                    {"net charge per pulse", "500 ohm", 0},
                    {"maximum RMS current over 5 s", "500 ohm", 80 * std::sqrt(10 * 400e-6 / 5)},
                    {"maximum RMS current over 5 s", "2 kohm", 20 * std::sqrt(10 * 400e-6 / 5)},
                    {"maximum RMS current over 5 s", "10 kohm", 4 * std::sqrt(10 * 400e-6 / 5)},
                    {"maximum current density (RMS over 5 s)", "500 ohm", 80 * std::sqrt(10 * 400e-6 / 5) / 3},
                    {"maximum power density (over 1 s)", "500 ohm", 2 * 1.28e-3 / 3}};
    ASSERT_EQ(found.disclosed.size(), std::size(expected));
    for (std::size_t k = 0; k < std::size(expected); ++k) {
        const auto& row = found.disclosed[k];
        EXPECT_EQ(row.output, expected[k].output);
        EXPECT_EQ(row.load, expected[k].load);
        EXPECT_NEAR(row.value, expected[k].value, std::max(0.005 * expected[k].value, 0.01)) << row.output;
        EXPECT_LE(row.expanded, std::max(0.02 * expected[k].value, 0.05)) << row.output;
    }
}

/// The check's promise: a value at or beyond limit + 2U never passes, and a value well within the limit always passes.
TEST_F(LoadSafetyCheck, MissesNoViolationFromLimitPlusTwiceTheUncertainty) {
    RecordProperty("hazard", "H9");
    const LoadSafetyInput whole = input;
    std::size_t tried = 0, failed = 0;
    const auto inject = [&](const LoadTruth& truth, double command, const std::string& what) {
        input = whole;
        at("500 ohm").steps.push_back(step(truth, command));
        const auto verdict = judgeLoadSafety(input).verdict;
        EXPECT_NE(verdict, Verdict::Pass) << what;
        ++tried;
        if (verdict == Verdict::Fail) ++failed;
    };
    const auto reading = [&] { return step(LoadTruth{}).reading; }();
    const double u_amplitude = 2 * reading.amplitude_v.expanded / 40;
    const double u_width = 2 * reading.width_s.expanded / 200e-6;
    const double u_net = 2 * reading.imbalance.expanded;
    for (const double instrument : {0.9955, 1.0, 1.0045}) {
        for (const double more : {0.0, 0.001, 0.01, 0.05, 0.2, 1.0}) {
            LoadTruth truth;
            truth.gain_v = truth.gain_i = instrument;
            truth.volts = 40 * (1.02 + u_amplitude + more);
            inject(truth, 40, fmt::format("gain {} at {}", truth.volts / 40, instrument));
            truth.volts = 10 * (1.02 + u_amplitude + more);
            inject(truth, 10, fmt::format("offset {} at {}", truth.volts - 10, instrument));
            truth.volts = 40;
            truth.width_s = 200e-6 * (1.01 + u_width + more / 2);
            inject(truth, 40, fmt::format("width {} at {}", truth.width_s, instrument));
            truth.width_s = 200e-6;
            truth.interval_s = 0.5 * (1 - (0.01 + 1e-6 + more / 3));
            inject(truth, 40, fmt::format("interval {} at {}", truth.interval_s, instrument));
            truth.interval_s = 0.5;
            for (const double sign : {-1.0, 1.0}) {
                truth.second = sign > 0 ? 1 - (0.01 + u_net + more / 2) : 1 / (1 - (0.01 + u_net + more / 2));
                inject(truth, 40, fmt::format("net charge {} at {}", truth.second, instrument));
            }
        }
    }
    EXPECT_EQ(tried, 108U);
    RecordProperty("failed_of_108", static_cast<int>(failed));
    EXPECT_GE(failed, 100U) << "a violation beyond limit + 2U should fail, not merely be undecided";
}

TEST(JudgeUpper, HasAGuardBandOnEitherSide) {
    RecordProperty("hazard", "H9");
    EXPECT_EQ(judgeUpper(9.8, 0.2, 10, false), RowVerdict::Pass);
    EXPECT_EQ(judgeUpper(9.8, 0.2, 10, true), RowVerdict::Indeterminate);
    EXPECT_EQ(judgeUpper(9.9, 0.2, 10, false), RowVerdict::Indeterminate);
    EXPECT_EQ(judgeUpper(10.1, 0.2, 10, false), RowVerdict::Indeterminate);
    EXPECT_EQ(judgeUpper(10.3, 0.2, 10, false), RowVerdict::Fail);
    EXPECT_EQ(judgeUpper(std::nan(""), 0.2, 10, false), RowVerdict::NotEvaluated);
    EXPECT_EQ(judgeUpper(1, std::nan(""), 10, false), RowVerdict::NotEvaluated);
    EXPECT_EQ(judgeUpper(1, 0.1, std::nan(""), false), RowVerdict::NotEvaluated);
}

TEST(LoadSafetyJson, ReadsBackWhatAScriptCarries) {
    const auto reading = toJson(readLoad(loadCaptures({}), ExpectedTrain{}).value());
    const auto stepWith = [](nlohmann::json of) {
        return nlohmann::json{{"command_v", 10}, {"interval_s", 0.5}, {"reading", of}};
    };
    const auto back = toJson(loadStepFrom(stepWith(reading)).value().reading);
    EXPECT_EQ(back["rms_5s_ma"], reading["rms_5s_ma"]);
    EXPECT_EQ(back["imbalance_u"], reading["imbalance_u"]);
    EXPECT_FALSE(loadStepFrom(stepWith({{"peak_v", "much"}})));
    EXPECT_FALSE(loadRecordFrom({{"name", "a banana"}}));
    EXPECT_FALSE(loadRecordFrom({{"name", "1 kohm"}, {"steps", 3}}));
    EXPECT_FALSE(tripTrialFrom({{"name", "open"}, {"tripped", "yes"}}));
    EXPECT_FALSE(tripTrialFrom(nlohmann::json::array()));
}

}  // namespace
}  // namespace tacto
