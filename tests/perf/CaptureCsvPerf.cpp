// Reads a long capture as CSV, compared with common table readers: pandas' C reader and pyarrow on one thread. 10
// million rows of two channels, 240 MB, from the page cache; ours and theirs in turns. All times are processor times
// (user and system), which a busy machine changes little. "over_pandas" and "over_pyarrow" say how many times faster
// ours is; over_pandas must be at least 2. Both come from pip into build/<preset>/perf-python, or are "not compared".
// The baseline stays at pandas 2.2.3, as pandas 3.1 needs only two thirds of its time.
#include <algorithm>
#include <benchmark/benchmark.h>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <optional>
#include <sys/resource.h>
#include <unistd.h>

#include "core/base/Random.h"
#include "core/formats/csv/CsvFormat.h"
#include "tests/perf/Verdict.h"

namespace tacto {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kRows = 10'000'000;
constexpr double kRate_hz = 10e6;

/// A table in a file of its own in $TMPDIR, which the destructor removes.
class LongTable {
public:
    LongTable() : path_(fs::temp_directory_path() / fmt::format("tactoscope-perf-{}.csv", getpid())) {
        std::ofstream file(path_, std::ios::binary);
        Random random(5, "perf table");
        fmt::memory_buffer text;
        fmt::format_to(std::back_inserter(text), "time_s,voltage_v,current_a\n");
        for (std::size_t i = 0; i < kRows; ++i) {
            fmt::format_to(std::back_inserter(text), "{:.7f},{:.3f},{:.4f}\n", static_cast<double>(i) / kRate_hz,
                           40 * random.uniform() - 20, 0.1 * random.uniform() - 0.05);
            if (text.size() > 1 << 20 || i + 1 == kRows) {
                file.write(text.data(), static_cast<std::streamsize>(text.size()));
                text.clear();
            }
        }
        made_ = file.flush().good();
    }
    ~LongTable() {
        std::error_code none;
        fs::remove(path_, none);
    }
    LongTable(const LongTable&) = delete;
    LongTable& operator=(const LongTable&) = delete;
    [[nodiscard]] const fs::path& path() const noexcept { return path_; }
    [[nodiscard]] bool made() const noexcept { return made_; }

private:
    fs::path path_;
    bool made_ = false;
};

/// Returns the output of a command; nothing if the command fails.
std::optional<std::string> outputOf(const std::string& command) {
    std::FILE* pipe = popen(command.c_str(), "r");
    if (pipe == nullptr) return std::nullopt;
    std::string text;
    char piece[4096];
    while (const auto got = std::fread(piece, 1, sizeof piece, pipe)) text.append(piece, got);
    return pclose(pipe) == 0 ? std::optional(text) : std::nullopt;
}

/// Returns a Python with both readers, installed once next to the build.
std::optional<std::string> pythonWithReaders() {
    std::error_code none;
    const auto folder = fs::read_symlink("/proc/self/exe", none).parent_path().parent_path() / "perf-python";
    const auto python = (folder / "bin" / "python").string();
    const auto works = [&] {
        return outputOf("'" + python +
                        "' -c 'import pandas, pyarrow.csv; assert pandas.__version__ == \"2.2.3\"' 2>/dev/null")
            .has_value();
    };
    if (!works()) {
        if (!outputOf("python3 -m venv '" + folder.string() + "' 2>&1 && '" + python +
                      "' -m pip install --quiet --timeout 10 --retries 1 pandas==2.2.3 pyarrow 2>&1") ||
            !works()) {
            return std::nullopt;
        }
    }
    return python;
}

struct Theirs {
    double pandas_s;
    double pyarrow_s;
};
std::optional<Theirs> readByPython(const std::string& python, const fs::path& path) {
    const auto text = outputOf("'" + python + R"(' -c '
import sys, time, pandas, pyarrow, pyarrow.csv
pyarrow.set_cpu_count(1)
begun = time.process_time(); table = pandas.read_csv(sys.argv[1], engine="c"); print(time.process_time() - begun)
assert len(table) == 10000000; del table
begun = time.process_time()
table = pyarrow.csv.read_csv(sys.argv[1], read_options=pyarrow.csv.ReadOptions(use_threads=False))
print(time.process_time() - begun)
assert table.num_rows == 10000000' ')" +
                               path.string() + "'");
    Theirs theirs{};
    if (!text || std::sscanf(text->c_str(), "%lf %lf", &theirs.pandas_s, &theirs.pyarrow_s) != 2) return std::nullopt;
    return theirs;
}

/// Returns the processor time used by this process, all threads.
double processorTime_s() {
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

double peakMegabytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024;
}

void BM_CsvCapture(benchmark::State& state) {
    const LongTable table;
    if (!table.made()) {
        state.SkipWithError("no room for the table");
        return;
    }
    const auto python = pythonWithReaders();
    std::vector<double> ours, pandas, pyarrow;
    double megabytes = 0;
    for (auto _ : state) {
        const double before = peakMegabytes();
        const double begun = processorTime_s();
        const auto read = readCapture(table.path());
        ours.push_back(processorTime_s() - begun);
        state.SetIterationTime(ours.back());
        if (!read || read->capture.samples() != kRows || !read->warnings.empty()) {
            state.SkipWithError("the table was not read whole");
            return;
        }
        megabytes = std::max(megabytes, peakMegabytes() - before);
        const auto theirs = python ? readByPython(*python, table.path()) : std::nullopt;
        if (theirs) {
            pandas.push_back(theirs->pandas_s);
            pyarrow.push_back(theirs->pyarrow_s);
        }
    }
    const auto middle = [](std::vector<double> times) {
        std::ranges::sort(times);
        return times[times.size() / 2];
    };
    state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(fs::file_size(table.path())));
    state.counters["peak_MB"] = megabytes;  // 80 MB of this are the samples
    if (pandas.empty()) {
        state.SetLabel("not compared: no python3 with pandas and pyarrow");
        return;
    }
    state.counters["pandas_s"] = middle(pandas);
    state.counters["pyarrow_s"] = middle(pyarrow);
    const double overPandas = middle(pandas) / middle(ours);
    state.counters["over_pandas"] = overPandas;
    state.SetLabel(verdict(1 / overPandas, "pandas", 0.5));
    state.counters["over_pyarrow"] = middle(pyarrow) / middle(ours);
}
BENCHMARK(BM_CsvCapture)->Unit(benchmark::kMillisecond)->UseManualTime()->Iterations(5);

}  // namespace
}  // namespace tacto
