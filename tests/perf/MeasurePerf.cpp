// Measures pulses in ten million samples on one core, compared with copying the samples and with adding them up.
//
// The goal is 100 ms, for pulses, for noise of full height, and for 200 000 pulses in one record.
#include <benchmark/benchmark.h>
#include <cmath>
#include <cstring>
#include <numeric>

#include "core/base/Random.h"
#include "core/measure/PulseMeasurement.h"

namespace tacto {
namespace {

constexpr std::size_t kSamples = 10'000'000;
constexpr double kRate_hz = 10e6;

enum Signal { kPulses, kNoise, kDense, kRecharge, kDrift, kSignals };
const char* nameOf(Signal signal) {
    constexpr const char* kNames[kSignals] = {"100 biphasic pulses", "noise of full height", "200 000 pulses",
                                              "100 pulses with a slow recharge", "100 pulses on a drift"};
    return kNames[signal];
}

double valueAt(Signal signal, std::size_t i) {
    const auto biphasic = [](std::size_t at) { return at < 2000 ? 40.0 : at > 3000 && at < 5000 ? -40.0 : 0.0; };
    switch (signal) {
        case kPulses:
            return biphasic(i % 100'000);
        case kDense:
            return i % 50 >= 10 && i % 50 < 30 ? 40 : 0;
        case kRecharge: {
            const std::size_t at = i % 100'000;
            return at < 2000 ? 40 : at > 3000 && at < 23'000 ? -4 : 0;
        }
        case kDrift:
            return biphasic(i % 100'000) + 8 * std::sin(static_cast<double>(i) * 3e-6);
        default:
            return 0;
    }
}

const Capture& captureOf(Signal signal) {
    static Capture made[kSignals];
    auto& capture = made[signal];
    if (!capture.channels.empty()) return capture;
    capture.rate_hz = kRate_hz;
    capture.channels.push_back({"voltage", "V", {}});
    auto& samples = capture.channels[0].samples;
    samples.resize(kSamples);
    Random random(3, "measurement benchmark");
    for (std::size_t i = 0; i < kSamples; ++i) {
        const double noise = signal == kNoise ? 13.0 : 0.1;
        samples[i] = static_cast<float>(valueAt(signal, i) + noise * random.normal());
    }
    return capture;
}

void countSamples(benchmark::State& state) {
    state.counters["samples/s"] =
        benchmark::Counter(static_cast<double>(state.iterations()) * kSamples, benchmark::Counter::kIsRate);
}

void BM_Measure(benchmark::State& state) {
    const auto signal = static_cast<Signal>(state.range(0));
    const auto& capture = captureOf(signal);
    std::size_t pulses = 0;
    for (auto _ : state) {
        const auto measured = measureChannel(capture, 0);
        pulses = measured.measuredPulses;
        benchmark::DoNotOptimize(pulses);
    }
    countSamples(state);
    state.counters["pulses"] = static_cast<double>(pulses);
    state.SetLabel(nameOf(signal));
}
BENCHMARK(BM_Measure)->DenseRange(0, kSignals - 1)->Unit(benchmark::kMillisecond);

/// The memory's speed: 40 MB read and written.
void BM_MeasureBaselineCopy(benchmark::State& state) {
    const auto& samples = captureOf(kPulses).channels[0].samples;
    std::vector<float> copy(kSamples);
    for (auto _ : state) {
        std::memcpy(copy.data(), samples.data(), kSamples * sizeof(float));
        benchmark::DoNotOptimize(copy.data());
        benchmark::ClobberMemory();
    }
    countSamples(state);
}
BENCHMARK(BM_MeasureBaselineCopy)->Unit(benchmark::kMillisecond);

/// The cost of one pass that does almost nothing with each sample.
void BM_MeasureBaselineSum(benchmark::State& state) {
    const auto& samples = captureOf(kPulses).channels[0].samples;
    for (auto _ : state) benchmark::DoNotOptimize(std::reduce(samples.begin(), samples.end(), 0.0F));
    countSamples(state);
}
BENCHMARK(BM_MeasureBaselineSum)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace tacto
