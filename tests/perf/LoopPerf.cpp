// LoopPerf.cpp - measures one turn of the control loop (read, R, encode, gate, write to a null device), compared with
// its baseline, the roughness chain alone on the same samples.
#include <algorithm>
#include <benchmark/benchmark.h>
#include <chrono>

#include "tests/bench/LoopRig.h"

namespace tacto {
namespace {

void reportMedian(benchmark::State& state, std::vector<double>& seconds) {
    if (seconds.empty()) return;
    std::ranges::sort(seconds);
    state.counters["median_us"] = 1e6 * seconds[seconds.size() / 2];
    state.counters["p99_us"] = 1e6 * seconds[seconds.size() * 99 / 100];
}

template <class Turn>
void measure(benchmark::State& state, test::LoopRig& rig, Turn turn) {
    std::vector<double> seconds;
    seconds.reserve(1'000'000);
    for (auto _ : state) {
        rig.nextSamples();
        const auto begun = std::chrono::steady_clock::now();
        turn();
        const double took = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
        state.SetIterationTime(took);
        if (seconds.size() < seconds.capacity()) seconds.push_back(took);
    }
    reportMedian(state, seconds);
}

void chainAlone(benchmark::State& state) {
    test::LoopRig rig;
    auto input = FingerInput::create(*rig.sensor, rig.profile.roughness).value();
    measure(state, rig, [&] { input->update(); });
}
BENCHMARK(chainAlone)->Name("loop/baseline: roughness chain alone")->UseManualTime()->Unit(benchmark::kMicrosecond);

void loopStep(benchmark::State& state) {
    test::LoopRig rig;
    measure(state, rig, [&] {
        rig.loop.step(rig.clock.now());
        rig.serveStimulator();
    });
    state.counters["trains"] = static_cast<double>(rig.loop.telemetry().trainsDelivered);
}
BENCHMARK(loopStep)->Name("loop/one step, null stimulator")->UseManualTime()->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace tacto
