// Any bytes from a sensor board, or to a board, are read as frames or skipped; they never cause a crash, a hang or
// growing memory, or the loss of a valid frame after them (hazard H10); no sample has a time stamp in the future
// (hazard H7). The first byte chooses what the other bytes are.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "drivers/sensor_board/EncoderProfile.h"
#include "drivers/sensor_board/SensorBoard.h"
#include "tests/fuzz/FuzzTarget.h"
#include "tests/support/emulated/sensor_board/EmulatedBoardLine.h"

namespace tacto::fuzz::SensorBoardFuzz {

namespace {

using namespace tacto;
using namespace tacto::sensorboard;

/// Puts any bytes in a frame with a correct CRC.
std::vector<std::uint8_t> sealed(std::span<const std::uint8_t> content) {
    std::vector<std::uint8_t> frame(TSB_FRAME_MOST);
    tsb_writer writer{};
    tsb_begin(&writer, frame.data(), content[0], content[1]);
    for (const auto byte : content.subspan(2)) tsb_put_u8(&writer, byte);
    frame.resize(tsb_seal(&writer));
    return frame;
}

/// Checks that values are within their ranges, and that writing them again gives the same bytes.
void parse(const Frame& frame) {
    if (const auto identity = readIdentity(frame)) {
        require(identity->streams >= 1 && identity->streams <= kMaxStreams && identity->name.size() <= 24);
    }
    if (const auto configuration = readConfiguration(frame)) {
        require(!configuration->columns.empty() && configuration->columns.size() <= kMaxColumns);
        require(configuration->rate_hz() >= 1 && configuration->rate_hz() <= 1e6);
        for (const auto& column : configuration->columns) require(std::isfinite(column.scale * 1e3 + column.offset));
        auto payload = configurationPayload(*configuration);
        require(std::ranges::equal(payload, frame.payload.subspan(1)));
    }
    static_cast<void>(readCalibration(frame));
    static_cast<void>(readStatus(frame));
    static_cast<void>(readRefusal(frame));
    static_cast<void>(readDone(frame, sensorboard::Command::Start));
    static_cast<void>(readEncoder(frame));
    if (const auto reading = readReading(frame)) require(!(reading->R < 0 || reading->R > 1 || reading->P > 1));
    if (const auto silence = readSilence(frame))
        require(silenceWords(silence->faults, silence->refusal).empty() ==
                (silence->faults == 0 && silence->refusal == 0));
    if (const auto train = readTrain(frame)) {
        require(train->amplitude > 0 && std::isfinite(train->amplitude) && train->interval_s > 0);
        require(train->shape <= 2 && train->pulses > 0 && std::isfinite(train->width_us + train->rate_hz));
    }
}

/// One stream and its clock; takes blocks as they arrive.
class Stream {
public:
    Stream() : track_(configuration()) {}
    void take(const Frame& frame, Instant now) {
        const auto block = readBlock(frame);
        if (!block || track_.take(*block) != StreamTrack::Verdict::Next) return;
        const auto end = StreamTrack::endOf(*block);
        if (clock_.started() && clock_.early_s(end, now) > SensorBoard::kMaxJump_s) return;
        clock_.observe(end, now);
        const auto before = samples_.samples();
        track_.append(
            *block, [this](double us) { return clock_.toSession(us); }, samples_);
        require(samples_.samples() == before + block->count);
        require(samples_.values.size() == samples_.samples() * track_.configuration().columns.size());
        require(std::isfinite(samples_.t_s.back()) && samples_.t_s.back() <= toSeconds(now) + 1e-3);
    }

private:
    static StreamConfiguration configuration() {
        return {0, true, StreamKind::Taxels, StreamUnit::Count, SampleFormat::Int16, 4'000'000, {{1, 0}, {1, 0}}};
    }
    StreamTrack track_;
    ClockFit clock_;
    SampleBlock samples_;
};

/// Decodes any bytes, followed by a valid frame.
void decode(std::span<const std::uint8_t> input) {
    FrameDecoder decoder;
    auto rest = input;
    while (const auto frame = decoder.take(rest)) parse(*frame);
    require(rest.empty() && decoder.counts().bytes == input.size());
    const auto command = encodeCommand(sensorboard::Command::GetStatus, 9);
    std::span<const std::uint8_t> good(command);
    // The frame's leading zero may also complete a valid frame at the end of the input.
    int found = 0;
    std::uint8_t token = 0;
    while (const auto frame = decoder.take(good)) {
        ++found;
        token = tokenOf(*frame);
    }
    require((found == 1 || found == 2) && token == 9);

    tsb_receiver receiver{};
    tsb_command heard{};
    for (const auto byte : input) static_cast<void>(tsb_receive(&receiver, byte, &heard));
    found = 0;
    for (const auto byte : command) found += tsb_receive(&receiver, byte, &heard);
    require(found >= 1 && heard.type == TSB_GET_STATUS && heard.token == 9);
}

/// Passes on valid frames with any content: a length, then that many bytes, with time in between.
template <class Take>
void frames(std::span<const std::uint8_t> input, Take&& take) {
    while (input.size() >= 3) {
        const auto length = std::min<std::size_t>({input[0] + std::size_t{2}, input.size() - 1, kMaxContent - 4});
        if (length < 2) return;
        take(sealed(input.subspan(1, length)));
        input = input.subspan(1 + length);
    }
}

void read(std::span<const std::uint8_t> input) {
    Stream stream;
    Instant now = std::chrono::seconds(1);
    FrameDecoder decoder;
    frames(input, [&](const std::vector<std::uint8_t>& bytes) {
        std::span<const std::uint8_t> given(bytes);
        const auto frame = decoder.take(given);
        require(frame.has_value() && given.empty());
        parse(*frame);
        stream.take(*frame, now);
        now += std::chrono::milliseconds(8);
    });
}

/// A tenth of the real rate with blocks of the same duration: the board's own samples only cost time in this test.
EmulatedBoardSettings slowBoard() {
    EmulatedBoardSettings settings;
    settings.tickRate_hz = settings.rate_hz = 400;
    settings.slowRate_hz = 100;
    settings.blockSamples = 4;
    settings.slowBlockSamples = 1;
    settings.highestVersion = 2;
    settings.encoder = tsb_encoder{0, 0, TE_LAYOUT, 1};
    return settings;
}

/// An emulated board that answers correctly until the streams run, and then sends the input.
class TurningTransport final : public Transport {
public:
    explicit TurningTransport(std::unique_ptr<Transport> board) : board_(std::move(board)) {}
    Result<void> write(std::span<const std::uint8_t> bytes, Seconds timeout) override {
        return board_->write(bytes, timeout);
    }
    Result<std::size_t> read(std::span<std::uint8_t> into, Seconds timeout) override {
        if (input.empty()) return board_->read(into, timeout);
        const auto part = std::min({input.size(), into.size(), std::size_t{37}});
        std::copy_n(input.begin(), part, into.begin());
        input.erase(input.begin(), input.begin() + static_cast<std::ptrdiff_t>(part));
        return part;
    }
    std::uint64_t dropped() const noexcept override { return 0; }
    void writeUrgent(std::span<const std::uint8_t> bytes) noexcept override { board_->writeUrgent(bytes); }

