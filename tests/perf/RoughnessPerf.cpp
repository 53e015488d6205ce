// The roughness chain compared with its baseline: only the windowed FFTW transforms that it contains, with the same
// plan flags. Goals: at least 3000 times real time on one core, and at most 3 times the baseline's cost.
#include <benchmark/benchmark.h>
#include <cmath>
#include <fftw3.h>
#include <vector>

#include "core/base/Random.h"
#include "core/dsp/PowerSpectrum.h"
#include "core/dsp/RoughnessChain.h"

namespace {

using namespace tacto;

constexpr double kSeconds = 10;
constexpr std::size_t kWindow = 256;
constexpr std::size_t kHop = 64;
constexpr std::size_t kAxes = 3;

std::vector<StreamInfo> streams() {
    return {{StreamKind::Acceleration, StreamUnit::MetrePerSecondSquared, kAxes, 4000, "acceleration"},
            {StreamKind::Force, StreamUnit::Newton, 1, 200, "force"},
            {StreamKind::Taxels, StreamUnit::Pascal, 8, 200, "taxels"}};
}

/// Returns a second of rest, then sliding contact.
std::vector<SampleBlock> fingertip() {
    Random random(1, "roughness perf");
    std::vector<SampleBlock> blocks(3);
    for (std::size_t i = 0; i < static_cast<std::size_t>(4000 * kSeconds); ++i) {
        const double t = static_cast<double>(i) / 4000;
        blocks[0].t_s.push_back(t);
        for (std::size_t a = 0; a < kAxes; ++a) blocks[0].values.push_back((t < 1 ? 0.01 : 1.0) * random.normal());
    }
    for (std::size_t i = 0; i < static_cast<std::size_t>(200 * kSeconds); ++i) {
        const double t = static_cast<double>(i) / 200;
        blocks[1].t_s.push_back(t);
        blocks[1].values.push_back(t < 1 ? 0.0 : 1.0 + 0.1 * std::sin(t));
        blocks[2].t_s.push_back(t);
        for (int c = 0; c < 8; ++c) blocks[2].values.push_back(1000 + (t < 1 ? 0 : 500.0 * c) + random.normal());
    }
    return blocks;
}

void reportRealTime(benchmark::State& state) {
    state.counters["times_real_time"] =
        benchmark::Counter(kSeconds * static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}

void roughnessChain(benchmark::State& state) {
    const auto blocks = fingertip();
    const auto infos = streams();
    auto chain = RoughnessChain::create(infos, RoughnessSettings{});
    std::vector<RoughnessFrame> frames;
    for (auto _ : state) {
        frames.clear();
        (*chain)->reset();
        (*chain)->feed(blocks, frames);
        (*chain)->finish(frames);
        benchmark::DoNotOptimize(frames.data());
    }
    state.counters["frames"] = static_cast<double>(frames.size());
    reportRealTime(state);
}
BENCHMARK(roughnessChain)->Unit(benchmark::kMicrosecond);

/// Feeds the chain like the live bench: every 5 ms.
void roughnessChainLive(benchmark::State& state) {
    const auto whole = fingertip();
    const auto infos = streams();
    auto chain = RoughnessChain::create(infos, RoughnessSettings{});
    std::vector<std::vector<SampleBlock>> steps;
    std::vector<std::size_t> taken(infos.size());
    for (double until = 0.005; until < kSeconds; until += 0.005) {
        std::vector<SampleBlock> step(infos.size());
        for (std::size_t s = 0; s < infos.size(); ++s) {
            for (; taken[s] < whole[s].samples() && whole[s].t_s[taken[s]] < until; ++taken[s]) {
                step[s].t_s.push_back(whole[s].t_s[taken[s]]);
                const auto* row = whole[s].values.data() + taken[s] * infos[s].channels;
                step[s].values.insert(step[s].values.end(), row, row + infos[s].channels);
            }
        }
        steps.push_back(std::move(step));
    }
    std::vector<RoughnessFrame> frames;
    for (auto _ : state) {
        frames.clear();
        (*chain)->reset();
        for (const auto& step : steps) (*chain)->feed(step, frames);
        (*chain)->finish(frames);
        benchmark::DoNotOptimize(frames.data());
    }
    reportRealTime(state);
}
BENCHMARK(roughnessChainLive)->Unit(benchmark::kMicrosecond);

void bareTransforms(benchmark::State& state) {
    const auto blocks = fingertip();
    const auto window = hannWindow(kWindow);
    std::vector<std::vector<double>> axes(kAxes);
    for (std::size_t i = 0; i < blocks[0].samples(); ++i) {
        for (std::size_t a = 0; a < kAxes; ++a) axes[a].push_back(blocks[0].values[i * kAxes + a]);
    }
    auto* input = fftw_alloc_real(kAxes * kWindow);
    auto* output = fftw_alloc_complex(kAxes * (kWindow / 2 + 4));
    const int n = kWindow;
    auto* plan = fftw_plan_many_dft_r2c(1, &n, kAxes, input, nullptr, 1, kWindow, output, nullptr, 1, kWindow / 2 + 4,
                                        FFTW_ESTIMATE);
    for (auto _ : state) {
        for (std::size_t first = 0; first + kWindow <= blocks[0].samples(); first += kHop) {
            for (std::size_t a = 0; a < kAxes; ++a) {
                const double* from = axes[a].data() + first;
                for (std::size_t i = 0; i < kWindow; ++i) input[a * kWindow + i] = from[i] * window[i];
            }
            fftw_execute(plan);
            benchmark::DoNotOptimize(output);
            benchmark::ClobberMemory();
        }
    }
    fftw_destroy_plan(plan);
    fftw_free(input);
    fftw_free(output);
    reportRealTime(state);
}
BENCHMARK(bareTransforms)->Unit(benchmark::kMicrosecond);

}  // namespace
