// A whole board as its maker compiles it for a Cortex-M, under QEMU behind a pseudo-terminal: its encoder makes of its
// samples what the same code makes of them here, to the last bit. What it passes as any board: BoardAtTerminalTest.cpp.
#include <algorithm>
#include <bit>
#include <gtest/gtest.h>
#include <map>

#include "drivers/sensor_board/Fields.h"
#include "resources/firmware/sensor_board/tsb_board.h"
#include "tests/firmware/BoardAtTerminal.h"
#include "tests/firmware/ProfileOnQemu.h"
#include "tests/support/InTime.h"

namespace tacto::test {
namespace {

using namespace sensorboard;
using sensorboard::Command;

/// The encoder here, fed with the blocks that the board sent.
class EncoderHere {
public:
    EncoderHere() { EXPECT_EQ(te_init(state_.get(), &profile_), TE_ACCEPTED); }
    /// A DATA frame of one of the board's streams: acceleration, taxels, force.
    void take(const std::vector<std::uint8_t>& payload) {
        struct Stream {
            te_stream kind;
            std::size_t columns;
            float scale;
        };
        constexpr std::array<Stream, 3> kStreams{
            {{TE_ACCELERATION, 3, 0.005F}, {TE_TAXEL_ARRAY, 8, 2}, {TE_FORCE, 1, 0.0005F}}};
        FieldReader in(payload);
        const auto& stream = kStreams.at(in.u8());
        const auto count = in.u8();
        static_cast<void>(in.u64());  // sequence and index
        const auto first_ns = static_cast<std::int64_t>(in.u64()) * 1000;
        const auto step_ns = static_cast<std::int32_t>(in.u32());
        std::vector<float> values;
        for (std::size_t i = 0; i < count * stream.columns; ++i) {
            const int low = in.u8(), high = in.u8();
            values.push_back(stream.scale * static_cast<float>(static_cast<std::int16_t>(low | high << 8)) + 0.0F);
        }
        EXPECT_TRUE(in.whole());
        te_samples(state_.get(), stream.kind, first_ns, step_ns, values.data(), count);
        for (te_reading frame{}; te_frame(state_.get(), &frame) != 0;) frames.push_back(frame);
    }
    std::vector<te_reading> frames;

private:
    const te_profile profile_ = profileOnQemu();
    std::unique_ptr<te_state> state_ = std::make_unique<te_state>();
};

void expectSameBits(FieldReader& in, const te_reading& expected) {
    EXPECT_EQ(in.u64(), static_cast<std::uint64_t>(expected.t_ns / 1000));
    const auto flags = static_cast<std::uint32_t>(in.u8() + in.u8() * 256);
    EXPECT_EQ(flags, expected.contact + 2 * expected.sliding + 4 * expected.sliding_assumed);
    static_cast<void>(in.u32());
    for (const float value : {expected.R, expected.P, expected.pressure_pa, expected.h, expected.v})
        EXPECT_EQ(in.u32(), std::bit_cast<std::uint32_t>(value));
    EXPECT_TRUE(in.whole());
}

void expectWithin(FieldReader& in, const te_profile& profile, std::uint64_t& onset_us) {
    const auto onset = in.u64();
    EXPECT_GE(onset, onset_us);
    const double interval_s = in.f32(), command = in.f32(), amplitude = in.f32();
    EXPECT_GE(interval_s, double{profile.interval_min_s});
    onset_us = onset + static_cast<std::uint64_t>(interval_s * 0.5e6);
    EXPECT_EQ(command, amplitude) << "a voltage without steps";
    EXPECT_GE(amplitude, double{profile.amplitude_min_v});
    EXPECT_LE(amplitude, double{profile.amplitude_max_v});
    EXPECT_EQ(in.u8(), profile.shape);
    EXPECT_EQ(in.u8(), profile.negative);
    EXPECT_EQ(in.f32(), double{profile.width_us});
    EXPECT_EQ(in.f32(), double{profile.gap_us});
    EXPECT_EQ(in.f32(), double{profile.recharge_ratio});
    EXPECT_EQ(in.u32(), profile.pulses);
    EXPECT_EQ(in.f32(), double{profile.pulse_hz});
    EXPECT_LE(in.u16(), TE_AHEAD_NS / 1000);
    EXPECT_TRUE(in.whole());
}

/// Sends what a board says from a start to its third train into `told`; returns whether nothing of it was lost.
bool heardWhole(PlainHost& host) {
    host.told.clear();
    static_cast<void>(host.ask(Command::Start));
    const bool heard = host.hear(Reply::Train, 3);
    static_cast<void>(host.ask(Command::Stop));
    std::map<int, std::uint32_t> seen;
    return heard && std::ranges::all_of(host.told, [&](const Told& one) {
               if (one.is(Reply::Data)) {
                   const auto block = readBlock(one.frame());
                   return block && block->sequence == seen[-1 - block->stream]++;
               }
               if (!one.is(Reply::Reading) && !one.is(Reply::Train)) return true;
               FieldReader in(one.payload);
               return in.u32() == seen[one.type]++;
           });
}

}  // namespace

TEST(BoardOnQemu, EncodesItsSamplesToTheBitsThatTheSameCodeMakesHere) {
    if (std::string_view(TACTO_WHOLE_BOARD).empty()) GTEST_SKIP() << kNoBoard;
    RecordProperty("hazard", "H7");
    TerminalRig rig(std::make_unique<QemuAtTerminal>());
    PlainHost host(rig);
    const te_profile profile = profileOnQemu();
    const auto state = accepted(readEncoder(host.ask(Command::SetEncoder, {TSB_MODE_ENCODE}).frame()));
    EXPECT_TRUE(state.encodes);
    EXPECT_EQ(state.refusal, TE_ACCEPTED);
    EXPECT_EQ(state.layout, TE_LAYOUT);
    EXPECT_EQ(state.hash, profile.hash);
    // A computer with too much to do loses something of a line in real time; then the board begins anew.
    bool whole = false;
    for (int attempt = 0; attempt < 5 && !whole; ++attempt) whole = heardWhole(host);
    ASSERT_IN_TIME(whole);

    EncoderHere here;
    std::map<int, std::uint32_t> seen;
    std::uint64_t onset_us = 0;
    for (const auto& one : host.told) {
        FieldReader in(one.payload);
        const auto number = seen[one.type]++;
        if (one.type == TSB_DATA) here.take(one.payload);
        if (one.type != TSB_READING && one.type != TSB_TRAIN) continue;
        EXPECT_EQ(in.u32(), number);
        if (one.type == TSB_TRAIN) expectWithin(in, profile, onset_us);
        if (one.type != TSB_READING) continue;
        ASSERT_LT(number, here.frames.size());
        expectSameBits(in, here.frames[number]);
    }
    EXPECT_EQ(seen[TSB_READING], here.frames.size());
    EXPECT_GT(seen[TSB_READING], 60U);
    EXPECT_EQ(host.counts().bad(), 0U);
}

}  // namespace tacto::test
