// firmware-profile: a laboratory's profile for a board that encodes by itself, checked with zlib's CRC.
#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <zlib.h>

#include "core/base/Csv.h"
#include "tests/cli/Shape.h"

namespace tacto::test {
namespace {

const std::string kShipped = (sourceDir() / "resources" / "encodings" / "default.json").string();

TEST(FirmwareProfile, WritesBytesWithTheirHash) {
    const Desk desk;
    const auto out = (desk.path() / "board.bin").string();
    const auto value = jsonOf(desk.run({"firmware-profile", kShipped, "--load", "1000", "--out", out, "--json"}));
    expectKeys(value, {"out", "hash", "bytes"}, "firmware-profile");
    const auto bytes = readTextFile(out, 10'000).value();
    EXPECT_EQ(value["bytes"], bytes.size());
    const auto crc = crc32(0, reinterpret_cast<const Bytef*>(bytes.data()) + 8, static_cast<uInt>(bytes.size() - 8));
    EXPECT_EQ(value["hash"], fmt::format("{:08x}", crc));
    std::uint32_t inside = 0;
    std::memcpy(&inside, bytes.data() + 4, 4);
    EXPECT_EQ(inside, crc);
}

TEST(FirmwareProfile, WritesAHeaderForTheSensorsOfARecording) {
    const Desk desk;
    const auto out = (desk.path() / "board.h").string();
    const auto recording = (sourceDir() / "resources" / "examples" / "linen-slide").string();
    const auto ran = desk.run({"firmware-profile", kShipped, "--load", "500", "--source", "current", "--step", "0.1",
                               "--recording", recording, "--out", out});
    EXPECT_EQ(ran.code, 0) << ran.err;
    EXPECT_THAT(ran.out, testing::HasSubstr("hash "));
    const auto text = readTextFile(out, 100'000).value();
    EXPECT_THAT(text, testing::AllOf(testing::HasSubstr(".taxels = 16U"), testing::HasSubstr(".current_source = 1U"),
                                     testing::HasSubstr(".acceleration_hz = 0.0"), testing::HasSubstr("default")));
}

TEST(FirmwareProfile, TakesSensorsAndStimulatorFromTheDevicesOfABench) {
    const Desk desk;
    const auto out = (desk.path() / "board.h").string();
    const auto hashOf = [&](std::vector<std::string> more) {
        std::vector<std::string> all{"firmware-profile", kShipped, "--load", "1000", "--out", out, "--json"};
        all.insert(all.end(), more.begin(), more.end());
        return jsonOf(desk.run(all))["hash"].get<std::string>();
    };
    const auto usual = hashOf({});
    EXPECT_EQ(hashOf({"--device", "sim:finger"}), usual) << "the simulated finger is the usual one";
    const auto current = hashOf({"--device", "sim:finger", "--device", "sim:stimulator?mode=current&step=0.1mA"});
    EXPECT_NE(current, usual);
    EXPECT_THAT(readTextFile(out, 100'000).value(), testing::HasSubstr(".current_source = 1U"));
    expectRefused(desk.run({"firmware-profile", kShipped, "--load", "1000", "--out", out, "--device", "sim:stimulator",
                            "--step", "0.1"}),
                  2, {"--step and a stimulator"});
    expectRefused(
        desk.run({"firmware-profile", kShipped, "--load", "1000", "--out", out, "--device", "sim:oscilloscope"}), 2,
        {"--device is a sensor: or the address of a stimulator"});
}

TEST(FirmwareProfile, WhatTheBoardCannotDoIsRefused) {
    RecordProperty("hazard", "H1");
    const Desk desk;
    const auto out = (desk.path() / "board.bin").string();
    expectRefused(desk.run({"firmware-profile", kShipped, "--load", "200 ohm + 10 kohm || 50 nF", "--out", out}), 3,
                  {"200 ohm", "a resistance"});
    expectRefused(desk.run({"firmware-profile", kShipped, "--out", out}), 2, {"--load"});
    expectRefused(desk.run({"firmware-profile", kShipped, "--load", "500", "--out", "board.txt"}), 2,
                  {"board.txt", "FILE.h"});
    expectRefused(desk.run({"firmware-profile", kShipped, "--load", "500", "--source", "charge", "--out", out}), 2,
                  {"charge", "voltage or current"});
    EXPECT_FALSE(std::filesystem::exists(out));
}

}  // namespace
}  // namespace tacto::test
