// ExchangePerf.cpp - how long an export of ten minutes takes beside pandas, h5py and pyEDFlib writing the same arrays,
// and, for XDF, of which Python has no writer, beside the bare doubles.
//
// An export does more than they do: it verifies the session, looks through it, reads it and hashes what it wrote. CSV
// and HDF5 are faster all the same. EDF, BDF and XDF are not: about half the time of writing them goes into reading the
// session once more and hashing the file. There the goal is that writing, which is the whole without verifying and
// looking, stays in proportion. Judged is the processor's time, which other programs disturb least; each is taken in
// turns with its baseline.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fcntl.h>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>
#include <sys/resource.h>
#include <unistd.h>

#include "core/exchange/Export.h"
#include "core/session/SessionWriter.h"
#include "tests/perf/Verdict.h"
#include "tests/support/PythonEnvironment.h"

namespace tacto {
namespace {

namespace fs = std::filesystem;

constexpr int kSeconds = 600;
constexpr int kRounds = 5;

struct Took {
    double seconds = kNaN;
    double processor_s = kNaN;
};

double processor_s() {
    rusage used{};
    ::getrusage(RUSAGE_SELF, &used);
    const auto of = [](const timeval& time) { return double(time.tv_sec) + 1e-6 * double(time.tv_usec); };
    return of(used.ru_utime) + of(used.ru_stime);
}

Took timed(const std::function<bool()>& work) {
    ::sync();
    const auto begun = std::chrono::steady_clock::now();
    const double before_s = processor_s();
    if (!work()) return {};
    return {std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count(), processor_s() - before_s};
}

/// The median of each.
Took middleOf(std::vector<Took> all) {
    const auto middle = [&](double Took::*member) {
        std::ranges::sort(all, {}, member);
        return all[all.size() / 2].*member;
    };
    return {middle(&Took::seconds), middle(&Took::processor_s)};
}

/// Records ten minutes of a fingertip, in steps of its converter, and writes the same arrays beside.
fs::path recordSession(const fs::path& folder) {
    struct Made {
        SessionStream about;
        std::vector<std::string> channels;
        double step;
    };
    const std::vector<Made> streams = {{{"fingertip", "acceleration", "m/s2", {"x", "y", "z"}, 4000},
                                        {"acceleration_x", "acceleration_y", "acceleration_z"},
                                        0.0047884033203125},
                                       {{"taxels", "taxels", "Pa", {"c1", "c2", "c3", "c4"}, 100},
                                        {"taxels_c1", "taxels_c2", "taxels_c3", "taxels_c4"},
                                        10},
                                       {{"force", "force", "N", {"force"}, 100}, {"force"}, 0.001},
                                       {{"roughness frames", "frames", "", {"R", "P"}, 50}, {"R", "P"}, 0}};
    const auto path = folder / "session.tacto";
    VirtualClock clock;
    auto writer = SessionWriter::create(path, {}, clock).value();
    auto listed = nlohmann::json::array();
    std::vector<int> ids;
    std::vector<std::ofstream> files;
    for (const auto& stream : streams) {
        ids.push_back(writer->addStream(stream.about).value());
        files.emplace_back(folder / (stream.about.kind + ".f64"), std::ios::binary);
        listed.push_back({{"name", stream.about.kind},
                          {"columns", stream.channels},
                          {"unit", stream.about.unit},
                          {"rate_hz", stream.about.rate_hz}});
    }
    std::mt19937_64 random(1);
    std::normal_distribution<double> noise;
    for (int second = 0; second < kSeconds; ++second) {
        clock.advanceTo(std::chrono::seconds(second + 1));
        for (std::size_t s = 0; s < streams.size(); ++s) {
            SampleBlock block;
            const auto rate = static_cast<int>(streams[s].about.rate_hz);
            for (int i = 0; i < rate; ++i) {
                block.t_s.push_back(second + double(i) / rate);
                files[s].write(reinterpret_cast<const char*>(&block.t_s.back()), sizeof(double));
                for (std::size_t c = 0; c < streams[s].channels.size(); ++c) {
                    const double step = streams[s].step;
                    block.values.push_back(step > 0 ? std::round(100 * noise(random)) * step : std::abs(noise(random)));
                    files[s].write(reinterpret_cast<const char*>(&block.values.back()), sizeof(double));
                }
            }
            if (!writer->append(ids[s], block)) std::abort();
        }
    }
    if (!writer->close()) std::abort();
    std::ofstream(folder / "arrays.json") << listed.dump();
    return path;
}

Took ourExport(const fs::path& session, const ExportFormat& format, const fs::path& out) {
    const auto took = timed([&] { return exportSession(session, format, out, "perf").has_value(); });
    fs::remove_all(out);
    return took;
}

Took theirs(const std::string& python, std::string_view format, const fs::path& arrays, const fs::path& out) {
    ::sync();
    const auto script = fs::path(TACTO_OTHERS_WRITE).string();
    const auto ran = test::outputOfShell(
        fmt::format("'{}' '{}' {} '{}' '{}'", python, script, format, arrays.string(), out.string()));
    fs::remove_all(out);
    Took took;
    std::istringstream(ran.text) >> took.seconds >> took.processor_s;
    if (ran.code != 0) std::fprintf(stderr, "%s", ran.text.c_str());
    return ran.code == 0 ? took : Took{};
}

Took bareDoubles(const fs::path& arrays, const fs::path& out) {
    std::vector<std::string> all;
    for (const auto& each : fs::directory_iterator(arrays)) {
        if (each.path().extension() != ".f64") continue;
        std::ifstream in(each.path(), std::ios::binary);
        all.emplace_back(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
    }
    const auto took = timed([&] {
        const int file = ::open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
        bool written = file >= 0;
        for (const auto& bytes : all)
            written = written && ::write(file, bytes.data(), bytes.size()) == ssize_t(bytes.size());
        written = written && ::fsync(file) == 0;
        ::close(file);
        return written;
    });
    fs::remove(out);
    return took;
}

void compare(const fs::path& session, const fs::path& folder, const std::optional<std::string>& python) {
    struct Goal {
        const char* format;
        const char* baseline;
        double most;
        bool whole;
    };
    constexpr Goal kGoals[] = {{"csv", "pandas", 0.3, true},
                               {"hdf5", "h5py", 0.8, true},
                               {"edf", "pyEDFlib", 2.5, false},
                               {"bdf", "pyEDFlib", 2.5, false},
                               {"xdf", "the bare doubles", 11, false}};
    for (const auto& goal : kGoals) {
        const bool bare = goal.format == std::string_view("xdf");
        const auto* format = exportFormat(goal.format);
        std::vector<Took> opened, ours, other;
        for (int round = 0; round < kRounds; ++round) {
            opened.push_back(timed([&] { return ExportSource::open(session, nullptr, {}, "perf").has_value(); }));
            ours.push_back(ourExport(session, *format, folder / "ours"));
            if (bare)
                other.push_back(bareDoubles(folder, folder / "theirs"));
            else if (python)
                other.push_back(theirs(*python, goal.format, folder, folder / "theirs"));
        }
        const auto our = middleOf(ours);
        const double writing_s = our.processor_s - middleOf(opened).processor_s;
        std::printf("%-8s %8.2f %8.2f %8.2f", goal.format, our.seconds, our.processor_s, writing_s);
        if (other.empty()) {
            std::printf(" %8s %8s  not compared\n", "", "");
            continue;
        }
        const auto their = middleOf(other);
        std::printf(
            " %8.2f %8.2f  %s: %s\n", their.seconds, their.processor_s, goal.whole ? "the whole" : "writing",
            verdict((goal.whole ? our.processor_s : writing_s) / their.processor_s, goal.baseline, goal.most).c_str());
    }
}

int perf() {
    const auto folder = fs::temp_directory_path() / fmt::format("tactoscope-perf-{}", ::getpid());
    fs::create_directories(folder);
    const auto session = recordSession(folder);
    const auto python = test::pythonWith("perf", "pandas, h5py, pyedflib", "pandas h5py pyEDFlib==0.1.42");
    std::printf("%-8s %8s %8s %8s %8s %8s\n", "export", "s", "cpu s", "writing", "theirs", "cpu s");
    compare(session, folder, python);
    fs::remove_all(folder);
    return 0;
}

}  // namespace
}  // namespace tacto

int main() { return tacto::perf(); }
