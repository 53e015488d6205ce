#include "tests/drivers/sensor_board/BoardConformance.h"

#include <algorithm>
#include <array>
#include <map>

#include "core/base/Random.h"
#include "resources/firmware/sensor_board/tsb_board.h"
#include "tests/support/InTime.h"
#include "tests/support/Refused.h"

namespace tacto::test {

using namespace sensorboard;
using sensorboard::Command;

namespace {

bool isEncoders(const Told& told) { return told.is(Reply::Reading) || told.is(Reply::Train) || told.is(Reply::Silent); }

/// Bytes in which no board may hear a command: noise, and a START that is cut, wrong in one bit or of another version.
std::vector<std::uint8_t> junk(Random& random) {
    std::vector<std::uint8_t> bytes;
    const auto byte = [&] { return static_cast<std::uint8_t>(random.below(256)); };
    const auto kind = random.below(4);
    if (kind == 0) {
        bytes.resize(1 + random.below(400));
        std::ranges::generate(bytes, byte);
        bytes.front() = 1;  // not nothing
        return bytes;
    }
    std::array<std::uint8_t, TSB_FRAME_MOST> frame{};
    tsb_writer writer{};
    tsb_begin(&writer, frame.data(), static_cast<std::uint8_t>(kind == 1 ? 3 + random.below(250) : TSB_VERSION),
              TSB_START);
    tsb_put_u8(&writer, byte());
    const auto size = tsb_seal(&writer);
    bytes.assign(frame.begin(), frame.begin() + static_cast<std::ptrdiff_t>(size));
    if (kind == 2) bytes.resize(1 + random.below(size - 2));
    if (kind == 3) bytes[random.below(size)] ^= static_cast<std::uint8_t>(1U << random.below(8));
    return bytes;
}

/// On the computer's clock a board may lose something because the computer had no time: what its line has no room for
/// is left out.
bool mayLose(const BoardRig& rig) { return dynamic_cast<const VirtualClock*>(&rig.clock()) == nullptr; }

/// Whether numbers go up from 0 one by one.
class Numbers {
public:
    explicit Numbers(const BoardRig& rig) : mayLose_(mayLose(rig)) {}
    void take(std::uint32_t number) {
        EXPECT_GE(number, next_) << "it repeats or goes back";
        EXPECT_TRUE(mayLose_ || number == next_) << number;
        next_ = number + 1;
    }

private:
    const bool mayLose_;
    std::uint32_t next_ = 0;
};

}  // namespace

void PlainHost::write(std::span<const std::uint8_t> bytes) { accepted(rig_.line().write(bytes, Seconds(5))); }

template <class Enough>
bool PlainHost::hearUntil(Seconds most, Enough enough) {
    std::array<std::uint8_t, 4096> bytes{};
    for (const Instant end = rig_.clock().now() + toInstant(most); !enough() && rig_.clock().now() < end;) {
        const auto read = rig_.line().read(bytes, Seconds(0));
        if (!read) {
            EXPECT_EQ(read.error().code, ErrorCode::Timeout) << read.error().message;
            rig_.wait(Seconds(0.001));
            continue;
        }
        std::span<const std::uint8_t> left = std::span(bytes).first(*read);
        while (const auto frame = decoder_.take(left))
            told.push_back({frame->version, frame->type, {frame->payload.begin(), frame->payload.end()}});
    }
    return enough();
}

Told PlainHost::ask(Command command, std::vector<std::uint8_t> payload) {
    const auto token = token_ = static_cast<std::uint8_t>(token_ % 250 + 1);
    write(encodeCommand(command, token, payload));
    std::size_t seen = told.size();
    const bool answered = hearUntil(Seconds(20), [&] {
        while (seen < told.size() &&
               (told[seen].is(Reply::Data) || isEncoders(told[seen]) || told[seen].payload.at(0) != token))
            ++seen;
        return seen < told.size();
    });
    EXPECT_IN_TIME(answered) << "command " << static_cast<int>(command);
    if (!answered) return {};
    auto answer = told[seen];
    told.erase(told.begin() + static_cast<std::ptrdiff_t>(seen));
    return answer;
}

bool PlainHost::hear(Reply reply, std::size_t count) {
    return hearUntil(Seconds(20), [&] {
        return static_cast<std::size_t>(std::ranges::count_if(told, [&](const Told& one) { return one.is(reply); })) >=
               count;
    });
}

void PlainHost::listen(Seconds duration) {
    static_cast<void>(hearUntil(duration, [] { return false; }));
}

void BoardConformance::SetUp() {
    rig_ = GetParam().make();
    ASSERT_NE(rig_, nullptr);
    host_ = std::make_unique<PlainHost>(*rig_);
}

BoardStatus BoardConformance::status() { return accepted(readStatus(host_->ask(Command::GetStatus).frame())); }

void BoardConformance::order(Command command) { accepted(readDone(host_->ask(command).frame(), command)); }

void BoardConformance::expectRefused(Command command, std::vector<std::uint8_t> payload, int reason) {
    const auto refusal = accepted(readRefusal(host_->ask(command, std::move(payload)).frame()));
    EXPECT_EQ(refusal.command, static_cast<std::uint8_t>(command));
    EXPECT_EQ(refusal.reason, reason);
}

StreamConfiguration BoardConformance::configuration(std::uint8_t stream) {
    return accepted(readConfiguration(host_->ask(Command::GetConfiguration, {stream}).frame()));
}

void BoardConformance::setEncoder(bool encodes) {
    const auto mode = static_cast<std::uint8_t>(encodes ? TSB_MODE_ENCODE : TSB_MODE_OFF);
    EXPECT_EQ(accepted(readEncoder(host_->ask(Command::SetEncoder, {mode}).frame())).encodes, encodes);
    EXPECT_EQ(accepted(readEncoder(host_->ask(Command::GetEncoder).frame())).encodes, encodes);
}

TEST_P(BoardConformance, AnswersEachCommandByWhatItIs) {
    const auto identity = accepted(readIdentity(host_->ask(Command::Hello).frame()));
    EXPECT_EQ(identity.lowestVersion, 1);
    EXPECT_EQ(identity.highestVersion, 2);
    ASSERT_GE(identity.streams, 1U);
    for (std::uint8_t s = 0; s < identity.streams; ++s) {
        const auto is = configuration(s);
        EXPECT_EQ(is.stream, s);
        EXPECT_TRUE(is.enabled);
        const auto calibration = accepted(readCalibration(host_->ask(Command::GetCalibration, {s}).frame()));
        EXPECT_EQ(calibration.stream, s);
        EXPECT_EQ(calibration.uncertainty.size(), is.columns.size());
        const auto set =
            accepted(readConfiguration(host_->ask(Command::SetConfiguration, configurationPayload(is)).frame()));
        EXPECT_EQ(configurationPayload(set), configurationPayload(is));
    }
    EXPECT_FALSE(accepted(readEncoder(host_->ask(Command::GetEncoder).frame())).encodes) << "after power-up";
    setEncoder(true);
    setEncoder(false);
    order(Command::Stop);
    const auto first = status();
    host_->listen(Seconds(0.01));
    const auto second = status();
    EXPECT_FALSE(second.running);
    EXPECT_GE(second.time_us, first.time_us + 9000);
    EXPECT_EQ(second.framesRefused, first.framesRefused);
    EXPECT_TRUE(host_->told.empty()) << "it speaks when it is asked";
    EXPECT_EQ(host_->counts().bad(), 0U);
}

TEST_P(BoardConformance, RefusesWhatItDoesNotHaveAndWhatMayNotBeNow) {
    RecordProperty("hazard", "H4");
    expectRefused(static_cast<Command>(0x3F), {}, TSB_REASON_UNKNOWN_COMMAND);
    const auto streams = static_cast<std::uint8_t>(accepted(readIdentity(host_->ask(Command::Hello).frame())).streams);
    expectRefused(Command::GetConfiguration, {streams}, TSB_REASON_NO_SUCH_STREAM);
    expectRefused(Command::GetCalibration, {255}, TSB_REASON_NO_SUCH_STREAM);
    expectRefused(Command::SetEncoder, {2}, TSB_REASON_NOT_SUPPORTED);
    const auto sound = configuration(0);
    for (const auto spoil : std::initializer_list<void (*)(StreamConfiguration&)>{
             [](auto& c) { c.kind = StreamKind::Force; }, [](auto& c) { c.unit = StreamUnit::Pascal; },
             [](auto& c) { c.columns.pop_back(); }, [](auto& c) { c.rate_mhz += 1; },
             [](auto& c) { c.rate_mhz = 0; }}) {
        auto wrong = sound;
        spoil(wrong);
        expectRefused(Command::SetConfiguration, configurationPayload(wrong), TSB_REASON_NOT_SUPPORTED);
    }
    setEncoder(true);
    order(Command::Start);
    expectRefused(Command::SetConfiguration, configurationPayload(sound), TSB_REASON_RUNNING);
    expectRefused(Command::SetEncoder, {TSB_MODE_OFF}, TSB_REASON_RUNNING);
    EXPECT_TRUE(accepted(readEncoder(host_->ask(Command::GetEncoder).frame())).encodes);
    EXPECT_EQ(configurationPayload(configuration(0)), configurationPayload(sound));
    EXPECT_TRUE(status().running) << "what was refused ends nothing";
}

TEST_P(BoardConformance, NumbersItsBlocksFromZeroAtEachStart) {
    RecordProperty("hazard", "H7");
    std::uint64_t newest_us = 0;
    for (int start = 0; start < 3; ++start) {
        host_->told.clear();
        const auto started_us = accepted(readDone(host_->ask(Command::Start).frame(), Command::Start));
        // Blocks of the start before came before DONE.
        const auto before = host_->told.size();
        ASSERT_IN_TIME(host_->hear(Reply::Data, before + 60));
        std::map<int, Numbers> sequences, indexes;
        for (const auto& one : std::span(host_->told).subspan(before)) {
            if (!one.is(Reply::Data)) continue;
            const auto block = readBlock(one.frame());
            ASSERT_TRUE(block.has_value());
            sequences.try_emplace(block->stream, *rig_).first->second.take(block->sequence);
            for (std::uint32_t i = 0; i < block->count; ++i)
                indexes.try_emplace(block->stream, *rig_).first->second.take(block->index + i);
            const auto last_us = block->time_us + std::uint64_t{block->count - 1U} * block->interval_ns / 1000;
            EXPECT_GT(last_us + 10'000, started_us) << "of before the start";
            newest_us = std::max(newest_us, last_us);
        }
        EXPECT_EQ(sequences.size(), accepted(readIdentity(host_->ask(Command::Hello).frame())).streams);
        const auto now = status();
        EXPECT_TRUE(now.running);
        EXPECT_GE(now.time_us, newest_us) << "sampled ahead";
        EXPECT_TRUE(now.samplesLost == 0 || mayLose(*rig_));
    }
    EXPECT_EQ(host_->counts().bad(), 0U);
}

TEST_P(BoardConformance, SaysNothingOnceItIsStopped) {
    RecordProperty("hazard", "H2");
    setEncoder(true);
    order(Command::Start);
    ASSERT_IN_TIME(host_->hear(Reply::Data, 30));
    order(Command::Stop);
    host_->told.clear();
    EXPECT_FALSE(status().running);
    host_->listen(Seconds(1.5));  // a STATUS comes once a second
    EXPECT_TRUE(host_->told.empty());
}

TEST_P(BoardConformance, HearsNoCommandInNoiseAndInFramesThatAreCut) {
    RecordProperty("hazard", "H10");
    Random random(51, "junk");
    for (const bool running : {false, true}) {
        if (running) order(Command::Start);
        host_->told.clear();
        Numbers blocks(*rig_);
        auto before = status().framesRefused;
        for (int i = 0; i < 40; ++i) {
            host_->write(junk(random));
            const auto after = status();  // its frame begins with the zero that ends the junk
            EXPECT_EQ(after.running, running) << i;
            EXPECT_GT(after.framesRefused, before) << i;
            before = after.framesRefused;
        }
        for (const auto& one : host_->told) {
            EXPECT_TRUE(one.is(Reply::Data) || one.is(Reply::Status)) << int{one.type};
            if (const auto block = readBlock(one.frame()); one.is(Reply::Data) && block->stream == 0)
                blocks.take(block->sequence);
        }
    }
    EXPECT_EQ(host_->counts().bad(), 0U);
}

TEST_P(EncodingBoardConformance, NumbersWhatItsEncoderSaysFromZeroAtEachStart) {
    RecordProperty("hazard", "H7");
    setEncoder(true);
    for (int start = 0; start < 2; ++start) {
        host_->told.clear();
        order(Command::Start);
        const auto before = host_->told.size();
        // After trains, the encoder rests for 8 s.
        ASSERT_IN_TIME(start == 0 ? host_->hear(Reply::Train, 2) : host_->hear(Reply::Reading, before + 20));
        std::map<std::uint8_t, Numbers> numbers;
        std::uint64_t readAt_us = 0, playedAt_us = 0;
        for (const auto& one : std::span(host_->told).subspan(before)) {
            if (one.is(Reply::Reading)) {
                const auto reading = readReading(one.frame());
                ASSERT_TRUE(reading.has_value());
                numbers.try_emplace(one.type, *rig_).first->second.take(reading->sequence);
                EXPECT_GT(reading->time_us, std::exchange(readAt_us, reading->time_us));
            } else if (one.is(Reply::Train)) {
                const auto train = readTrain(one.frame());
                ASSERT_TRUE(train.has_value());
                numbers.try_emplace(one.type, *rig_).first->second.take(train->sequence);
                EXPECT_GT(train->onset_us, std::exchange(playedAt_us, train->onset_us));
            } else if (one.is(Reply::Silent)) {
                const auto silence = readSilence(one.frame());
                ASSERT_TRUE(silence.has_value());
                EXPECT_TRUE(silence->sequence > 0 || silence->faults != 0U) << "its sensors have not spoken";
                numbers.try_emplace(one.type, *rig_).first->second.take(silence->sequence);
            }
        }
        EXPECT_TRUE(numbers.size() == (start == 0 ? 3 : 2) || mayLose(*rig_));
    }
    order(Command::Stop);
    setEncoder(false);
    host_->told.clear();
    order(Command::Start);
    ASSERT_IN_TIME(host_->hear(Reply::Data, 100));
    EXPECT_EQ(std::ranges::count_if(host_->told, isEncoders), 0) << "it was told not to encode";
}

GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(BoardConformance);
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(EncodingBoardConformance);

}  // namespace tacto::test
