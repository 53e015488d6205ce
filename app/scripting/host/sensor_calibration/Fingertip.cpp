// Reads a fingertip: at rest, sliding over surfaces, and under weights.
#include <cmath>

#include "app/scripting/host/sensor_calibration/FingertipCalibration.h"
#include "core/analysis/sensor_calibration/SensorCalibrationJson.h"
#include "core/analysis/statistics/StatisticsJson.h"

namespace tacto::host::sensor_calibration {

namespace {

/// Receives the bench's samples during its lifetime.
class Listening {
public:
    explicit Listening(Bench& bench) : bench_(bench), tap_(std::make_unique<BenchTap>()) { bench_.listen(tap_.get()); }
    /// Makes sure that the finger then drives only what it was asked to drive.
    ~Listening() {
        bench_.listen(nullptr);
        static_cast<void>(bench_.drive(DriveSource::Off));
    }
    Listening(const Listening&) = delete;
    Listening& operator=(const Listening&) = delete;

    void takeInto(SensorSamples& samples) {
        while (const auto sample = tap_->samples.pop()) {
            auto& block = samples.blocks[sample->stream];
            block.t_s.push_back(sample->t_s);
            for (std::uint32_t c = 0; c < sample->channels; ++c) {
                block.values.push_back(static_cast<double>(sample->values[c]));
            }
        }
    }