    std::vector<std::uint8_t> input;

private:
    const std::unique_ptr<Transport> board_;
};

void whole(std::span<const std::uint8_t> input, bool fromTheStart) {
    VirtualClock clock;
    const auto line =
        std::make_shared<EmulatedBoardLine>(clock, &clock, slowBoard(), std::make_unique<CountingSignal>());
    auto transport = std::make_unique<TurningTransport>(*line->connect());
    auto& turning = *transport;
    if (fromTheStart) turning.input.assign(input.begin(), input.end());
    const auto board = SensorBoard::open(std::move(transport), {.encodes = Encodes::Drives}, clock);
    require(board.has_value() || fromTheStart);
    if (!board) return;
    frames(input, [&](const std::vector<std::uint8_t>& bytes) {
        turning.input.insert(turning.input.end(), bytes.begin(), bytes.end());
    });
    std::vector<SampleBlock> blocks((*board)->streams().size());
    for (int i = 0; i < 16; ++i) {
        clock.advanceTo(clock.now() + std::chrono::milliseconds(10));
        const auto got = (*board)->read(blocks);
        for (const auto& block : blocks) {
            if (block.samples() > 0) require(block.t_s.back() <= toSeconds(clock.now()) + 1e-6);
        }
        for (const auto& train : (*board)->encoded().trains)
            require(std::abs(train.onset_s - toSeconds(clock.now())) <= SensorBoard::kEncodedWithin_s + 1e-6);
        if (!got) return;
    }
}

/// Sends commands with any content to the firmware, which answers each command with whole frames.
void request(std::span<const std::uint8_t> input) {
    EmulatedBoard board(std::make_unique<CountingSignal>(), slowBoard(), Instant(0));
    Instant now{0};
    FrameDecoder decoder;
    std::vector<std::uint8_t> answers(8192);
    frames(input, [&](const std::vector<std::uint8_t>& bytes) {
        board.receive(bytes, now);
        now += std::chrono::milliseconds(5);
        std::span<const std::uint8_t> got(answers.data(), board.transmit(answers, now));
        while (const auto frame = decoder.take(got)) parse(*frame);
        require(decoder.counts().bad() == 0);
    });
}

}  // namespace

TACTO_FUZZ(SensorBoardFuzz, const std::uint8_t* data, std::size_t size) {
    if (size == 0 || size > 4096) return 0;
    const std::span<const std::uint8_t> input(data + 1, size - 1);
    switch (data[0] % 8) {
        case 0:
        case 1:
        case 2:
            decode(input);
            break;
        case 3:
        case 4:
            read(input);
            break;
        case 5:
            request(input);
            break;
        default:
            whole(input, data[0] % 8 == 6);
            break;
    }
    return 0;
}

}  // namespace tacto::fuzz::SensorBoardFuzz
