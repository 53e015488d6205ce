// Marks: sentences about simulated, replayed and real devices of a session.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/dsp/RoughnessFlags.h"
#include "core/session/Origin.h"
#include "tests/session/SessionSupport.h"

namespace tacto {
namespace {

using Marks = std::vector<std::string>;

SessionAbout with(std::vector<SessionDevice> devices) {
    SessionAbout about;
    about.devices = std::move(devices);
    for (const auto& device : about.devices) about.simulated = about.simulated || device.simulated;
    return about;
}

SessionDevice device(const char* role, const char* name, const char* serial, const char* from) {
    const std::string_view said(from);
    return {
        std::string(role) + ":", role, name, serial, "", said == "simulated" || said == "replayed, simulated", from};
}

class Origins : public testing::Test {
protected:
    Origins() { RecordProperty("hazard", "H9"); }
};

TEST_F(Origins, ARealStimulatorIsNamedWithWhatItDeliveredWhereOnlyTheFingerWasSimulated) {
    const auto about = with(
        {device("sensor", "simulated fingertip", "SIM-0", "simulated"), device("stimulator", "P24", "0123", "real")});
    EXPECT_EQ(originMarks(about, {12, 3, 39.96, "mA"}),
              (Marks{"SIMULATED: the fingertip sensor.",
                     "Real: stimulator P24 0123, which delivered 12 trains of up to 40 mA and 3 impedance checks."}));
    EXPECT_EQ(originMarks(about, {}).at(1), "Real: stimulator P24 0123, which delivered 0 trains.");
}

TEST_F(Origins, NothingButSimulationsIsSaidInOneSentence) {
    const Marks all{"SIMULATED: no number here was measured on hardware."};
    EXPECT_EQ(originMarks(with({device("sensor", "", "", "simulated"), device("stimulator", "", "", "simulated")}), {}),
              all);
    EXPECT_EQ(originMarks(with({device("sensor", "", "", "replayed, simulated")}), {}), all);
    SessionAbout prediction;
    prediction.simulated = true;
    EXPECT_EQ(originMarks(prediction, {}), all);
    EXPECT_EQ(originMarks({}, {}), Marks{});
}

TEST_F(Origins, HardwareAloneNeedsNoMark) {
    EXPECT_EQ(originMarks(with({device("stimulator", "P24", "0123", "real")}), {5, 1, 10, "mA"}), Marks{});
}

TEST_F(Origins, WhatARecordingDoesNotSayIsNotCalledReal) {
    const auto marks = originMarks(with({device("sensor", "recording: x", "", "replayed, origin not stated")}), {});
    EXPECT_EQ(marks, Marks{"Replayed: the fingertip sensor from sensor:, which does not say whether it was measured."});
    const auto json = devicesJson({device("sensor", "", "", "replayed, origin not stated")});
    EXPECT_TRUE(json[0]["simulated"].is_null());
    EXPECT_EQ(json[0]["origin"], "replayed, origin not stated");
}

TEST_F(Origins, OldSessionsAreReadByTheirMarkAndAddress) {
    SessionDevice old;
    old.uri = "recording:/data/x";
    EXPECT_EQ(originOf(old), origin::kReplayedUnknown);
    old.simulated = true;
    EXPECT_EQ(originOf(old), origin::kSimulated);
    old = {};
    old.uri = "sciencemode:P24-1";
    EXPECT_EQ(originOf(old), origin::kHardware);
}

// What a reader of a result must know, kept in the session: calibration, flags of the recording, the limit of R.

using testing::Contains;
using testing::HasSubstr;

class SessionMarks : public testing::Test {
protected:
    SessionMarks() {
        RecordProperty("hazard", "H9");
        about.devices = {{"recording:linen", "sensor", "recording: linen", "", "", false, "replayed, measured"},
                         {"sciencemode:", "stimulator", "P24", "0123", "1", false, "real"}};
        about.simulated = false;
    }
    /// Returns the marks of a session with these events.
    std::vector<std::string> of(const std::vector<std::pair<const char*, nlohmann::json>>& events, bool close = true) {
        const auto path = folder.path() / "run.tacto";
        const auto writer = SessionWriter::create(path, about, clock).value();
        for (const auto& [kind, body] : events) EXPECT_TRUE(writer->event(Instant(1), kind, body));
        const auto kept = close ? writer->close() : writer->flush();
        EXPECT_TRUE(kept);
        return sessionMarks(SessionReader::open(path).value()).value();
    }
    SessionAbout about = test::someAbout();
    test::ScratchDir folder;
    test::HandClock clock;
};

TEST_F(SessionMarks, AreTheOriginTheCalibrationsTheFlagsAndTheKnownLimit) {
    const auto marks =
        of({{kMarkEvent, {{"text", "sliding assumed"}}},
            {kMarksEvent, {{"flags", {"sliding assumed", "uncalibrated R"}}, {"stimulator_calibrated", false}}}});
    ASSERT_EQ(marks.size(), 6U) << nlohmann::json(marks).dump();
    EXPECT_EQ(marks[0], "Real: stimulator P24 0123, which delivered 0 trains.");
    EXPECT_EQ(marks[2], "The stimulator is not calibrated.");
    EXPECT_EQ(marks[3], "sliding assumed") << "once";
    EXPECT_EQ(marks[4], "uncalibrated R");
    EXPECT_EQ(marks[5], kKnownLimitOfR);
}

TEST_F(SessionMarks, OfARunThatCalibratesSayHowItWasBefore) {
    const auto path = folder.path() / "calibrates.tacto";
    const auto writer = SessionWriter::create(path, about, clock).value();
    ASSERT_TRUE(writer->measurement(Instant(1), kCalibrationMeasurement, nlohmann::json::object()));
    ASSERT_TRUE(
        writer->event(Instant(1), kMarksEvent, {{"flags", {"uncalibrated R"}}, {"stimulator_calibrated", false}}));
    ASSERT_TRUE(writer->close());
    const auto marks = sessionMarks(SessionReader::open(path).value()).value();
    EXPECT_THAT(marks, Contains("Before this run the stimulator was not calibrated."));
    EXPECT_THAT(marks, testing::Not(Contains("The stimulator is not calibrated.")));
}

TEST_F(SessionMarks, OfACalibratedRSayHowFarItCanBeOff) {
    const auto known =
        of({{kMarksEvent, {{"flags", nlohmann::json::array()}, {"R_expanded_uncertainty", {0.034, 0.031, 0.033}}}}});
    EXPECT_THAT(known, Contains("U of R (95 %, one slide): 0.034 at R 0, 0.031 at R 0.5, 0.033 at R 1."));
    std::filesystem::remove(folder.path() / "run.tacto");
    const auto unknown = of({{kMarksEvent, {{"flags", nlohmann::json::array()}, {"R_expanded_uncertainty", nullptr}}}});
    EXPECT_THAT(unknown, Contains("The uncertainty of R is not known."));
}

TEST_F(SessionMarks, OfACalibratedRigWithoutAFingertipAreNone) {
    about.devices.erase(about.devices.begin());
    EXPECT_EQ(of({{kMarksEvent, {{"flags", nlohmann::json::array()}, {"stimulator_calibrated", true}}}}),
              std::vector<std::string>{});
}

TEST_F(SessionMarks, OfAnOlderSessionAreNotKnownRatherThanNone) {
    const auto marks = of({{"armed", nlohmann::json::object()}});
    EXPECT_THAT(marks, Contains(HasSubstr("Marks were not recorded")));
    EXPECT_THAT(marks, testing::Not(Contains("The stimulator is not calibrated."))) << "it may have been";
}

TEST_F(SessionMarks, OfARunThatBrokeOffAreTheFlagsThatDroveTheOutput) {
    const auto marks = of({{kMarkEvent, {{"text", "uncalibrated R"}}}}, false);
    EXPECT_THAT(marks, Contains("uncalibrated R"));
    EXPECT_THAT(marks, Contains(HasSubstr("may not be complete")));
}

TEST(RoughnessFlags, AreCountedAndTheLargerCountStays) {
    RoughnessFlags flags, other;
    flags.raise(RoughnessFlag::UncalibratedR, true);
    flags.count(RoughnessFlag::ForceStale, 2);
    other.count(RoughnessFlag::ForceStale, 5);
    other.count(RoughnessFlag::TaxelsOrder, 1);
    flags.include(other);
    EXPECT_EQ(flags.texts(),
              (std::vector<std::string>{"uncalibrated R", "force stale: 5", "repeats or clock steps in taxels: 1"}));
    flags.dropCalibration();
    EXPECT_FALSE(flags.has(RoughnessFlag::UncalibratedR));
    EXPECT_TRUE(RoughnessFlags{}.texts().empty());
}

}  // namespace
}  // namespace tacto
