// The board's loop (resources/firmware/tactile_board): what it answers, sends, encodes and plays, and when it does not.
#include <algorithm>
#include <cmath>
#include <functional>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <memory>

#include "app/run/EncoderComparison.h"
#include "core/base/Random.h"
#include "drivers/sensor_board/EncoderProfile.h"
#include "drivers/sensor_board/Fields.h"
#include "drivers/sensor_board/Messages.h"
#include "resources/firmware/tactile_board/tactile_board.h"

namespace tacto::test {
namespace {

using namespace sensorboard;
using testing::ElementsAre;
using testing::IsEmpty;

constexpr std::uint64_t kBlock_us = 10'000, kSecond_us = 1'000'000;
constexpr std::uint8_t kToken = 7;
constexpr float kForceScale = 0.001F, kTaxelScale = 2, kAccelerationScale = 0.005F;

struct Heard {
    std::uint8_t version, type;
    std::vector<std::uint8_t> payload;
};

/// A board with three sensors on a clock that the test moves. The finger rests for half a second and then slides.
class TactileBoard : public testing::Test {
protected:
    TactileBoard() {
        const std::vector<StreamInfo> streams{
            {StreamKind::Acceleration, StreamUnit::MetrePerSecondSquared, 2, 1000, "acceleration"},
            {StreamKind::Force, StreamUnit::Newton, 1, 100, "force"},
            {StreamKind::Taxels, StreamUnit::Pascal, 4, 100, "taxels"}};
        profile_ = encoderProfile(streams, {}, {}, idealOutput()).value();
        setup_.name = "loop";
        setup_.serial = "EMU-7";
        setup_.firmware = "1";
        setup_.streams = 3;
        configure(0, TSB_KIND_ACCELERATION, TSB_UNIT_METRE_PER_SECOND_SQUARED, 2, 1'000'000, kAccelerationScale);
        configure(1, TSB_KIND_FORCE, TSB_UNIT_NEWTON, 1, 100'000, kForceScale);
        configure(2, TSB_KIND_TAXELS, TSB_UNIT_PASCAL, 4, 100'000, kTaxelScale);
        setup_.profile = &profile_;
        setup_.rested = 1;
        hardware_.context = this;
        hardware_.now_us = [](void* self) { return of(self).now_us_; };
        hardware_.read = [](void* self, tb_samples* into) { return of(self).next(into); };
        hardware_.hear = [](void* self, std::uint8_t* bytes, std::size_t most) {
            return of(self).toBoard(bytes, most);
        };
        hardware_.say = [](void* self, const std::uint8_t* frame, std::size_t size) {
            auto& to = of(self);
            if (to.deaf_) return 0;
            to.said_.insert(to.said_.end(), frame, frame + size);
            return 1;
        };
        hardware_.play = [](void* self, const te_train* train) {
            auto& to = of(self);
            if (train == nullptr) {
                ++to.cancelled_;
            } else {
                to.played_.push_back(*train);
                if (to.whilePlayed_) to.whilePlayed_();
            }
            return to.plays_ ? 1 : 0;
        };
    }

    void begin() { ASSERT_EQ(tb_init(board_.get(), &setup_, &hardware_), 1); }
    /// Lets time pass in steps of a millisecond; each 10 ms give a block of each stream.
    void run(std::uint64_t us) {
        for (const auto end = now_us_ + us; now_us_ < end;) {
            now_us_ += 1000;
            if (now_us_ % kBlock_us == 0 && feels_) feel();
            tb_step(board_.get());
        }
    }
    void send(sensorboard::Command command, const std::vector<std::uint8_t>& payload = {}) {
        sendFrame(TSB_VERSION, static_cast<std::uint8_t>(command), payload);
    }
    void sendFrame(std::uint8_t version, std::uint8_t type, const std::vector<std::uint8_t>& payload = {}) {
        tsb_writer writer{};
        std::array<std::uint8_t, TSB_FRAME_MOST> frame{};
        tsb_begin(&writer, frame.data(), version, type);
        tsb_put_u8(&writer, kToken);
        for (const auto byte : payload) tsb_put_u8(&writer, byte);
        toBoard_.insert(toBoard_.end(), frame.begin(), frame.begin() + static_cast<std::ptrdiff_t>(tsb_seal(&writer)));
        for (int i = 0; i < 4; ++i) tb_step(board_.get());
    }
    /// The frames since the last call, of `type` alone if given.
    std::vector<Heard> heard(std::uint8_t type = 0) {
        std::vector<Heard> all;
        std::span<const std::uint8_t> left(said_);
        while (const auto frame = decoder_.take(left)) {
            if (type == 0 || frame->type == type)
                all.push_back({frame->version, frame->type, {frame->payload.begin(), frame->payload.end()}});
        }
        EXPECT_EQ(decoder_.counts().bad(), 0U);
        said_.clear();
        return all;
    }
    Heard answer() {
        auto all = heard();
        EXPECT_EQ(all.size(), 1U);
        if (all.empty()) return {};
        EXPECT_EQ(all[0].payload.at(0), kToken);
        all[0].payload.erase(all[0].payload.begin());
        return all[0];
    }
    /// Expects REFUSED with this reason.
    void expectRefused(std::uint8_t command, std::uint8_t reason) {
        const auto said = answer();
        EXPECT_EQ(said.type, TSB_REFUSED);
        EXPECT_THAT(said.payload, ElementsAre(command, reason));
    }
    void inject(const tb_samples& samples) { felt_.push_back(samples); }
    void startEncoding() {
        sendFrame(TSB_VERSION_2, TSB_SET_ENCODER, {TSB_MODE_ENCODE});
        send(sensorboard::Command::Start);
        heard();
    }
    void expectEncoder(std::uint8_t mode, std::uint8_t refusal) {
        const auto said = answer();
        EXPECT_EQ(said.version, TSB_VERSION_2);
        EXPECT_EQ(said.type, TSB_ENCODER);
        FieldReader in(said.payload);
        EXPECT_EQ(in.u8(), mode);
        EXPECT_EQ(in.u8(), refusal);
        EXPECT_EQ(in.u32(), TE_LAYOUT);
        EXPECT_EQ(in.u32(), profile_.hash);
        EXPECT_TRUE(in.whole());
    }

    te_profile profile_{};
    tb_setup setup_{};
    tb_hardware hardware_{};
    std::unique_ptr<tb_board> board_ = std::make_unique<tb_board>();
    std::uint64_t now_us_ = 0;
    std::vector<te_train> played_;
    std::function<void()> whilePlayed_;
    int cancelled_ = 0;
    bool deaf_ = false, plays_ = true, feels_ = true;
    std::vector<tb_samples> given_;  // all blocks that the board read
    std::uint32_t lost_ = 0;         // of the next block of acceleration
    std::function<void(tb_samples&)> spoil_;
    Random random_{11, "board loop"};

private:
    static TactileBoard& of(void* self) { return *static_cast<TactileBoard*>(self); }
    void configure(std::uint8_t stream, std::uint8_t kind, std::uint8_t unit, std::uint8_t columns, std::uint32_t mHz,
                   float scale) {
        auto& c = setup_.configuration[stream];
        c = {stream, TSB_STREAM_ENABLED, kind, unit, TSB_FORMAT_INT16, columns, mHz, {}, {}};
        std::fill_n(c.scale, columns, scale);
        setup_.calibration[stream] = {stream, TSB_STREAM_CALIBRATED, columns, "2026-11-20", "by hand", {}};
    }
    int next(tb_samples* into) {
        if (felt_.empty()) return 0;
        *into = felt_.front();
        felt_.erase(felt_.begin());
        given_.push_back(*into);
        return 1;
    }
    std::size_t toBoard(std::uint8_t* bytes, std::size_t most) {
        const auto count = std::min(most, toBoard_.size());
        std::copy_n(toBoard_.begin(), count, bytes);
        toBoard_.erase(toBoard_.begin(), toBoard_.begin() + static_cast<std::ptrdiff_t>(count));
        return count;
    }
    std::int32_t noise(double size) { return static_cast<std::int32_t>(std::lround(size * random_.normal())); }
    void feel() {
        const bool touches = now_us_ > kSecond_us / 2;
        const auto block = [&](std::uint8_t stream, std::uint8_t count, std::uint32_t interval_us, auto value) {
            tb_samples made{};
            made.stream = stream;
            made.count = count;
            made.first_us = now_us_ - (count - 1U) * interval_us;
            made.interval_ns = interval_us * 1000;
            for (int i = 0; i < count * setup_.configuration[stream].columns; ++i) made.raw[i] = value(i);
            if (spoil_) spoil_(made);
            felt_.push_back(made);
        };
        block(0, 10, 1000, [&](int) { return noise(touches ? 200 : 4); });
        felt_.back().lost = std::exchange(lost_, 0);
        block(1, 1, 10'000, [&](int) { return noise(2) + (touches ? 1000 : 0); });
        block(2, 1, 10'000, [&](int i) { return 250 + noise(3) + (touches ? 1500 + 150 * i : 0); });
    }

    std::vector<tb_samples> felt_;
    std::vector<std::uint8_t> toBoard_, said_;
    FrameDecoder decoder_;
};

}  // namespace

TEST_F(TactileBoard, AnswersTheCommandsOfTheProtocol) {
    begin();
    run(kSecond_us);
    EXPECT_THAT(heard(), IsEmpty()) << "a board speaks when it is asked";
    send(sensorboard::Command::Hello);
    auto said = answer();
    EXPECT_EQ(said.version, TSB_VERSION);
    FieldReader identity(said.payload);
    EXPECT_EQ(identity.u8(), 1);
    EXPECT_EQ(identity.u8(), 2);
    EXPECT_EQ(identity.u8(), 3);
    EXPECT_EQ(identity.text(24), "loop");
    EXPECT_EQ(identity.text(16), "EMU-7");
    send(sensorboard::Command::GetConfiguration, {2});
    said = answer();
    EXPECT_EQ(said.type, TSB_CONFIGURATION);
    EXPECT_EQ(said.payload.size(), 10U + 4 * 8);
    send(sensorboard::Command::GetConfiguration, {3});
    expectRefused(TSB_GET_CONFIGURATION, TSB_REASON_NO_SUCH_STREAM);
    send(sensorboard::Command::Stop);
    EXPECT_EQ(answer().type, TSB_DONE) << "also while it is stopped";
    send(sensorboard::Command::GetStatus);
    said = answer();
    FieldReader status(said.payload);
    EXPECT_EQ(status.u8(), 0);
    EXPECT_EQ(status.u8(), 0);
    EXPECT_EQ(status.u64(), now_us_);
    sendFrame(TSB_VERSION_2, TSB_GET_ENCODER);
    expectEncoder(TSB_MODE_OFF, TE_ACCEPTED);
    sendFrame(TSB_VERSION_2, TSB_SET_ENCODER, {2});
    expectRefused(TSB_SET_ENCODER, TSB_REASON_NOT_SUPPORTED);
    sendFrame(TSB_VERSION_2, TSB_SET_ENCODER, {TSB_MODE_ENCODE});
    expectEncoder(TSB_MODE_ENCODE, TE_ACCEPTED);
    sendFrame(TSB_VERSION, 0x3F);
    expectRefused(0x3F, TSB_REASON_UNKNOWN_COMMAND);
    send(sensorboard::Command::Start);
    heard();
    sendFrame(TSB_VERSION_2, TSB_SET_ENCODER, {TSB_MODE_OFF});
    EXPECT_EQ(heard(TSB_REFUSED).size(), 1U) << "it runs";
    setup_.profile = nullptr;
    begin();
    sendFrame(TSB_VERSION_2, TSB_GET_ENCODER);
    expectRefused(TSB_GET_ENCODER, TSB_REASON_UNKNOWN_COMMAND);
}

TEST_F(TactileBoard, TakesALaboratorysScaleAndNothingThatItCannotBe) {
    RecordProperty("hazard", "H4");
    begin();
    StreamConfiguration force{1,       true,         StreamKind::Force, StreamUnit::Newton, SampleFormat::Int16,
                              100'000, {{0.002, -1}}};
    const auto set = [&] { send(sensorboard::Command::SetConfiguration, configurationPayload(force)); };
    set();
    EXPECT_EQ(answer().type, TSB_CONFIGURATION);
    EXPECT_EQ(board_->unsaved, 2U);
    send(sensorboard::Command::GetCalibration, {1});
    EXPECT_EQ(answer().payload[1], 0) << "the certificate was for another scale";
    send(sensorboard::Command::GetCalibration, {0});
    EXPECT_EQ(answer().payload[1], TSB_STREAM_CALIBRATED);
    const auto sound = force;
    for (const auto spoil : std::initializer_list<void (*)(StreamConfiguration&)>{
             [](auto& c) { c.rate_mhz = 200'000; }, [](auto& c) { c.kind = StreamKind::Taxels; },
             [](auto& c) { c.format = SampleFormat::Int32; },
             [](auto& c) {
                 c.columns.push_back({1, 0});
             },
             [](auto& c) { c.columns[0].scale = 0; }, [](auto& c) { c.columns[0].offset = std::nan(""); },
             [](auto& c) { c.unit = StreamUnit::Pascal; }, [](auto& c) { c.unit = StreamUnit::Count; }}) {
        force = sound;
        spoil(force);
        set();
        expectRefused(TSB_SET_CONFIGURATION, TSB_REASON_NOT_SUPPORTED);
        EXPECT_EQ(board_->configuration[1].scale[0], 0.002F);
    }
    send(sensorboard::Command::Start);
    heard();
    force = sound;
    set();
    EXPECT_EQ(heard(TSB_REFUSED).size(), 1U) << "it runs";
}

TEST_F(TactileBoard, EncodesOnlyWhatItsStreamsAreTheProfilesOf) {
    RecordProperty("hazard", "H4");
    setup_.configuration[0].rate_mhz = 1'020'000;
    begin();
    sendFrame(TSB_VERSION_2, TSB_SET_ENCODER, {TSB_MODE_ENCODE});
    expectEncoder(TSB_MODE_OFF, TE_BAD_STREAM);
    setup_.configuration[0].rate_mhz = 1'005'000;
    begin();
    sendFrame(TSB_VERSION_2, TSB_SET_ENCODER, {TSB_MODE_ENCODE});
    expectEncoder(TSB_MODE_ENCODE, TE_ACCEPTED);
    StreamConfiguration off{1,       false,       StreamKind::Force, StreamUnit::Newton, SampleFormat::Int16,
                            100'000, {{0.001, 0}}};
    send(sensorboard::Command::SetConfiguration, configurationPayload(off));
    heard();
    sendFrame(TSB_VERSION_2, TSB_GET_ENCODER);
    expectEncoder(TSB_MODE_OFF, TE_BAD_STREAM);
    profile_.amplitude_max_v = 41;
    profile_.hash = te_hash(&profile_);
    begin();
    sendFrame(TSB_VERSION_2, TSB_SET_ENCODER, {TSB_MODE_ENCODE});
    expectEncoder(TSB_MODE_OFF, TE_BAD_ENCODING);
    send(sensorboard::Command::Start);
    run(2 * kSecond_us);
    for (const auto& frame : heard()) EXPECT_THAT(frame.type, testing::AnyOf(TSB_DONE, TSB_DATA, TSB_STATUS));
}

TEST_F(TactileBoard, SendsEachBlockAndCountsWhatIsMissing) {
    RecordProperty("hazard", "H7");
    begin();
    send(sensorboard::Command::Start);
    heard();
    run(kSecond_us / 2);
    lost_ = 3;
    run(kSecond_us / 10);
    deaf_ = true;
    run(kSecond_us / 10);
    deaf_ = false;
    run(kSecond_us);
    std::array<std::uint32_t, 3> sequence{}, index{};
    std::array<std::size_t, 3> blocks{};
    std::uint32_t jumps = 0;
    for (const auto& frame : heard(TSB_DATA)) {
        FieldReader in(frame.payload);
        const auto stream = in.u8(), count = in.u8();
        const auto number = in.u32(), first = in.u32();
        jumps += number - sequence.at(stream);
        sequence.at(stream) = number + 1;
        index.at(stream) = first + count;
        ++blocks.at(stream);
        const auto time = in.u64();
        const auto found = std::ranges::find_if(
            given_, [&](const tb_samples& one) { return one.stream == stream && one.first_us == time; });
        ASSERT_NE(found, given_.end());
        EXPECT_EQ(in.u32(), found->interval_ns);
        for (std::size_t i = 0; i < count * std::size_t{setup_.configuration[stream].columns}; ++i) {
            const int low = in.u8(), high = in.u8();
            EXPECT_EQ(static_cast<std::int16_t>(low | high << 8), found->raw[i]);
        }
        EXPECT_TRUE(in.whole());
    }
    EXPECT_EQ(jumps, 30U) << "three streams for a tenth of a second";
    EXPECT_THAT(blocks, ElementsAre(160, 160, 160));
    EXPECT_THAT(index, ElementsAre(1703, 170, 170));
    send(sensorboard::Command::GetStatus);
    const auto status = answer();
    FieldReader in(status.payload);
    EXPECT_EQ(in.u8(), TSB_STATUS_RUNNING);
    EXPECT_EQ(in.u8(), 0);
    EXPECT_EQ(in.u64(), now_us_);
    EXPECT_EQ(in.u32(), 3U);
    EXPECT_EQ(in.u32(), 30U);
    feels_ = false;
    run(kSecond_us);
    const auto said = heard(TSB_STATUS);
    ASSERT_EQ(said.size(), 1U);
    EXPECT_EQ(said[0].payload[2], 7) << "no sensor answers";
}

TEST_F(TactileBoard, SaysWhatItsEncoderMakesOfTheSameSamples) {
    begin();
    startEncoding();
    run(6 * kSecond_us);
    // The encoder alone, with the same blocks as single precision has them.
    const auto alone = std::make_unique<te_state>();
    ASSERT_EQ(te_init(alone.get(), &profile_), TE_ACCEPTED);
    std::vector<te_reading> frames;
    for (const auto& block : given_) {
        const auto& c = setup_.configuration[block.stream];
        std::vector<float> values;
        for (int i = 0; i < block.count * c.columns; ++i)
            values.push_back(c.scale[0] * static_cast<float>(block.raw[i]));
        te_samples(alone.get(), static_cast<te_stream>(c.kind), static_cast<std::int64_t>(block.first_us) * 1000,
                   static_cast<std::int32_t>(block.interval_ns), values.data(), block.count);
        for (te_reading frame{}; te_frame(alone.get(), &frame) != 0;) frames.push_back(frame);
    }
    std::uint32_t readings = 0, trains = 0, silences = 0;
    for (const auto& frame : heard()) {
        FieldReader in(frame.payload);
        if (frame.type == TSB_READING) {
            ASSERT_LT(readings, frames.size());
            const auto& expected = frames[readings];
            EXPECT_EQ(in.u32(), readings++);
            EXPECT_EQ(in.u64(), static_cast<std::uint64_t>(expected.t_ns / 1000));
            const auto flags = in.u8() + in.u8() * 256;
            EXPECT_EQ(flags, expected.contact + 2 * expected.sliding + 4 * expected.sliding_assumed);
            static_cast<void>(in.u32());
            for (const float value : {expected.R, expected.P, expected.pressure_pa, expected.h, expected.v}) {
                const double said = in.f32();
                EXPECT_TRUE(std::isnan(said) ? std::isnan(value) : said == double{value}) << said << " " << value;
            }
            EXPECT_TRUE(in.whole());
        } else if (frame.type == TSB_TRAIN) {
            EXPECT_EQ(in.u32(), trains++);
            EXPECT_LE(in.u64(), now_us_ + 5000);
            EXPECT_GE(in.f32(), 0.05);
            const auto command = in.f32(), amplitude = in.f32();
            EXPECT_EQ(command, amplitude) << "without a step";
            EXPECT_GE(amplitude, double{profile_.amplitude_min_v});
            EXPECT_LE(amplitude, double{profile_.amplitude_max_v});
        } else if (frame.type == TSB_SILENT) {
            EXPECT_EQ(in.u32(), silences++);
            static_cast<void>(in.u64());
            const auto faults = in.u32();
            EXPECT_EQ(faults, silences == 1 ? TE_FAULT_STALE : 0U) << "until the sensors have spoken";
        }
    }
    EXPECT_EQ(readings, frames.size());
    EXPECT_GE(trains, 3U);
    EXPECT_EQ(silences, 2U);
    EXPECT_THAT(played_, IsEmpty()) << "the host plays";
    send(sensorboard::Command::Stop);
    heard();
    run(kSecond_us);
    EXPECT_THAT(heard(), IsEmpty());
}

TEST_F(TactileBoard, RestsAfterAStartUnlessItWasQuietFor8Seconds) {
    RecordProperty("hazard", "H1");
    setup_.rested = 0;
    const auto trainsIn = [&](std::uint64_t us) {
        run(us);
        return heard(TSB_TRAIN).size();
    };
    begin();
    startEncoding();
    EXPECT_EQ(trainsIn(7'900'000), 0U);
    EXPECT_GE(trainsIn(3 * kSecond_us), 1U);
    send(sensorboard::Command::Stop);
    send(sensorboard::Command::Start);
    EXPECT_EQ(trainsIn(7'900'000), 0U) << "of the trains before the start the encoder knows nothing any more";
    EXPECT_GE(trainsIn(3 * kSecond_us), 1U);
    send(sensorboard::Command::Stop);
    run(10 * kSecond_us);
    send(sensorboard::Command::Start);
    EXPECT_GE(trainsIn(3 * kSecond_us), 1U);
}

TEST_F(TactileBoard, PlaysAloneAndNeverOnceAHostHasSpoken) {
    RecordProperty("hazard", "H1");
    setup_.alone = 1;
    begin();
    EXPECT_EQ(cancelled_, 1) << "output is off first";
    run(5 * kSecond_us);
    EXPECT_GE(played_.size(), 3U);
    EXPECT_THAT(heard(), IsEmpty());
    const auto before = played_.size();
    sendFrame(9, TSB_HELLO);
    run(3 * kSecond_us);
    EXPECT_GT(played_.size(), before) << "what is not sound is no host";
    send(sensorboard::Command::Hello);
    EXPECT_EQ(cancelled_, 2);
    played_.clear();
    run(20 * kSecond_us);
    startEncoding();
    run(5 * kSecond_us);
    EXPECT_GE(heard(TSB_TRAIN).size(), 3U);
    send(sensorboard::Command::Stop);
    run(20 * kSecond_us);
    EXPECT_THAT(played_, IsEmpty());
}

TEST_F(TactileBoard, IsSilentOnceItIsStopped) {
    RecordProperty("hazard", "H2");
    setup_.alone = 1;
    begin();
    run(5 * kSecond_us);
    tb_stop(board_.get());
    EXPECT_EQ(cancelled_, 2);
    played_.clear();
    run(20 * kSecond_us);
    EXPECT_THAT(played_, IsEmpty());
    // By an interrupt that comes while the timer is prepared, and by a timer that cannot be.
    for (const bool plays : {true, false}) {
        plays_ = plays;
        whilePlayed_ = [&] {
            if (plays) tb_stop(board_.get());
        };
        begin();
        cancelled_ = 0;
        run(20 * kSecond_us);
        EXPECT_EQ(played_.size(), 1U);
        EXPECT_GE(cancelled_, 1);
        played_.clear();
    }
    plays_ = true;
    whilePlayed_ = {};
    begin();
    startEncoding();
    run(3 * kSecond_us);
    tb_stop(board_.get());
    heard();
    run(5 * kSecond_us);
    const auto said = heard();
    const auto silence = std::ranges::find(said, std::uint8_t{TSB_SILENT}, &Heard::type);
    ASSERT_NE(silence, said.end());
    EXPECT_EQ(silence->payload[12], TE_FAULT_STOPPED);
    EXPECT_EQ(std::ranges::count(said, std::uint8_t{TSB_TRAIN}, &Heard::type), 0);
    send(sensorboard::Command::Stop);
    run(9 * kSecond_us);
    startEncoding();
    run(3 * kSecond_us);
    EXPECT_GE(heard(TSB_TRAIN).size(), 1U) << "a host starts it again";
}

TEST_F(TactileBoard, IsSilentWhileASensorIsPulledOut) {
    RecordProperty("hazard", "H7");
    // Of 12 bits, acceleration with its zero in the middle; force reads 0 untouched.
    const std::array<tb_range, 3> range{{{-2040, 2039}, {-20, 4087}, {8, 4087}}};
    struct Pulled {
        std::uint8_t stream;
        int column;  // -1: all
        std::int32_t code;
        int noise;  // codes away from that end
    };
    for (const auto& [stream, column, code, noise] :
         {Pulled{0, -1, 2047, 4}, Pulled{0, 1, -2048, 4}, Pulled{0, 0, 32'767, 0}, Pulled{1, 0, 4095, 4},
          Pulled{2, -1, 4095, 4}, Pulled{2, 3, 0, 4}, Pulled{2, 1, 4095, 0}}) {
        SCOPED_TRACE(testing::Message() << int{stream} << " column " << column << " reads " << code);
        const auto pull = [&](tb_samples& block) {
            const int columns = setup_.configuration[stream].columns;
            for (int i = 0; block.stream == stream && i < block.count * columns; ++i) {
                if (column >= 0 && i % columns != column) continue;
                const auto away = static_cast<std::int32_t>(random_.below(static_cast<std::uint64_t>(noise) + 1));
                block.raw[i] = code > 0 ? code - away : code + away;
            }
        };
        for (const bool alone : {true, false}) {
            spoil_ = {};
            now_us_ = 0;
            std::ranges::copy(range, setup_.range);
            if (code == 32'767) setup_.range[stream] = {};
            setup_.alone = alone ? 1 : 0;
            begin();
            if (!alone) startEncoding();
            const auto trains = [&] {
                const auto said = heard();
                const auto played = std::exchange(played_, {}).size();
                if (alone) return played;
                for (const auto& one : said) {
                    if (spoil_ && one.type == TSB_DATA) EXPECT_NE(one.payload.at(0), stream);
                }
                return static_cast<std::size_t>(std::ranges::count(said, std::uint8_t{TSB_TRAIN}, &Heard::type));
            };
            run(4 * kSecond_us);
            EXPECT_GE(trains(), 1U);
            spoil_ = pull;
            // Pulled for 50 ms, 100 ms old, and a block.
            run(160'000);
            played_.clear();
            heard();
            run(5 * kSecond_us);
            EXPECT_EQ(trains(), 0U);
            EXPECT_EQ(te_fault(&board_->encoder, static_cast<std::int64_t>(now_us_) * 1000), TE_FAULT_STALE);
            if (!alone) {
                send(sensorboard::Command::GetStatus);
                EXPECT_EQ(answer().payload[1], 1U << stream);
            }
            spoil_ = {};
            run(100'000);
            run(5 * kSecond_us);
            EXPECT_GE(trains(), 1U) << "it is plugged in again";
        }
    }
}

TEST_F(TactileBoard, SendsWhatReachesAnEndForAMoment) {
    setup_.range[0] = {-2040, 2039};
    spoil_ = [&](tb_samples& block) {
        for (int i = 0; block.stream == 0 && i < 19; ++i) block.raw[i] = now_us_ % 40'000 == 0 ? block.raw[i] : 2047;
    };
    begin();
    send(sensorboard::Command::Start);
    heard();
    run(kSecond_us);
    EXPECT_EQ(board_->samples_lost, 0U);
    EXPECT_EQ(heard(TSB_DATA).size(), 300U);
}

TEST_F(TactileBoard, DoesNotEncodeSamplesThatTheProtocolCannotCarry) {
    RecordProperty("hazard", "H7");
    begin();
    startEncoding();
    run(3 * kSecond_us);
    heard();
    tb_samples wrong{};
    wrong.count = 1;
    for (const auto spoil : std::initializer_list<void (*)(tb_samples&)>{
             [](auto& s) { s.stream = 3; }, [](auto& s) { s.count = 0; }, [](auto& s) { s.count = 255; },
             [](auto& s) { s.raw[0] = 32'768; }, [](auto& s) { s.raw[1] = -32'769; }}) {
        auto block = wrong;
        spoil(block);
        inject(block);
        tb_step(board_.get());
        EXPECT_THAT(heard(TSB_DATA), IsEmpty());
    }
}

TEST_F(TactileBoard, IsNoneWithStreamsThatNoBoardHas) {
    const auto sound = setup_;
    for (const auto spoil : std::initializer_list<void (*)(tb_setup&)>{
             [](auto& s) { s.streams = 0; }, [](auto& s) { s.streams = 4; },
             [](auto& s) { s.configuration[2].kind = TSB_KIND_FORCE; },
             [](auto& s) { s.configuration[1].columns = 17; },
             [](auto& s) {
                 s.configuration[0].columns = 4;
                 std::fill_n(s.configuration[0].scale, 4, 1.0F);
             },
             [](auto& s) {
                 s.configuration[1].columns = 2;
                 std::fill_n(s.configuration[1].scale, 2, 1.0F);
             },
             [](auto& s) { s.configuration[2].columns = 1; }, [](auto& s) { s.configuration[1].scale[0] = NAN; },
             [](auto& s) {
                 s.range[1] = {1, 0};
             },
             [](auto& s) { s.configuration[0].stream = 1; }, [](auto& s) { s.configuration[0].rate_mhz = 0; }}) {
        setup_ = sound;
        spoil(setup_);
        EXPECT_EQ(tb_init(board_.get(), &setup_, &hardware_), 0);
    }
}

}  // namespace tacto::test
