// Opening a .sr file of 45 million samples, compared with unpacking: libzip reads the same entries into one buffer and
// checks them, in turns with ours in one benchmark. Goals: "times_unzip" at most 2; "memory_of_samples", the peak
// memory during opening divided by the size of the samples, at most 1.25.
#include <benchmark/benchmark.h>
#include <chrono>
#include <cstring>
#include <fstream>
#include <zip.h>

#include "drivers/sigrok/session_file/SigrokFormat.h"
#include "tests/drivers/sigrok/ZipWriter.h"

namespace tacto {
namespace {

constexpr std::size_t kSamples = 45'000'000;

/// Pulses in 8-bit noise, in pieces of 4 MB as PulseView saves an oscilloscope's record; the file is written once.
const std::filesystem::path& largeFile() {
    static const auto path = [] {
        constexpr std::size_t kPiece = 1 << 20;
        std::vector<std::pair<std::string, std::string>> entries{
            {"version", "2"},
            {"metadata", "[global]\n\n[device 1]\nsamplerate=50 MHz\ntotal analog=1\nanalog1=voltage\nunitsize=1\n"}};
        std::vector<float> samples;
        std::uint64_t state = 1;
        for (std::size_t i = 0; i < kSamples; ++i) {
            state = state * 6364136223846793005U + 1442695040888963407U;
            const int noise = static_cast<int>(state >> 62U) - 1;
            const int level = i % 500'000 < 10'000 ? 50 : 0;
            samples.push_back(0.2F * static_cast<float>(level + noise));
            if (samples.size() < kPiece && i + 1 < kSamples) continue;
            std::string bytes(samples.size() * sizeof(float), '\0');
            std::memcpy(bytes.data(), samples.data(), bytes.size());
            entries.emplace_back(fmt::format("analog-1-1-{}", entries.size() - 1), std::move(bytes));
            samples.clear();
        }
        auto made = std::filesystem::temp_directory_path() / "tactoscope-perf-45M.sr";
        // zlib level 3: libzip's default takes five minutes for this, and unpacks no faster.
        std::ofstream(made, std::ios::binary) << test::zipOf(entries, 3);
        return made;
    }();
    return path;
}

double unzipSeconds(const std::filesystem::path& path) {
    const auto begin = std::chrono::steady_clock::now();
    const std::unique_ptr<zip_t, decltype(&::zip_discard)> archive(::zip_open(path.c_str(), ZIP_RDONLY, nullptr),
                                                                   &::zip_discard);
    if (!archive) throw std::runtime_error("the baseline cannot open the file");
    std::vector<char> out(4 << 20);
    for (zip_int64_t i = 0; i < ::zip_get_num_entries(archive.get(), 0); ++i) {
        const std::unique_ptr<zip_file_t, decltype(&::zip_fclose)> entry(
            ::zip_fopen_index(archive.get(), static_cast<zip_uint64_t>(i), 0), &::zip_fclose);
        zip_int64_t got = entry ? 1 : -1;
        while (got > 0) got = ::zip_fread(entry.get(), out.data(), out.size());
        if (got < 0) throw std::runtime_error("the baseline cannot unpack an entry");
    }
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// Returns a line of /proc/self/status in bytes.
double statusBytes(const std::string& key) {
    std::ifstream status("/proc/self/status");
    std::string word;
    while (status >> word) {
        if (word == key + ":") {
            double kilobytes = 0;
            status >> kilobytes;
            return kilobytes * 1024;
        }
    }
    return 0;
}

void BM_OpenSrAgainstUnzip(benchmark::State& state) {
    const auto& path = largeFile();
    double ours = 0, theirs = 0, memory = 0;
    for ([[maybe_unused]] auto _ : state) {
        theirs += unzipSeconds(path);
        std::ofstream("/proc/self/clear_refs") << "5";  // resets the peak
        const double before = statusBytes("VmRSS");
        const auto begin = std::chrono::steady_clock::now();
        const auto reading = SigrokFormat().read(path, {}, {});
        const double took = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        if (!reading) return state.SkipWithError(reading.error().message.c_str());
        if (reading->capture.samples() != kSamples) return state.SkipWithError("not all samples came");
        memory = std::max(memory, (statusBytes("VmHWM") - before) / (kSamples * sizeof(float)));
        ours += took;
        state.SetIterationTime(took);
    }
    state.counters["unzip_s"] = theirs / static_cast<double>(state.iterations());
    state.counters["times_unzip"] = ours / theirs;
    state.counters["memory_of_samples"] = memory;
}
BENCHMARK(BM_OpenSrAgainstUnzip)->UseManualTime()->Iterations(3)->Unit(benchmark::kSecond);

}  // namespace
}  // namespace tacto
