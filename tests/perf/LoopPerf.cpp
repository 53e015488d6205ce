// LoopPerf.cpp - one turn of the control loop (read, R, encode, gate, write to a null device) beside its baseline,
// the roughness chain alone on the same samples.
#include <algorithm>
#include <benchmark/benchmark.h>
#include <chrono>

#include "core/bench/ControlLoop.h"
#include "core/bench/Profile.h"
#include "tests/bench/FakeStimulator.h"
#include "tests/bench/TapedFinger.h"

namespace tacto {
namespace {

void reportMedian(benchmark::State& state, std::vector<double>& seconds) {
    if (seconds.empty()) return;
    std::ranges::sort(seconds);
    state.counters["median_us"] = 1e6 * seconds[seconds.size() / 2];
    state.counters["p99_us"] = 1e6 * seconds[seconds.size() * 99 / 100];
}

template <class Turn>
void measure(benchmark::State& state, VirtualClock& clock, SensorSession& sensor, Turn turn) {
    std::vector<double> seconds;
    seconds.reserve(1'000'000);
    for (auto _ : state) {
        clock.advanceTo(clock.now() + ControlLoop::kPeriod);
        sensor.serve(clock.now());
        const auto begun = std::chrono::steady_clock::now();
        turn();
        const double took = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
        state.SetIterationTime(took);
        if (seconds.size() < seconds.capacity()) seconds.push_back(took);
    }
    reportMedian(state, seconds);
}

void chainAlone(benchmark::State& state) {
    VirtualClock clock;
    test::TapedFinger finger(clock);
    auto sensor = SensorSession::create(finger).value();
    auto input = FingerInput::create(*sensor, RoughnessSettings{}).value();
    measure(state, clock, *sensor, [&] { input->update(); });
}
BENCHMARK(chainAlone)->Name("loop/baseline: roughness chain alone")->UseManualTime()->Unit(benchmark::kMicrosecond);

void loopStep(benchmark::State& state) {
    VirtualClock clock;
    SafetyGate gate(clock);
    Interlock interlock;
    Heartbeat heartbeat;
    test::FakeStimulator device(clock);
    StimulatorSession stimulator(device, gate, heartbeat, clock, {});
    test::TapedFinger finger(clock);
    auto sensor = SensorSession::create(finger).value();
    const Profile profile;
    ControlLoop loop({clock, gate, interlock, heartbeat, OutputMode::BenchLoad, &stimulator, nullptr, 0, {}},
                     FingerInput::create(*sensor, profile.roughness).value(),
                     std::make_unique<TrainPlanner>(profile.encoding, device.traits(), gate));
    test::armFake(loop, interlock, device, clock);
    loop.drive({DriveSource::Sensor, 0, 0});
    measure(state, clock, *sensor, [&] {
        loop.step(clock.now());
        stimulator.serve(clock.now());
    });
    state.counters["trains"] = static_cast<double>(loop.telemetry().trainsDelivered);
}
BENCHMARK(loopStep)->Name("loop/one step, null stimulator")->UseManualTime()->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace tacto
