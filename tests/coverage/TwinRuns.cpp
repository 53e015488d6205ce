#include "tests/coverage/TwinRuns.h"

#include <algorithm>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <stdexcept>

namespace tacto::test {

TwinTruth::TwinTruth(std::uint64_t seed) {
    Random random(seed, "truth of a stimulator");
    const auto within = [&random](double halfWidth) { return halfWidth * (2 * random.uniform() - 1); };
    gain = 1 + within(0.02);
    offset_v = within(0.1);
    width_s = within(300e-9);
    gap_s = within(300e-9);
    imbalance = within(0.03);
    ohms = 500 * (1 + within(0.1));
    train_hz = 1000 * (1 + within(0.1));
}

TwinRuns::TwinRuns(std::uint64_t seed, const std::string& oscilloscope)
    : truth(seed), bench_("1 kohm", seed), onsets_(seed, "onsets") {
    const auto stimulator = fmt::format(
        "sim:stimulator?flaws=none&jitter=0s&gain={}&offset={}V&widtherror={}s&gaperror={}s&imbalance={}&load={}ohm",
        truth.gain, truth.offset_v, truth.width_s, truth.gap_s, truth.imbalance, truth.ohms);
    for (const auto& address : {stimulator, "sim:oscilloscope?flaws=drawn&" + oscilloscope}) {
        if (const auto opened = bench_.tryOpen(address); !opened) throw std::runtime_error(opened.error().message);
    }
}

Capture TwinRuns::captured(const PulseTrain& train, double range_v) {
    return captured(std::vector{train}, range_v, {}).front();
}

std::vector<Capture> TwinRuns::captured(const std::vector<PulseTrain>& trains, double range_v,
                                        const std::vector<double>& intervals_s) {
    constexpr double kRate_hz = 2e6;
    constexpr Seconds kDelivered{0.06};
    ScopeSettings settings;
    settings.sampleRate = Hertz(kRate_hz);
    settings.voltageRange = Volts(range_v);
    settings.currentRange = Milliamps(1e3 * range_v / truth.ohms);
    settings.triggerLevel = 0.2 * siValue(trains.front().amplitude);
    settings.preTrigger = 0.2;
    settings.samples = static_cast<std::size_t>(1.6 * (trains.front().duration().count() + 200e-6) * kRate_hz);
    bench_.arm(settings);
    bench_.wait(Seconds(1e-3 + 1e-5 * onsets_.uniform()));
    std::vector<Capture> out;
    for (std::size_t k = 0; k < trains.size(); ++k) {
        if (k > 0) bench_.wait(Seconds(intervals_s[k - 1]) - kDelivered);
        bench_.deliver(trains[k], kDelivered);
        out.push_back(bench_.capture());
    }
    return out;
}

PulseTrain twinTrain(double volts, double width_us, double gap_us, int pulses, double rate_hz) {
    PulseTrain train = voltagePulse(volts, gap_us);
    train.phaseWidth = Micros(width_us);
    train.pulses = pulses;
    train.rate = Hertz(rate_hz);
    return train;
}

}  // namespace tacto::test
