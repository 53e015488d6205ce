// Recording rate compared with the possible maximum: plain inserts of equally large blobs into SQLite with the same
// pragmas, page size, index and commits. The goal: BM_SessionAgainstBareBlobs has at least 0.9 of their rate synced and
// 0.8 otherwise. Both are timed in turns in one benchmark, so that a busy machine slows both equally.
#include <algorithm>
#include <benchmark/benchmark.h>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <random>
#include <sqlite3.h>
#include <unistd.h>

#include "core/session/SessionReader.h"
#include "core/session/SessionVerify.h"
#include "core/session/SessionWriter.h"
#include "tests/perf/Verdict.h"

namespace tacto {
namespace {

constexpr std::size_t kRate = 4000;
constexpr std::size_t kAxes = 3;
constexpr std::size_t kChunkBytes = kRate * kAxes * sizeof(double);  // 96 kB: one second of a fingertip
constexpr int kChunksPerTurn = 200;

std::filesystem::path scratch(const char* name) {
    const auto path = std::filesystem::temp_directory_path() / name;
    for (const char* suffix : {"", "-wal", "-shm"}) std::filesystem::remove(path.string() + suffix);
    return path;
}

SampleBlock aSecond(double t0) {
    SampleBlock block;
    std::mt19937 random(static_cast<unsigned>(t0));
    std::normal_distribution<double> noise(0, 100);  // in steps of a converter: what packing cannot foresee
    for (std::size_t i = 0; i < kRate; ++i) {
        block.t_s.push_back(t0 + static_cast<double>(i) / kRate);
        for (std::size_t a = 0; a < kAxes; ++a) block.values.push_back(std::round(noise(random)) * 0.00478515625);
    }
    return block;
}

/// A clock set by hand, steady or virtual: a steady clock syncs every commit, a virtual one only acknowledged rows.
class StepClock final : public Clock {
public:
    explicit StepClock(bool isVirtual) : virtual_(isVirtual) {}
    [[nodiscard]] Instant now() const noexcept override { return now_; }
    [[nodiscard]] bool isVirtual() const noexcept override { return virtual_; }
    void aSecondPasses() noexcept { now_ += std::chrono::seconds(1); }

private:
    const bool virtual_;
    Instant now_{0};
};

/// Writes only blobs: the fastest that SQLite allows.
class BareBlobs {
public:
    explicit BareBlobs(bool synced) : path_(scratch("tactoscope-perf-bare.db")) {
        sqlite3_open(path_.c_str(), &database_);
        run("PRAGMA page_size=4096; PRAGMA journal_mode=WAL; CREATE TABLE chunks(seq INTEGER PRIMARY KEY, data BLOB)");
        run(synced ? "PRAGMA synchronous=FULL" : "PRAGMA synchronous=NORMAL");
        sqlite3_prepare_v2(database_, "INSERT INTO chunks(data) VALUES(?)", -1, &insert_, nullptr);
    }
    ~BareBlobs() {
        sqlite3_finalize(insert_);
        sqlite3_close(database_);
        scratch("tactoscope-perf-bare.db");
    }
    BareBlobs(const BareBlobs&) = delete;
    BareBlobs& operator=(const BareBlobs&) = delete;
    bool second(const SampleBlock& block) {
        run("BEGIN");
        sqlite3_bind_blob(insert_, 1, block.values.data(), static_cast<int>(kChunkBytes), SQLITE_STATIC);
        const bool done = sqlite3_step(insert_) == SQLITE_DONE;
        sqlite3_reset(insert_);
        run("COMMIT");
        return done;
    }

private:
    void run(const char* sql) { sqlite3_exec(database_, sql, nullptr, nullptr, nullptr); }
    std::filesystem::path path_;
    sqlite3* database_ = nullptr;
    sqlite3_stmt* insert_ = nullptr;
};

/// Writes through SessionWriter: time stamps, CRC, digest, hash chain.
class Session {
public:
    explicit Session(bool synced)
        : clock_(!synced), writer_(SessionWriter::create(scratch("tactoscope-perf.tacto"), {}, clock_).value()) {
        stream_ =
            writer_->addStream(SessionStream{"acceleration", "acceleration", "m/s2", {"x", "y", "z"}, kRate}).value();
    }
    ~Session() {
        writer_.reset();
        scratch("tactoscope-perf.tacto");
    }
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;
    bool second(const SampleBlock& block) {
        clock_.aSecondPasses();
        return writer_->append(stream_, block).has_value();
    }

private:
    StepClock clock_;
    std::unique_ptr<SessionWriter> writer_;
    int stream_ = 0;
};

template <class Target>
double timed(Target& target, const std::vector<SampleBlock>& blocks, benchmark::State& state) {
    const auto start = std::chrono::steady_clock::now();
    for (int i = 0; i < kChunksPerTurn; ++i) {
        if (!target.second(blocks[static_cast<std::size_t>(i) % blocks.size()]))
            state.SkipWithError("an insert failed");
    }
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::vector<SampleBlock> someSeconds() {
    std::vector<SampleBlock> blocks;
    for (int i = 0; i < 8; ++i) blocks.push_back(aSecond(i));
    return blocks;
}

/// Argument: 1 syncs every commit (a bench in real time), 0 does not (a virtual clock).
template <class Target>
void BM_Record(benchmark::State& state) {
    const auto blocks = someSeconds();
    double total = 0;
    for (auto _ : state) {
        Target target(state.range(0) != 0);
        const double seconds = timed(target, blocks, state);
        state.SetIterationTime(seconds);
        total += seconds;
    }
    const double bytes = static_cast<double>(state.iterations()) * kChunksPerTurn * kChunkBytes;
    state.counters["MB/s"] = bytes / total / 1e6;
}
BENCHMARK(BM_Record<BareBlobs>)
    ->Name("BM_SessionBaselineBareBlobs")
    ->ArgName("synced")
    ->Arg(1)
    ->Arg(0)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK(BM_Record<Session>)
    ->Name("BM_SessionRecord")
    ->ArgName("synced")
    ->Arg(1)
    ->Arg(0)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);

/// Syncs first, so that data left unwritten by another target does not add to this time.
template <class Target>
double timedAlone(const std::vector<SampleBlock>& blocks, benchmark::State& state) {
    sync();
    Target target(state.range(0) != 0);
    return timed(target, blocks, state);
}

void BM_SessionAgainstBareBlobs(benchmark::State& state) {
    const auto blocks = someSeconds();
    std::vector<double> ratios;
    bool bareFirst = true;
    for (auto _ : state) {
        double ours = bareFirst ? 0 : timedAlone<Session>(blocks, state);
        const double floor = timedAlone<BareBlobs>(blocks, state);
        if (bareFirst) ours = timedAlone<Session>(blocks, state);
        bareFirst = !bareFirst;
        state.SetIterationTime(floor + ours);
        ratios.push_back(floor / ours);
    }
    std::sort(ratios.begin(), ratios.end());
    const double ratio = ratios[ratios.size() / 2];
    state.counters["ratio"] = ratio;
    state.SetLabel(verdict(1 / ratio, "bare blobs", 1 / (state.range(0) != 0 ? 0.9 : 0.8)));
}
BENCHMARK(BM_SessionAgainstBareBlobs)
    ->ArgName("synced")
    ->Arg(1)
    ->Arg(0)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond)
    ->Iterations(15);

void BM_SessionAcknowledgedEvent(benchmark::State& state) {
    VirtualClock clock;
    {
        auto writer = SessionWriter::create(scratch("tactoscope-perf.tacto"), {}, clock).value();
        for (auto _ : state) {
            if (!writer->event(clock.now(), "armed", {{"load", "1 kohm"}})) state.SkipWithError("an event failed");
        }
    }
    scratch("tactoscope-perf.tacto");
}
BENCHMARK(BM_SessionAcknowledgedEvent)->Unit(benchmark::kMicrosecond)->UseRealTime();

void BM_SessionCommand(benchmark::State& state) {
    VirtualClock clock;
    {
        auto writer = SessionWriter::create(scratch("tactoscope-perf.tacto"), {}, clock).value();
        for (auto _ : state) {
            clock.advanceTo(clock.now() + std::chrono::milliseconds(10));
            if (!writer->command(clock.now(), "train", {{"amplitude_v", 12.5}, {"pulses", 1}})) {
                state.SkipWithError("a command failed");
            }
        }
    }
    scratch("tactoscope-perf.tacto");
}
BENCHMARK(BM_SessionCommand)->Unit(benchmark::kMicrosecond)->UseRealTime();

void BM_SessionVerify(benchmark::State& state) {
    const auto path = scratch("tactoscope-perf-verify.tacto");
    {
        VirtualClock clock;
        auto writer = SessionWriter::create(path, {}, clock).value();
        const int stream =
            writer->addStream(SessionStream{"acceleration", "acceleration", "m/s2", {"x", "y", "z"}, kRate}).value();
        for (int i = 0; i < kChunksPerTurn; ++i) {
            clock.advanceTo(std::chrono::seconds(i));
            if (!writer->append(stream, aSecond(i))) state.SkipWithError("append failed");
        }
    }
    for (auto _ : state) {
        if (verifySession(path)->status != SessionStatus::Intact) state.SkipWithError("not intact");
    }
    state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations()) * kChunksPerTurn *
                            static_cast<std::int64_t>(kChunkBytes));
    scratch("tactoscope-perf-verify.tacto");
}
BENCHMARK(BM_SessionVerify)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace tacto
