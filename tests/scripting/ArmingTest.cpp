// Arming real hardware needs the operator's confirmation of exactly what would be armed, and nothing else. Here the
// stimulator says that it is real, but is simulated.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/electrode/Load.h"
#include "tests/scripting/RunBench.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;

constexpr const char* kInto1k =
    "simulated stimulator SIM-1 into 1 kohm, up to 40 V and 50 mA, electrode area not stated";
constexpr const char* kInto2k =
    "simulated stimulator SIM-1 into 2 kohm, up to 40 V and 25 mA, electrode area not stated";

class Arming : public testing::Test {
protected:
    Arming() { RecordProperty("hazard", "H12"); }

    [[nodiscard]] ScriptOutcome run(const std::string& body, std::map<std::string, std::string> answers) {
        PresetOperator preset(std::move(answers));
        auto request = rig_.request(withRun(body));
        request.operatorDesk = &preset;
        return runProtocol(std::move(request)).value();
    }
    /// True if not even an impedance check was delivered.
    [[nodiscard]] bool nothingWasDelivered() {
        return dynamic_cast<RealLookingStimulator&>(*rig_.bench().devices().stimulator).delivered() == 0;
    }
    [[nodiscard]] InterlockState state() { return rig_.bench().telemetry().state; }

    RunBench rig_{true, "sim:stimulator?mode=voltage", 1, true, {Role::Sensor, Role::Stimulator, Role::Oscilloscope},
                  true};
};

TEST_F(Arming, AskedForOnHardwareIsNotConfirmedByTheProgram) {
    const auto outcome = run("bench.arm({ load: 1000 });", {});
    ASSERT_TRUE(outcome.error) << "a stimulator was armed without a confirmation";
    EXPECT_EQ(outcome.error->code, ErrorCode::NotFound);
    EXPECT_THAT(outcome.error->message, HasSubstr(fmt::format("--set confirm-arming=\"{}\"", kInto1k)));
    EXPECT_TRUE(nothingWasDelivered());
}

TEST_F(Arming, AYesConfirmsNothing) {
    for (const char* answer : {"yes", "true", "1", "", "1 kohm"}) {
        const auto outcome = run("bench.arm({ load: 1000 });", {{"confirm-arming", answer}});
        ASSERT_TRUE(outcome.error) << answer;
        EXPECT_EQ(outcome.error->code, ErrorCode::NotArmed);
        EXPECT_THAT(outcome.error->message, HasSubstr(kInto1k));
    }
    EXPECT_TRUE(nothingWasDelivered());
}

TEST_F(Arming, TheTextOfWhatWouldBeArmedConfirmsItAndNoOtherLoad) {
    const auto outcome =
        run("bench.arm({ load: 1000 }); bench.disarm(); bench.arm({ load: 2000 });", {{"confirm-arming", kInto1k}});
    ASSERT_TRUE(outcome.error);
    EXPECT_EQ(outcome.error->code, ErrorCode::NotArmed);
    EXPECT_THAT(outcome.error->message, HasSubstr(kInto2k));
    EXPECT_EQ(outcome.line, 2);
    EXPECT_FALSE(nothingWasDelivered()) << "the first load was confirmed, and checked";
    EXPECT_EQ(state(), InterlockState::Disarmed);
}

TEST_F(Arming, SeveralLoadsAreConfirmedBySeveralTexts) {
    const auto outcome = run("bench.arm({ load: 1000 }); bench.disarm(); bench.arm({ load: 1000 });",
                             {{"confirm-arming", fmt::format("{}\n{}", kInto2k, kInto1k)}});
    EXPECT_FALSE(outcome.error) << outcome.error->message;
}

TEST_F(Arming, AnotherElectrodeAreaIsAnotherText) {
    auto profile = rig_.bench().profile();
    profile.electrodeArea = SquareCentimetres(4);
    ASSERT_TRUE(rig_.bench().setProfile(profile));
    const auto outcome = run("bench.setElectrodeArea(3); bench.arm({ load: 1000 });", {{"confirm-arming", kInto1k}});
    ASSERT_TRUE(outcome.error);
    EXPECT_THAT(outcome.error->message, HasSubstr("electrode area 3 cm2"));
    EXPECT_TRUE(nothingWasDelivered());
}

