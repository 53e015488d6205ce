// Checks the firmware's C code with the frames of PROTOCOL.md: on this computer, on 32 bits without a C library, and on
// a big-endian machine if one can be emulated.
#include <cstdio>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include "drivers/sensor_board/Messages.h"
#include "resources/firmware/sensor_board/tsb_board.h"
#include "tests/drivers/sensor_board/Golden.h"
#include "tests/drivers/sensor_board/firmware/Replay.h"
#include "tests/support/Support.h"

namespace tacto::test {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes boardFrames() {
    Bytes all;
    for (const auto& frame : goldenFrames()) {
        if (!frame.fromHost()) all.insert(all.end(), frame.bytes.begin(), frame.bytes.end());
    }
    return all;
}

Bytes hostFrames() {
    Bytes all;
    for (const auto& frame : goldenFrames()) {
        if (frame.fromHost()) all.insert(all.end(), frame.bytes.begin(), frame.bytes.end());
    }
    return all;
}

Bytes replay(const Bytes& in) {
    Bytes out(65536);
    out.resize(tacto_replay(in.data(), in.size(), out.data(), out.size()));
    return out;
}

/// Runs a program with the input `in` and returns its output.
Bytes run(const std::string& program, const Bytes& in) {
    const ScratchDir scratch;
    const auto given = scratch.write("in", std::string(in.begin(), in.end()));
    FILE* pipe = popen((program + " < '" + given.string() + "'").c_str(), "r");
    if (pipe == nullptr) return {};
    Bytes out(65536);
    out.resize(fread(out.data(), 1, out.size(), pipe));
    const int status = pclose(pipe);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << program << " ended with " << status;
    return out;
}

TEST(SensorBoardFirmware, SpecificationHasItsFrames) {
    std::size_t fromHost = 0;
    for (const auto& frame : goldenFrames()) {
        ASSERT_GT(frame.bytes.size(), 6U) << frame.text;
        EXPECT_EQ(frame.bytes.back(), 0) << frame.text;
        fromHost += frame.fromHost() ? 1 : 0;
    }
    EXPECT_EQ(fromHost, 9U);
    EXPECT_EQ(goldenFrames().size(), 22U);
}

TEST(SensorBoardFirmware, MakesTheGoldenFramesByteForByte) {
    RecordProperty("hazard", "H7");
    EXPECT_EQ(replay({}), boardFrames());
}

TEST(SensorBoardFirmware, HearsTheGoldenCommands) {
    RecordProperty("hazard", "H4");
    struct Heard {
        std::uint8_t type, token, stream, mode;
        bool operator==(const Heard&) const = default;
    };
    std::vector<Heard> heard;
    tsb_receiver receiver{};
    tsb_configuration set{};
    for (const auto byte : hostFrames()) {
        tsb_command command{};
        if (tsb_receive(&receiver, byte, &command) == 0) continue;
        heard.push_back({command.type, command.token, command.stream, command.mode});
        if (command.type == TSB_SET_CONFIGURATION) set = command.configuration;
    }
    EXPECT_EQ(heard, (std::vector<Heard>{{TSB_HELLO, 1, 0, 0},
                                         {TSB_GET_CONFIGURATION, 2, 1, 0},
                                         {TSB_SET_CONFIGURATION, 3, 2, 0},
                                         {TSB_GET_CALIBRATION, 4, 0, 0},
                                         {TSB_START, 5, 0, 0},
                                         {TSB_STOP, 6, 0, 0},
                                         {TSB_GET_STATUS, 7, 0, 0},
                                         {TSB_GET_ENCODER, 8, 0, 0},
                                         {TSB_SET_ENCODER, 9, 0, TSB_MODE_ENCODE}}));
    EXPECT_EQ(receiver.refused, 0U);
    EXPECT_EQ(set.kind, TSB_KIND_FORCE);
    EXPECT_EQ(set.unit, TSB_UNIT_NEWTON);
    EXPECT_EQ(set.format, TSB_FORMAT_INT32);
    EXPECT_EQ(set.columns, 1);
    EXPECT_EQ(set.rate_mhz, 200'000U);
    EXPECT_FLOAT_EQ(set.scale[0], 0.0005F);
    EXPECT_FLOAT_EQ(set.offset[0], -0.25F);
}

TEST(SensorBoardFirmware, HostSendsTheGoldenCommands) {
    using namespace sensorboard;
    using sensorboard::Command;
    const auto sent = [](Command command, std::uint8_t token, const Bytes& payload = {}) {
        auto bytes = encodeCommand(command, token, payload);
        EXPECT_EQ(bytes.front(), 0);  // the zero ends whatever came before
        bytes.erase(bytes.begin());
        return bytes;
    };
    EXPECT_EQ(sent(Command::Hello, 1), golden("HELLO"));
    EXPECT_EQ(sent(Command::GetConfiguration, 2, {1}), golden("GET_CONFIGURATION"));
    StreamConfiguration force{2, true, StreamKind::Force, StreamUnit::Newton, SampleFormat::Int32, 200'000, {}};
    force.columns.push_back({0.0005, -0.25});
    EXPECT_EQ(sent(Command::SetConfiguration, 3, configurationPayload(force)), golden("SET_CONFIGURATION"));
    EXPECT_EQ(sent(Command::GetCalibration, 4, {0}), golden("GET_CALIBRATION"));
    EXPECT_EQ(sent(Command::Start, 5), golden("START"));
    EXPECT_EQ(sent(Command::Stop, 6), golden("STOP"));
    EXPECT_EQ(sent(Command::GetStatus, 7), golden("GET_STATUS"));
    EXPECT_EQ(sent(Command::GetEncoder, 8), golden("GET_ENCODER"));
    EXPECT_EQ(sent(Command::SetEncoder, 9, {1}), golden("SET_ENCODER"));
}

TEST(SensorBoardFirmware, RefusesToMakeWhatTheProtocolCannotCarry) {
    std::array<std::uint8_t, TSB_FRAME_MOST> frame{};
    const std::array<std::int16_t, 256> narrow{};
    const std::array<std::int32_t, 256> wide{};
    tsb_block block{};
    block.columns = 3;
    EXPECT_EQ(tsb_encode_int16(frame.data(), &block, narrow.data()), 0U) << "an empty block";
    block.count = tsb_block_most(3, TSB_FORMAT_INT16);
    EXPECT_EQ(block.count, 37);
    EXPECT_GT(tsb_encode_int16(frame.data(), &block, narrow.data()), 0U);
    ++block.count;
    EXPECT_EQ(tsb_encode_int16(frame.data(), &block, narrow.data()), 0U);
    block.count = 1;
    block.columns = 17;
    EXPECT_EQ(tsb_encode_int32(frame.data(), &block, wide.data()), 0U);
    EXPECT_EQ(tsb_block_most(3, 7), 0) << "no such format";
    tsb_configuration configuration{};
    EXPECT_EQ(tsb_encode_configuration(frame.data(), 1, &configuration), 0U) << "no columns";
    tsb_identity identity{1, 1, 9, "n", "s", "f"};
    EXPECT_EQ(tsb_encode_identity(frame.data(), 1, &identity), 0U) << "nine streams";
}

TEST(SensorBoardFirmware, CommandReceiverStaysBoundedAndResynchronises) {
    RecordProperty("hazard", "H10");
    tsb_receiver receiver{};
    tsb_command command{};
    for (int i = 0; i < 100'000; ++i) ASSERT_EQ(tsb_receive(&receiver, 0x55, &command), 0);
    EXPECT_LE(receiver.used, TSB_FRAME_MOST);
    EXPECT_EQ(tsb_receive(&receiver, 0, &command), 0);
    EXPECT_EQ(receiver.refused, 1U);
    int heard = 0;
    for (const auto byte : golden("STOP")) heard += tsb_receive(&receiver, byte, &command);
    EXPECT_EQ(heard, 1);
    EXPECT_EQ(command.type, TSB_STOP);
}

TEST(SensorBoardFirmware, HearsACommandOnlyInTheVersionThatBroughtIt) {
    RecordProperty("hazard", "H4");
    for (unsigned version = 0; version < 256; ++version) {
        for (unsigned type = 0; type < 64; ++type) {
            std::array<std::uint8_t, TSB_FRAME_MOST> frame{};
            tsb_writer writer{};
            tsb_begin(&writer, frame.data(), static_cast<std::uint8_t>(version), static_cast<std::uint8_t>(type));
            tsb_put_u8(&writer, 1);
            const bool named = type == TSB_GET_CONFIGURATION || type == TSB_GET_CALIBRATION || type == TSB_SET_ENCODER;
            if (named) tsb_put_u8(&writer, 1);
            const auto size = tsb_seal(&writer);
            tsb_receiver receiver{};
            tsb_command command{};
            int heard = 0;
            for (std::size_t i = 0; i < size; ++i) heard += tsb_receive(&receiver, frame[i], &command);
            // An incomplete configuration is never sound; types of no version are handed over to be refused.
            const bool known = type >= 1 && type <= 7, added = type == 8 || type == 9;
            const bool sound = type != TSB_SET_CONFIGURATION && ((version == 1 && !added) || (version == 2 && !known));
            ASSERT_EQ(heard, sound ? 1 : 0) << "version " << version << ", type " << type;
        }
    }
}

TEST(SensorBoardFirmware, SameBytesOn32BitsWithoutALibrary) {
    if (std::string(TACTO_REPLAY_32).empty()) {
        GTEST_SKIP() << "not tested: this compiler or kernel has no -m32";
    }
    const auto here = replay(hostFrames());
    EXPECT_GT(here.size(), boardFrames().size());
    EXPECT_EQ(run(TACTO_REPLAY_32, hostFrames()), here);
}

TEST(SensorBoardFirmware, SameBytesOnABigEndianMachine) {
    if (std::string(TACTO_REPLAY_BIG_ENDIAN).empty()) {
        GTEST_SKIP() << "not tested: gcc-s390x-linux-gnu, libc6-dev-s390x-cross and qemu-user-static are not all here";
    }
    EXPECT_EQ(run(TACTO_REPLAY_BIG_ENDIAN, hostFrames()), replay(hostFrames()));
}

}  // namespace
}  // namespace tacto::test
