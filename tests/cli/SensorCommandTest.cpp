// sensor status: the built program with an emulated board behind a pseudo-terminal.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "resources/firmware/tactile_encoder/tactile_encoder.h"
#include "tests/cli/ExitsInTime.h"
#include "tests/cli/Shape.h"
#include "tests/drivers/sensor_board/BoardOnPty.h"
#include "tests/support/InTime.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;

class SensorCommand : public testing::Test {
protected:
    [[nodiscard]] std::string uri(const std::string& parameters = "") const {
        return "sensor:?emulated=yes&tty=" + board_.path() + parameters;
    }
    [[nodiscard]] Ran status(const Words& more = {}) const {
        Words words{"sensor", "status", uri()};
        words.insert(words.end(), more.begin(), more.end());
        return desk_.run(words);
    }

    const SteadyClock clock_;
    const Desk desk_;
    BoardOnPty board_{clock_};
};

TEST_F(SensorCommand, StatusSaysWhoItIsWhatItIsSetToAndHowItsLineIs) {
    const auto ran = status({"--json"});
    ASSERT_EXIT_IN_TIME(ran.code, 0) << ran.err;
    const auto value = jsonOf(ran);
    expectKeys(value,
               {"uri", "name", "serial", "firmware", "simulated", "seconds", "streams", "losses", "line", "board"},
               "status");
    EXPECT_EQ(value["serial"], "EMU-0001");
    EXPECT_EQ(value["simulated"], true) << "an emulated board says so";
    EXPECT_IN_TIME(std::abs(value["seconds"].get<double>() - 2) <= 0.5) << value["seconds"];
    EXPECT_IN_TIME(value["losses"] == 0);
    ASSERT_EQ(value["streams"].size(), 3U);
    const auto& acceleration = value["streams"][0];
    EXPECT_EQ(acceleration["kind"], "acceleration");
    EXPECT_EQ(acceleration["channels"], 3);
    EXPECT_EQ(acceleration["format"], "int16");
    EXPECT_EQ(acceleration["rate_hz"], 4000.0);
    EXPECT_NEAR(acceleration["measured_rate_hz"].get<double>(), 4000, 40);
    EXPECT_IN_TIME(acceleration["samples"] > 7000) << acceleration["samples"];
    EXPECT_EQ(acceleration["calibrated"], true);
    EXPECT_EQ(acceleration["calibration_date"], "2026-11-20");
    EXPECT_EQ(acceleration["scale"], Json({0.0048828125, 0.0048828125, 0.0048828125}));
    EXPECT_EQ(value["streams"][1]["scale_uncertainty"].size(), 8U);
    const auto& line = value["line"];
    expectKeys(line, {"samples", "samples_lost", "crc_errors", "drift_ppm", "drift_uncertainty_ppm", "delay_most_s"},
               "line");
    EXPECT_IN_TIME(line["delay_most_s"].get<double>() < 0.1);
    EXPECT_FALSE(board_.inspect([](auto& board, Instant) { return board.running(); })) << "it was told to stop";
}

TEST_F(SensorCommand, WhatIsLostIsSaidInWordsToo) {
    RecordProperty("hazard", "H7");
    board_.inspect([](auto& board, Instant) { board.spoil({.drop = 0.2, .flip = 0.2}); });
    const auto ran = status({"--seconds", "1"});
    ASSERT_EXIT_IN_TIME(ran.code, 0) << ran.err;
    for (const auto* part : {"something was lost", "CRC errors", "not known yet", "EMU-0001", "(simulated)", "4000 Hz",
                             "calibrated 2026-11-20 (emulated: exact)"})
        EXPECT_THAT(ran.out, HasSubstr(part));
    EXPECT_EQ(ran.err, "");
}

TEST_F(SensorCommand, RatesAreSetByTheUri) {
    const auto ran = desk_.run({"sensor", "status", uri("&rate=1kHz"), "--seconds", "0.5", "--json"});
    ASSERT_EXIT_IN_TIME(ran.code, 0) << ran.err;
    EXPECT_EQ(jsonOf(ran)["streams"][0]["rate_hz"], 1000.0);
}

TEST_F(SensorCommand, ABoardThatEncodesSaysByWhichProfile) {
    sensorboard::EmulatedBoardSettings settings;
    settings.highestVersion = 2;
    settings.encoder = tsb_encoder{0, 0, TE_LAYOUT, 0x00C0FFEE};
    const BoardOnPty board(clock_, settings);
    const auto about = "sensor:?emulated=yes&encodes=shown&tty=" + board.path();
    const auto ran = desk_.run({"sensor", "status", about, "--seconds", "0.5", "--json"});
    ASSERT_EXIT_IN_TIME(ran.code, 0) << ran.err;
    EXPECT_EQ(jsonOf(ran)["encoder_hash"], "00c0ffee");
    EXPECT_THAT(desk_.run({"sensor", "status", about, "--seconds", "0.5"}).out, HasSubstr("with hash 00c0ffee"));
}

TEST_F(SensorCommand, ABoardThatTalksGarbageOrIsNotThereCouldNotRun) {
    board_.inspect([](auto& board, Instant) { board.talkGarbage(true); });
    expectRefused(status(), 3, {"it answers HELLO with garbage"});
    expectRefused(desk_.run({"sensor", "status", "sensor:?tty=/dev/pts/98765"}), 3, {"/dev/pts/98765"});
}

TEST_F(SensorCommand, AWrongCommandLineIsSaidInOneSentence) {
    expectRefused(desk_.run({"sensor"}), 2, {"status or compare is missing"});
    expectRefused(desk_.run({"sensor", "reset"}), 2, {"\"reset\"", "status or compare is expected"});
    expectRefused(desk_.run({"sensor", "status", "sim:finger"}), 2, {"sim:finger", "sensor:SERIAL"});
    expectRefused(desk_.run({"sensor", "status", "sensor:", "sensor:"}), 2, {"a second one"});
    expectRefused(status({"--seconds", "nan"}), 2, {"--seconds"});
    expectRefused(status({"--seconds", "0.1"}), 2, {"--seconds is 0.1", "0.5 to 3600"});
    expectRefused(desk_.run({"sensor", "status", "--profile", "F"}), 2, {"--profile", "compare"});
    expectRefused(desk_.run({"sensor", "compare"}), 2, {"RECORDING or URI"});
    expectRefused(desk_.run({"sensor", "compare", "nowhere"}), 3, {"nowhere", "neither a file"});
    expectRefused(desk_.run({"sensor", "status", uri("&rate=5")}), 2, {"rate=5", "100 Hz to 20 kHz"});
}

}  // namespace
}  // namespace tacto::test