TEST_F(Arming, IsConfirmedOnceForALoadThatStays) {
    const auto outcome =
        rig_.run(withRun("for (let i = 0; i < 3; ++i) { bench.arm({ load: 1000 }); bench.disarm(); }"));
    ASSERT_FALSE(outcome.error) << outcome.error->message;
    EXPECT_EQ(rig_.technician().asked.size(), 1U);
    EXPECT_EQ(rig_.technician().asked.at(0).confirms, kInto1k);
}

TEST_F(Arming, IsConfirmedAgainAfterTheLoadWasFitted) {
    const auto outcome =
        rig_.run(withRun("bench.arm({ load: 1000 }); bench.fitLoad(\"1 kohm\"); bench.arm({ load: 1000 });"));
    ASSERT_FALSE(outcome.error) << outcome.error->message;
    EXPECT_EQ(std::count_if(rig_.technician().asked.begin(), rig_.technician().asked.end(),
                            [](const auto& question) { return question.name == "confirm-arming"; }),
              2);
}

TEST_F(Arming, ThatFailsLeavesTheOutputDisarmedWhateverWasArmedBefore) {
    // Readings that disarm first do the same, whether they succeed or are refused.
    for (const char* second :
         {"bench.arm({ load: \"ten\" });", "bench.arm(7);", "bench.measureRest({ duration_s: -1 });",
          "bench.sensorCalibration.slide(7);", "bench.loadSafety.trip(7);", "bench.measureWeight(-1);"}) {
        const auto outcome = run(
            fmt::format("bench.arm({{ load: 1000 }}); try {{ {} }} catch (e) {{ log(bench.live().state); }}", second),
            {{"confirm-arming", kInto1k}});
        ASSERT_FALSE(outcome.error) << outcome.error->message;
        EXPECT_EQ(outcome.log, std::vector<std::string>{"disarmed"}) << second;
    }
}

TEST_F(Arming, ThatWasNotConfirmedEndsTheRunWhateverTheScriptMakesOfIt) {
    const auto outcome = run(
        "bench.arm({ load: 1000 }); try { bench.arm({ load: 2000 }); } catch (e) {} try { log(\"on\"); } catch (e) {} "
        "return { verdict: \"pass\" };",
        {{"confirm-arming", kInto1k}});
    ASSERT_TRUE(outcome.error);
    EXPECT_EQ(outcome.error->code, ErrorCode::NotArmed);
    EXPECT_THAT(outcome.error->message, HasSubstr(kInto2k));
    EXPECT_NE(outcome.verdict, ScriptVerdict::Pass);
    EXPECT_TRUE(outcome.log.empty()) << "it went on";
    EXPECT_EQ(state(), InterlockState::Disarmed);
}

TEST_F(Arming, AnErrorSaysWhetherALimitForbadeIt) {
    RecordProperty("hazard", "H9");  // otherwise a missing confirmation would look like a limit that works
    RunBench simulated{true, "sim:stimulator?mode=voltage"};
    const auto outcome =
        simulated.run(withRun("try { bench.arm({ load: \"ten\" }); } catch (error) { log(String(error.limit)); }\n"
                              "bench.fitLoad(\"100 ohm\"); bench.arm({ load: \"100 ohm\" });\n"
                              "try { bench.drive(\"manual\", { roughness: 1, pressure: 1 }); bench.wait(2); }\n"
                              "catch (error) { log(String(error.limit)); }"));
    EXPECT_FALSE(outcome.error) << outcome.error->message;
    EXPECT_EQ(outcome.log, (std::vector<std::string>{"false", "true"}));
}

TEST_F(Arming, TheTripsAreConfirmedToo) {
    const auto outcome =
        run("const s = { reference: '1 kohm', trains: 2, steps: 3, dmm: false, silence: 1, reference_v: 0, "
            "reference_u_pct: 0,"
            " load_tolerance: 5, amplitude_tolerance: 2, resistor_tolerance: 1, area_tolerance: 5 };"
            "bench.loadSafety.begin(s); bench.loadSafety.silence();",
            {{"change-load", "yes"}});
    ASSERT_TRUE(outcome.error);
    EXPECT_THAT(outcome.error->message, HasSubstr("--set confirm-arming="));
    EXPECT_TRUE(nothingWasDelivered());
}

