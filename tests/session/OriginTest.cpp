// Marks: what is simulated, replayed and real in a session, in sentences.
#include <gtest/gtest.h>

#include "core/session/Origin.h"

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

}  // namespace
}  // namespace tacto