    [[nodiscard]] std::uint64_t dropped() const noexcept { return tap_->samples.dropped(); }

private:
    Bench& bench_;
    std::unique_ptr<BenchTap> tap_;
};

/// Lets `duration_s` pass and returns the fingertip's samples from that time.
Result<SensorSamples> listenFor(ScriptSession& session, double duration_s) {
    constexpr double kStep_s = 0.1;  // a tap holds over half a second of samples from a 20 kHz finger
    Bench& bench = session.bench();
    SensorSamples samples;
    for (auto info : bench.devices().sensor->streams()) {
        info.channels = std::min(info.channels, TapSample::kMaxChannels);
        samples.streams.push_back(info);
    }
    samples.blocks.resize(samples.streams.size());
    samples.serial = bench.devices().sensor->identity().serial;
    if (auto driven = bench.drive(DriveSource::Sensor); !driven) return failure(driven);
    Listening listening(bench);
    const double end = toSeconds(session.now()) + duration_s;
    while (toSeconds(session.now()) < end) {
        const double left = std::max(0.005, end - toSeconds(session.now()));
        if (auto waited = bench.wait(Seconds(std::min(kStep_s, left))); !waited) return failure(waited);
        listening.takeInto(samples);
    }
    if (listening.dropped() > 0) {
        return fail(
            ErrorCode::Device,
            "{} samples of the fingertip were lost because this computer was too busy; a reading needs all of them",
            listening.dropped());
    }
    for (std::size_t s = 0; s < samples.streams.size(); ++s) {
        const auto& info = samples.streams[s];
        const double wanted = info.rate_hz * duration_s;
        const auto came = static_cast<double>(samples.blocks[s].samples());
        if (came < wanted / 2) {
            return fail(ErrorCode::Device, "{} gave {} samples in {} s; about {:.0f} are expected", info.name, came,
                        duration_s, wanted);
        }
    }
    return samples;
}

/// Returns the force in use, or nothing without a force sensor.
Result<std::optional<ForceInUse>> forceInUse(ScriptSession& session, const SensorSamples& samples) {
    auto chain = RoughnessChain::create(samples.streams, session.bench().profile().roughness, {}, samples.serial);
    if (!chain) return failure(chain);
    for (std::size_t s = 0; s < samples.streams.size(); ++s) {
        if (samples.streams[s].kind != StreamKind::Force) continue;
        const double mean = levelOf(samples, StreamKind::Force).mean;
        const double perUnit = (*chain)->inUse(s, 0, 1) - (*chain)->inUse(s, 0, 0);
        return std::optional(ForceInUse{(*chain)->inUse(s, 0, mean), (*chain)->streams()[s].unit,
                                        std::abs(perUnit) * meanUncertainty(samples, StreamKind::Force)});
    }
    return std::optional<ForceInUse>();
}

}  // namespace

Json streamsOf(ScriptSession& session) {
    Json out = Json::array();
    for (const auto& info : session.bench().devices().sensor->streams()) {
        out.push_back({{"kind", nameOf(info.kind)},
                       {"unit", symbolOf(info.unit)},
                       {"channels", info.channels},
                       {"rate_hz", info.rate_hz}});
    }
    return out;
}

Result<FingertipRest> readFingertipRest(ScriptSession& session, double duration_s) {
    Bench& bench = session.bench();
    bench.disarm();
    if (auto& surface = bench.devices().surface) {
        if (auto up = surface->present("", MillimetresPerSecond(0), Newtons(0)); !up) return failure(up);
    } else if (auto lifted = session.askTo("rest", "Lift the fingertip; nothing touches it"); !lifted) {
        return failure(lifted);
    }
    if (auto waited = bench.wait(Seconds(1)); !waited) return failure(waited);  // until the finger has left the surface
    const auto samples = listenFor(session, duration_s);
    if (!samples) return failure(samples);
    auto levels = readRest(*samples, bench.profile().roughness);
    if (!levels) return failure(levels);
    auto used = forceInUse(session, *samples);
    if (!used) return failure(used);
    return FingertipRest{std::move(*levels), levelOf(*samples, StreamKind::Force), *used, duration_s};
}

Result<SlideReading> readSliding(ScriptSession& session, const bench::Sliding& sliding, double duration_s,
                                 const SensorRest& rest) {
    Bench& bench = session.bench();
    bench.disarm();
    if (auto slid = bench::slide(session, sliding); !slid) return failure(slid);
    if (auto waited = bench.wait(Seconds(1)); !waited) return failure(waited);  // the finger lands and starts
    const auto samples = listenFor(session, duration_s);
    if (!samples) return failure(samples);
    auto reading = readSlide(*samples, bench.profile().roughness, rest);
    if (!reading) return fail(reading.error().code, "{}: {}", sliding.material, reading.error().message);
    return reading;
}

Result<WeightReading> readWeight(ScriptSession& session, double mass_g, double gravity_m_s2, double duration_s) {
    const double force = mass_g / 1000 * gravity_m_s2;
    Bench& bench = session.bench();
    bench.disarm();
    if (auto& surface = bench.devices().surface) {
        auto pressed = surface->present("glass", MillimetresPerSecond(0), Newtons(force));
        if (!pressed) return failure(pressed);
    } else {
        auto rested =
            session.askTo(fmt::format("weight-{}g", mass_g),
                          fmt::format("Rest the weight of {} g ({:.4g} N) on the fingertip and wait until it is still",
                                      mass_g, force));
        if (!rested) return failure(rested);
    }
    if (auto waited = bench.wait(Seconds(1.5)); !waited) return failure(waited);
    const auto samples = listenFor(session, duration_s);
    if (!samples) return failure(samples);
    auto used = forceInUse(session, *samples);
    if (!used) return failure(used);
    WeightReading reading{.mass_g = mass_g, .reference_n = force, .inUse = *used};
    if (const auto* info = streamOf(*samples, StreamKind::Force)) {
        reading.force = levelOf(*samples, StreamKind::Force).mean;
        reading.forceUnit = info->unit;
    }
    if (const auto* info = streamOf(*samples, StreamKind::Taxels)) {
        reading.taxelUnit = info->unit;
        for (std::size_t c = 0; c < info->channels; ++c)
            reading.taxels.push_back(levelOf(*samples, StreamKind::Taxels, c).mean);
    }
    return reading;
}

}  // namespace tacto::host::sensor_calibration