TEST_F(Arming, ABenchTakesNoConfirmationOfAnotherText) {
    auto& bench = rig_.bench();
    ArmRequest request{"1 kohm", true, true};
    auto armed = bench.arm(request);
    ASSERT_FALSE(armed) << "two booleans are not a confirmation";
    EXPECT_THAT(armed.error().message, HasSubstr(kInto1k));
    request.confirmed = kInto2k;
    armed = bench.arm(request);
    ASSERT_FALSE(armed);
    EXPECT_EQ(armed.error().code, ErrorCode::NotArmed);
    EXPECT_TRUE(nothingWasDelivered());
    request.confirmed = bench.armingText(*parseLoad("1 kohm"));
    EXPECT_TRUE(bench.arm(request));
}

TEST_F(Arming, AnImpedanceCheckMeasuresAndEndsDisarmed) {
    auto& bench = rig_.bench();
    const ArmRequest request{"1 kohm", true, true, kInto1k};
    ASSERT_TRUE(bench.drive(DriveSource::Manual, 0.5, 1)) << "what was wished before is not delivered by a check";
    const auto found = bench.checkImpedance(request);
    ASSERT_TRUE(found) << found.error().message;
    ASSERT_TRUE(found->has_value());
    EXPECT_NEAR((*found)->value(), 1000, 20);
    EXPECT_EQ(state(), InterlockState::Disarmed);
    EXPECT_TRUE(bench.wait(Seconds(1)));
    EXPECT_EQ(bench.telemetry().trainsDelivered, 0U);

    ASSERT_FALSE(bench.checkImpedance({"3 kohm", true, true, kInto1k})) << "another load than was confirmed";
    EXPECT_EQ(state(), InterlockState::Disarmed);
}

TEST_F(Arming, OfACalibrationIsAskedForAsAnyOther) {
    const std::string settings =
        "const s = { mode: 'full', quantities: 'all', levels: 2, repeats: 2, store: false, valid_days: 1, scope_due: "
        "'',"
        " load: 1000, rate_hz: 2e6, settling_s: 0, warm_up_s: 0, amplitude_min_v: 10, amplitude_max_v: 40,"
        " interval_min_s: 0.5, interval_max_s: 2, width_min_us: 100, width_max_us: 400, gap_min_us: 100,"
        " gap_max_us: 300, tolerance_pct: 2, timing_tolerance_pct: 1, load_tolerance_pct: 1, reference_tolerance_pct: "
        "5,"
        " reference_v: 0, reference_u_pct: 0 }, steps = bench.stimulatorCalibration;";
    // No level may be set before the known load was read, which needs confirmation.
    for (const char* call : {"bench.readKnownLoad(1000, 5);", "steps.begin(s); steps.knownLoad(s);"}) {
        const auto outcome = run(settings + call, {});
        ASSERT_TRUE(outcome.error) << call;
        EXPECT_EQ(outcome.error->code, ErrorCode::NotFound) << call << outcome.error->message;
        EXPECT_THAT(outcome.error->message, HasSubstr("into 1 kohm, up to 40 V"));
    }
    EXPECT_TRUE(nothingWasDelivered());
    EXPECT_EQ(state(), InterlockState::Disarmed);
}

TEST(ArmingOfACurrentSource, SaysTheCurrentThatItsWeakestLoadDraws) {
    RecordProperty("hazard", "H12");
    RunBench rig(true, "sim:stimulator?mode=current");
    EXPECT_EQ(rig.bench().armingText(*parseLoad("2 kohm")),
              "simulated stimulator SIM-1 into 2 kohm, up to 40 V and 25 mA, electrode area not stated");
}

TEST(ArmingOnTheTwin, NeedsNoConfirmation) {
    RunBench rig;
    const auto outcome = rig.run(withRun("bench.arm({ load: 1000 });"));
    EXPECT_FALSE(outcome.error) << outcome.error->message;
}

}  // namespace
}  // namespace tacto::test
