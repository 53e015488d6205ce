// The shipped load-safety protocol on the simulated bench: its results, and what happens if something breaks.
#include <atomic>
#include <cmath>
#include <future>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>
#include <set>

#include "core/base/Random.h"
#include "core/results/ResultTable.h"
#include "tests/scripting/LoadSafetyRig.h"

namespace tacto {
namespace {

using test::loadOf;
using test::LoadSafetyRig;

TEST(LoadSafetyRun, PassesOnTheCleanTwinAndFindsEveryLoadsValue) {
    LoadSafetyRig rig({}, 1, true);
    const auto outcome = rig.run({{"area", "3"}});
    ASSERT_FALSE(outcome.error) << outcome.error->message;
    EXPECT_EQ(outcome.verdict, ScriptVerdict::Pass) << outcome.results["reasons"].dump(1);
    EXPECT_TRUE(rig.outputOff());
    ASSERT_EQ(outcome.results["loads"].size(), 9U);
    for (const double ohm : {100.0, 500.0, 1e3, 2e3, 10e3, 100e3}) {
        const auto load =
            loadOf(outcome.results, ohm < 1e3 ? fmt::format("{:g} ohm", ohm) : fmt::format("{:g} kohm", ohm / 1e3));
        EXPECT_EQ(load["verdict"], "pass") << ohm;
        EXPECT_NEAR(load["measured_ohm"].get<double>(), ohm, 0.01 * ohm);
        EXPECT_NEAR(load["peak_ma"].get<double>(), (ohm > 100 ? 40e3 : 20e3) / ohm, 0.01 * 40e3 / ohm);
    }
    // science.md section 7: 40 V every 0.5 s into 500 ohm is 2.26 mA over 5 s.
    EXPECT_NEAR(loadOf(outcome.results, "500 ohm")["rms_5s_ma"].get<double>(), 80 * std::sqrt(10 * 400e-6 / 5), 0.01);
    // science.md section 6: 40 V into the skin equivalent peaks at 200 mA and more.
    const auto skin = loadOf(outcome.results, "200 ohm + 10 kohm || 50 nF");
    EXPECT_EQ(skin["verdict"], "pass");
    EXPECT_GE(skin["peak_ma"].get<double>(), 195.0);
    EXPECT_NEAR(skin["measured_ohm"].get<double>(), 10'200, 0.01 * 10'200);
    EXPECT_LE(skin["imbalance"].get<double>(), 0.005);
    EXPECT_EQ(outcome.results["worst_case"]["verdict"], "pass");
    std::size_t figures = 0, limits = 0, pulses = 0;
    for (const auto& item : rig.reportItems()) {
        if (item.value("kind", "") == "results") limits += item["results"]["matrix"]["lines"].size();
        if (item.value("kind", "") != "figure") continue;
        ++figures;
        pulses += item["figure"]["captures"].size();
    }
    EXPECT_GE(limits, 10U) << "limits against loads, as results of this kind are reported";
    EXPECT_EQ(figures, 2U) << "single pulses, a burst";
    EXPECT_EQ(pulses, 4U) << "three single pulses and a burst";
}

/// What is predicted of a command is computed from what a calibrated stimulator is told, as the gate judges it.
TEST(LoadSafetyRun, ACalibratedStimulatorIsDrivenToTheStrongestCommandAndPasses) {
    RecordProperty("hazard", "H1");
    std::mt19937 random(51);
    for (const bool above : {true, false}) {
        const double off = std::uniform_real_distribution(0.002, 0.03)(random), gain = above ? 1 + off : 1 - off;
        LoadSafetyRig rig({fmt::format("sim:stimulator?gain={}", gain)}, 1, false,
                          StimulatorCalibration{{.gain = gain, .offset = 0, .lowest = 10, .highest = 40}});
        const auto outcome = rig.run({{"area", "4"}});
        ASSERT_FALSE(outcome.error) << outcome.error->message;
        EXPECT_EQ(outcome.verdict, ScriptVerdict::Pass) << gain << outcome.results["reasons"].dump(1);
        EXPECT_NEAR(loadOf(outcome.results, "1 kohm")["peak_ma"].get<double>(), 40, 0.5) << gain;
    }
}

TEST(LoadSafetyRun, FortyVoltsInto100OhmIsAskedForAndRefused) {
    RecordProperty("hazard", "H1");
    LoadSafetyRig rig({});
    const auto outcome = rig.run();
    bool found = false;
    for (const auto& row : outcome.results["rows"]) {
        if (row["load"] != "100 ohm" || row["item"] != "refusal") continue;
        found = true;
        EXPECT_EQ(row["verdict"], "refused as expected");
        EXPECT_NE(row["source"].get<std::string>().find("11.3"), std::string::npos) << row["source"];
    }
    EXPECT_TRUE(found);
    EXPECT_EQ(loadOf(outcome.results, "100 ohm")["commands_refused"], 1);
}

TEST(LoadSafetyRun, OpenShortLooseContactAndSilenceTrip) {
    RecordProperty("hazard", "H3");
    LoadSafetyRig rig({});
    const auto outcome = rig.run();
    std::size_t trips = 0;
    double silence_s = 0;
    for (const auto& row : outcome.results["rows"]) {
        if (row["item"] != "trip") continue;
        ++trips;
        EXPECT_EQ(row["verdict"], "pass") << row.dump();
        ASSERT_TRUE(row["value"].is_number()) << row.dump();
        if (row["title"] != "trip: dead-man") continue;
        silence_s = row["value"].get<double>();
    }
    EXPECT_GT(silence_s, 0.1) << "measured, and more than the silence that is waited for";
    EXPECT_LT(silence_s, 0.15);
    EXPECT_EQ(trips, 6U);
    // The time relative to the time to the next train.
    std::size_t timed = 0;
    for (const auto& line : outcome.results["matrix"]["lines"]) {
        if (line["item"] != "trip") continue;
        for (const auto& cell : line["cells"]) {
            if (cell.is_null()) continue;
            ++timed;
            ASSERT_TRUE(cell["margin_pct"].is_number()) << cell.dump();
            EXPECT_GT(cell["margin_pct"].get<double>(), 90) << cell.dump();
            EXPECT_LT(cell["margin_pct"].get<double>(), 100) << cell.dump();
            EXPECT_LT(cell["value"].get<double>(), 0.05) << cell.dump();
        }
    }
    EXPECT_EQ(timed, 2U) << "an open and a short circuit";
    EXPECT_EQ(outcome.expectedFaults, 4U) << "open, short, loose contact, silence; arming is refused without a fault";
}

TEST(LoadSafetyRun, ACauseThatComesWithAProvokedFaultIsNotResetWithIt) {
    RecordProperty("hazard", "H2");
    double seen_s = 0;
    const auto run = [&seen_s](LoadSafetyRig& rig) {
        auto request = rig.request({{"area", "3"}, {"steps", "2"}});
        request.onCapture = [&](const Capture&) {  // between the fault and its reset
            if (!rig.bench().faultPersists(FaultCause::OpenElectrode)) return;
            seen_s = rig.now_s();
            rig.bench().idle(Seconds(3));
        };
        return runProtocol(std::move(request)).value();
    };
    LoadSafetyRig clean({});
    ASSERT_EQ(run(clean).verdict, ScriptVerdict::Pass);
    ASSERT_GT(seen_s, 0);
    LoadSafetyRig rig({fmt::format("sim:stimulator?fault=unplug@{:.3f}s..{:.3f}s", seen_s + 0.5, seen_s + 2.5)});
    const auto outcome = run(rig);
    ASSERT_TRUE(outcome.error);
    EXPECT_THAT(outcome.error->message,
                testing::HasSubstr("open electrode was provoked, and device fault came with it"));
    EXPECT_TRUE(rig.bench().unitFault());
    EXPECT_TRUE(rig.outputOff());
}

TEST(LoadSafetyRun, WithoutAnElectrodeAreaIsIndeterminate) {
    RecordProperty("hazard", "H9");
    LoadSafetyRig rig({}, 1, true);
    const auto outcome = rig.run({{"steps", "2"}});
    EXPECT_EQ(outcome.verdict, ScriptVerdict::Indeterminate);
    EXPECT_EQ(loadOf(outcome.results, "500 ohm")["verdict"], "not evaluated");
    EXPECT_TRUE(loadOf(outcome.results, "500 ohm")["power_density_w_cm2"].is_null());
    EXPECT_THAT(nlohmann::json(rig.reportItems()).dump(), testing::HasSubstr("the electrode's area is not known"));
}

TEST(LoadSafetyRun, AStimulatorThatCannotReadBackIsNoPass) {
    RecordProperty("hazard", "H9");
    LoadSafetyRig rig({"sim:stimulator?readback=no"});
    const auto outcome = rig.run({{"area", "3"}, {"steps", "2"}});
    ASSERT_FALSE(outcome.error) << outcome.error->message;
    EXPECT_EQ(outcome.verdict, ScriptVerdict::Indeterminate);
    EXPECT_EQ(loadOf(outcome.results, "open")["verdict"], "not evaluated");
}

TEST(LoadSafetyRun, PassesOnACleanCurrentSourceAndFindsEveryLoadsValue) {
    LoadSafetyRig rig({"sim:stimulator?mode=current"}, 1, true);
    const auto outcome = rig.run({{"area", "3"}});
    ASSERT_FALSE(outcome.error) << outcome.error->message;
    EXPECT_EQ(outcome.verdict, ScriptVerdict::Pass) << outcome.results["reasons"].dump(1);
    EXPECT_TRUE(rig.outputOff());
    for (const double ohm : {100.0, 500.0, 1e3, 2e3, 10e3}) {  // 10 V on 100 ohm is 100 mA; it can give 130
        const auto load =
            loadOf(outcome.results, ohm < 1e3 ? fmt::format("{:g} ohm", ohm) : fmt::format("{:g} kohm", ohm / 1e3));
        EXPECT_EQ(load["verdict"], "pass") << ohm;
        EXPECT_NEAR(load["measured_ohm"].get<double>(), ohm, 0.01 * ohm);
    }
    const auto skin = loadOf(outcome.results, "200 ohm + 10 kohm || 50 nF");
    EXPECT_EQ(skin["verdict"], "pass");
    EXPECT_LE(skin["imbalance"].get<double>(), 0.005);
    // Commands that the source cannot give are listed as such, not as refused by the limits.
    std::set<std::string> undriven;
    for (const auto& row : outcome.results["rows"]) {
        if (row["load"] != "100 ohm") continue;
        EXPECT_NE(row["item"], "refusal") << row.dump();
        if (row["item"] != "drive") continue;
        EXPECT_EQ(row["verdict"], "not applicable");
        undriven.insert(row["title"]);
    }
    EXPECT_EQ(undriven, (std::set<std::string>{"20 V every 0.5 s", "30 V every 0.5 s", "40 V every 0.5 s"}));
    // The check pulse of 0.5 mA would put 50 V on 100 kohm: arming was requested and refused.
    EXPECT_EQ(loadOf(outcome.results, "100 kohm")["verdict"], "refused as expected");
    EXPECT_EQ(loadOf(outcome.results, "100 kohm")["commands_refused"], 1);
}

TEST(LoadSafetyRun, AStimulatorThatCannotGiveTheLargestCommandIsCheckedWithTheOthers) {
    RecordProperty("hazard", "H9");
    for (const char* uri : {"sim:stimulator?mode=current&max=30mA", "sim:stimulator?mode=voltage&max=25V"}) {
        LoadSafetyRig rig({uri});
        const auto outcome = rig.run({{"area", "3"}});
        ASSERT_FALSE(outcome.error) << uri << ": " << outcome.error->message;
        EXPECT_EQ(outcome.verdict, ScriptVerdict::Pass) << uri << outcome.results["reasons"].dump(1);
        EXPECT_EQ(loadOf(outcome.results, "500 ohm")["verdict"], "pass") << uri;
        bool named = false;
        for (const auto& reason : outcome.results["reasons"]) {
            named = named || reason.get<std::string>().find("500 ohm cannot be driven with 40 V") != std::string::npos;
        }
        EXPECT_TRUE(named) << uri << outcome.results["reasons"].dump(1);
    }
}

TEST(LoadSafetyRun, ACurrentSourceNamesWhatItCannotDrive) {
    LoadSafetyRig rig({"sim:stimulator?mode=current&step=0.5mA"});
    const auto outcome = rig.run();
    ASSERT_FALSE(outcome.error) << outcome.error->message;
    const auto load = loadOf(outcome.results, "100 kohm");
    EXPECT_EQ(load["verdict"], "not applicable");
    bool named = false;
    for (const auto& reason : outcome.results["reasons"]) {
        named = named || reason.get<std::string>().find("100 kohm cannot be driven") != std::string::npos;
    }
    EXPECT_TRUE(named) << outcome.results["reasons"].dump(1);
}

// A device is lost at any moment: outputs are off, measurements are kept and marked, and nothing passes.
class DeviceLoss : public testing::TestWithParam<std::string> {};

TEST_P(DeviceLoss, AtEveryStepKeepsPartialRowsAndLeavesOutputsOff) {
    RecordProperty("hazard", "H9");
    LoadSafetyRig clean({});
    ASSERT_EQ(clean.run().verdict, ScriptVerdict::Pass);
    const double whole_s = clean.now_s();
    ASSERT_GT(whole_s, 20);
#ifdef TACTOSCOPE_SANITIZED
    constexpr int kMoments = 8;  // ten times slower in such a build
#else
    constexpr int kMoments = 24;
#endif
    std::size_t loadsSeen = 0, partial = 0;
    for (int k = 0; k < kMoments; ++k) {
        const double at_s = whole_s * (k + 0.5) / kMoments;
        LoadSafetyRig rig({fmt::format("{}@{:.3f}s", GetParam(), at_s)}, 1, true);
        const auto outcome = rig.run();
        EXPECT_NE(outcome.verdict, ScriptVerdict::Pass) << at_s;
        EXPECT_TRUE(outcome.error) << at_s;
        EXPECT_TRUE(rig.outputOff()) << at_s;
        ASSERT_TRUE(outcome.results.is_object()) << at_s;
        EXPECT_EQ(outcome.results["partial"], true) << at_s;
        EXPECT_TRUE(outcome.results["verdict"].is_null()) << at_s;
        std::size_t measured = 0;
        for (const auto& load : outcome.results["loads"]) measured += load["commands_delivered"] != 0 ? 1U : 0U;
        EXPECT_GE(measured, loadsSeen) << "a later loss leaves no fewer loads";
        loadsSeen = measured;
        for (const auto& item : rig.reportItems()) {
            const bool results = item.value("kind", "") == "results";
            partial +=
                results && memberAt(item, "results.partial") == true && memberAt(item, "results.loads").is_array();
        }
    }
    EXPECT_GE(loadsSeen, 6U);
    EXPECT_EQ(partial, static_cast<std::size_t>(kMoments));
}

INSTANTIATE_TEST_SUITE_P(Devices, DeviceLoss,
                         testing::Values("sim:stimulator?fault=unplug", "sim:stimulator?fault=garbage",
                                         "sim:oscilloscope?fault=unplug"),
                         [](const auto& tested) {
                             return std::string(tested.param.find("oscilloscope") != std::string::npos ? "Oscilloscope"
                                                : tested.param.find("garbage") != std::string::npos    ? "Garbage"
                                                                                                       : "Stimulator");
                         });

TEST(LoadSafetyRun, CancelledAtEveryTrialKeepsWhatItHas) {
    RecordProperty("hazard", "H9");
    LoadSafetyRig clean({});
    std::size_t trials = 0;
    {
        auto request = clean.request({{"area", "3"}, {"steps", "2"}});
        request.onTrial = [&](const nlohmann::json&) { ++trials; };
        ASSERT_EQ(runProtocol(std::move(request)).value().verdict, ScriptVerdict::Pass);
    }
    ASSERT_GE(trials, 14U);
    for (std::size_t at = 1; at <= trials; ++at) {
        LoadSafetyRig rig({});
        auto request = rig.request({{"area", "3"}, {"steps", "2"}});
        std::promise<ScriptRun*> started;
        auto running = started.get_future().share();
        std::size_t seen = 0;
        request.onTrial = [&](const nlohmann::json&) {
            if (++seen == at) running.get()->stop("the test");
        };
        auto run = ScriptRun::start(std::move(request)).value();
        started.set_value(run.get());
        const auto outcome = run->wait();
        EXPECT_EQ(outcome.verdict, ScriptVerdict::Stopped) << at;
        EXPECT_TRUE(rig.outputOff()) << at;
        ASSERT_TRUE(outcome.results.is_object()) << at;
        EXPECT_EQ(outcome.results["partial"], true) << at;
    }
}

}  // namespace
}  // namespace tacto
