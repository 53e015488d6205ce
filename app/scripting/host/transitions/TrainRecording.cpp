#include "app/scripting/host/transitions/TrainRecording.h"

#include <cmath>

#include "app/scripting/host/bench/BenchCalls.h"
#include "app/scripting/host/measure/Readings.h"
#include "core/bench/sensing/ScopeSession.h"

namespace tacto::host::transitions {

ScopeSettings trainSettings(Bench& bench, double rate_hz, const Command& a, const Command& b) {
    const double most_v = std::max(a.amplitude, b.amplitude).value();
    ScopeSettings settings = bench::trainRecord(bench, Hertz(rate_hz));
    settings.triggerLevel = std::max(0.05, 0.4 * std::min(a.amplitude, b.amplitude).value());
    settings.voltageRange = Volts(std::max(1.0, 1.3 * most_v));
    settings.currentRange = Milliamps(std::max(1.0, 2e3 * most_v / bench::presentLoad(bench.telemetry()).value()));
    return settings;
}

/// Requests as many records as are allowed at once.
Result<void> TrainRecording::begin() {
    left_ = ScopeSession::kMaxCaptures;
    return bench_.requestCaptures(static_cast<int>(left_), settings_);
}

Result<void> TrainRecording::take() {
    auto captures = bench_.takeCaptures();
    if (!captures) return failure(captures);
    left_ -= std::min(left_, captures->size());
    const MeasureOptions options = measure::optionsFor(bench_.profile().encoding.train);
    for (auto& capture : *captures) {
        const double sampling_s = 1 / (capture.rate_hz * std::sqrt(12.0));  // an edge lies anywhere within a sample
        SeenTrain train{
            capture.trigger_s, std::hypot(measure::stampUncertainty_s(capture), sampling_s), kNaN, kNaN, {}};
        auto voltage = measureTrains(std::span(&capture, 1), "voltage", options);
        if (!voltage) return failure(voltage);
        if (!voltage->trains.empty()) {
            const auto& first = voltage->trains.front();
            if (std::isfinite(first.onset_s)) train.onset_s = first.onset_s;
            train.amplitude_v = first.amplitude;
            train.amplitudeUncertainty_v = measure::ofLevelAlone(*voltage, *channelOf(capture, "voltage"));
        }
        train.capture = std::move(capture);
        seen_.push_back(std::move(train));
    }
    if (left_ > 0) return {};
    return begin();  // limits may stretch a change over more trains than one request allows
}

Result<void> settleAt(Bench& bench, const Command& wanted, std::string_view function) {
    constexpr double kLongest_s = 3600;
    const auto arrived = [&] {
        const Telemetry now = bench.telemetry();
        return std::abs(now.amplitude_v - wanted.amplitude.value()) <= 1e-9 &&
               std::abs(now.interval_s - wanted.interval.count()) <= 1e-9;
    };
    std::uint64_t deliveredBefore = bench.telemetry().trainsDelivered;
    for (double passed = 0; passed < kLongest_s; passed += TrainRecording::kPollInterval.count()) {
        if (auto waited = bench.wait(TrainRecording::kPollInterval); !waited) return waited;
        if (!arrived()) deliveredBefore = bench.telemetry().trainsDelivered;
        if (bench.telemetry().trainsDelivered > deliveredBefore) return {};
    }
    return fail(ErrorCode::Timeout, "{}: {:.3g} V every {:.3g} s was not reached within {} s", function,
                wanted.amplitude.value(), wanted.interval.count(), kLongest_s);
}

}  // namespace tacto::host::transitions
