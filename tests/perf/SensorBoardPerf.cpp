// A sensor board's stream, 4 kHz × 3 and 9 × 200 Hz, through SensorBoard::read() every 2 ms as in a session: frames,
// CRC, losses, clock, values. Compared with only copying the bytes, and with only searching them for frames.
//
// Goal: core_percent (share of one core) below 5 for the whole of read().
#include <benchmark/benchmark.h>
#include <chrono>
#include <cstring>

#include "drivers/sensor_board/SensorBoard.h"
#include "tests/support/emulated/sensor_board/EmulatedBoard.h"

namespace tacto {
namespace {

using namespace sensorboard;

constexpr double kStream_s = 10;
constexpr Instant kPollInterval = std::chrono::milliseconds(2);
using Tape = std::vector<std::vector<std::uint8_t>>;  // the bytes for each read

/// An emulated board that answers while the streams are opened, and then a tape of the bytes it sends afterwards.
class TapeTransport final : public Transport {
public:
    explicit TapeTransport(VirtualClock& clock)
        : clock_(clock), board_(std::make_unique<CountingSignal>(), settings(), clock.now()) {}

    Result<void> write(std::span<const std::uint8_t> bytes, Seconds) override {
        board_.receive(bytes, clock_.now());
        return {};
    }
    Result<std::size_t> read(std::span<std::uint8_t> into, Seconds timeout) override {
        if (tape.empty()) {
            clock_.advanceTo(clock_.now() + std::chrono::milliseconds(timeout.count() > 0 ? 1 : 0));
            if (const auto got = board_.transmit(into, clock_.now()); got > 0) return got;
        } else if (next < tape.size() && !given) {
            given = true;
            std::memcpy(into.data(), tape[next].data(), tape[next].size());
            return tape[next].size();
        }
        return tl::unexpected<Error>(Error{ErrorCode::Timeout, {}});
    }
    std::uint64_t dropped() const noexcept override { return 0; }
    void writeUrgent(std::span<const std::uint8_t>) noexcept override {}

    void record() {
        std::vector<std::uint8_t> bytes(4096);
        Instant now = clock_.now();
        while (toSeconds(now - clock_.now()) < kStream_s) {
            now += kPollInterval;
            const auto got = board_.transmit(bytes, now);
            tape.emplace_back(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(got));
            if (got == 0) tape.back().push_back(0);  // nothing arrives between two frames
        }
    }

    Tape tape;
    std::size_t next = 0;
    bool given = false;

private:
    static EmulatedBoardSettings settings() {
        EmulatedBoardSettings made;
        made.drift_ppm = 50;
        return made;
    }
    VirtualClock& clock_;
    EmulatedBoard board_;
};

/// Adds up the time spent on the streams.
class Stopwatch {
public:
    void begin() { begin_ = std::chrono::steady_clock::now(); }
    void end() { taken_ += std::chrono::steady_clock::now() - begin_; }
    void report(benchmark::State& state, std::size_t bytes) const {
        state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(bytes));
        const double streams_s = kStream_s * static_cast<double>(state.iterations());
        state.counters["core_percent"] = 100 * std::chrono::duration<double>(taken_).count() / streams_s;
    }

private:
    std::chrono::steady_clock::time_point begin_;
    std::chrono::steady_clock::duration taken_{0};
};

void BM_SensorBoardRead(benchmark::State& state) {
    std::size_t bytes = 0;
    std::uint64_t lost = 0;
    Stopwatch watch;
    std::vector<SampleBlock> blocks(3);
    for (auto _ : state) {
        state.PauseTiming();
        VirtualClock clock;
        auto owned = std::make_unique<TapeTransport>(clock);
        auto& tape = *owned;
        auto board = SensorBoard::open(std::move(owned), {}, clock);
        if (!board) {
            state.SkipWithError(board.error().message.c_str());
            return;
        }
        tape.record();
        bytes = 0;
        for (const auto& look : tape.tape) bytes += look.size();
        state.ResumeTiming();
        watch.begin();
        for (; tape.next < tape.tape.size(); ++tape.next, tape.given = false) {
            clock.advanceTo(clock.now() + kPollInterval);
            for (auto& block : blocks) block.clear();
            benchmark::DoNotOptimize((*board)->read(blocks).has_value());
            benchmark::DoNotOptimize(blocks.data());
        }
        watch.end();
        state.PauseTiming();
        const auto counts = (*board)->report().streams[0];
        lost += counts.lostBlocks;
        if (counts.samples < 39'000) state.SkipWithError("samples are missing");
        board->reset();
        state.ResumeTiming();
    }
    watch.report(state, bytes);
    state.counters["lost"] = static_cast<double>(lost);
}
BENCHMARK(BM_SensorBoardRead)->Unit(benchmark::kMillisecond);

/// Returns ten seconds of stream, read by read.
const Tape& aTape() {
    static const Tape made = [] {
        VirtualClock clock;
        TapeTransport transport(clock);
        (void)transport.write(encodeCommand(Command::Start, 1), Seconds(0));
        transport.record();
        return transport.tape;
    }();
    return made;
}

std::size_t sizeOf(const Tape& tape) {
    std::size_t bytes = 0;
    for (const auto& look : tape) bytes += look.size();
    return bytes;
}

void BM_SensorBoardFramesOnly(benchmark::State& state) {
    const auto& tape = aTape();
    Stopwatch watch;
    for (auto _ : state) {
        watch.begin();
        FrameDecoder decoder;
        for (const auto& look : tape) {
            std::span<const std::uint8_t> bytes(look);
            while (const auto frame = decoder.take(bytes)) benchmark::DoNotOptimize(frame->payload.data());
        }
        watch.end();
    }
    watch.report(state, sizeOf(tape));
}
BENCHMARK(BM_SensorBoardFramesOnly)->Unit(benchmark::kMillisecond);

void BM_SensorBoardBaselineCopy(benchmark::State& state) {
    const auto& tape = aTape();
    std::vector<std::uint8_t> into(4096);
    Stopwatch watch;
    for (auto _ : state) {
        watch.begin();
        for (const auto& look : tape) {
            std::memcpy(into.data(), look.data(), look.size());
            benchmark::DoNotOptimize(into.data());
            benchmark::ClobberMemory();
        }
        watch.end();
    }
    watch.report(state, sizeOf(tape));
}
BENCHMARK(BM_SensorBoardBaselineCopy)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace tacto
