#include "drivers/sigrok/protocol/RawRecord.h"

#include <algorithm>
#include <cmath>

namespace tacto::sigrok_driver {

namespace {

/// Averages each `times` samples of one channel, from sample `first` on.
void average(const std::vector<float>& raw, std::size_t first, std::size_t times, double scale,
             std::vector<float>& into) {
    for (std::size_t j = 0; j < into.size(); ++j) {
        double sum = 0;
        for (std::size_t k = 0; k < times; ++k) sum += static_cast<double>(raw[first + j * times + k]);
        into[j] = static_cast<float>(scale * sum / static_cast<double>(times));
    }
}

CaptureChannel channelOf(const char* name, const char* unit, const std::vector<float>& raw,
                         const std::optional<Fraction>& scale, double resolution, double factor) {
    CaptureChannel channel;
    channel.name = name;
    channel.unit = unit;
    if (scale) {
        // Converters reach a little beyond the ten divisions around the middle; values near their ends are unreliable.
        channel.high = 5 * scale->value() * factor;
        channel.low = -channel.high;
    }
    double step = stepOf(raw);
    if (step == 0) step = scale ? scale->value() * 10 / 256 : resolution;
    channel.lsb = step * factor;
    return channel;
}

}  // namespace

std::optional<double> crossing(const std::vector<float>& samples, double level, double near) {
    std::optional<double> best;
    const double sign = level < 0 ? -1 : 1;
    for (std::size_t i = 1; i < samples.size(); ++i) {
        const double before = sign * static_cast<double>(samples[i - 1]);
        const double after = sign * static_cast<double>(samples[i]);
        if (!(before < sign * level) || !(after >= sign * level)) continue;
        const double at = static_cast<double>(i - 1) + (sign * level - before) / (after - before);
        if (!best || std::abs(at - near) < std::abs(*best - near)) best = at;
    }
    return best;
}

double stepOf(const std::vector<float>& samples) {
    constexpr std::size_t kLooked = 20'000;
    std::vector<float> values(samples.begin(),
                              samples.begin() + static_cast<std::ptrdiff_t>(std::min(samples.size(), kLooked)));
    std::ranges::sort(values);
    const auto twice = std::ranges::unique(values);
    values.erase(twice.begin(), twice.end());
    if (values.size() < 4 || values.size() > 4096) return 0;
    double step = static_cast<double>(values[1]) - static_cast<double>(values[0]);
    for (std::size_t i = 2; i < values.size(); ++i) {
        step = std::min(step, static_cast<double>(values[i]) - static_cast<double>(values[i - 1]));
    }
    const double span = static_cast<double>(values.back()) - static_cast<double>(values.front());
    if (!(step > 1e-5 * span)) return 0;  // neighbours that differ by rounding only
    for (const float value : values) {
        const double steps = (static_cast<double>(value) - static_cast<double>(values.front())) / step;
        if (std::abs(steps - std::round(steps)) > 0.1) return 0;
    }
    return step;
}

Result<Capture> cut(const RawRecord& raw, const RecordPlan& plan, const Wiring& wiring, double trigger) {
    const auto& wanted = plan.settings;
    const double ratio = raw.rate_hz / wanted.sampleRate.value();
    const double whole = std::round(ratio);
    if (!(whole >= 1) || std::abs(ratio - whole) > 1e-6 * ratio) {
        return fail(ErrorCode::Device, "the instrument sampled at {} Hz; a multiple of {} Hz was expected", raw.rate_hz,
                    wanted.sampleRate.value());
    }
    const auto times = static_cast<std::size_t>(whole);
    const std::size_t needed = wanted.samples * times;
    if (raw.voltage.size() < needed || (wiring.current && raw.current.size() != raw.voltage.size())) {
        return fail(ErrorCode::Device, "the instrument gave {} and {} samples; {} of each channel were expected",
                    raw.voltage.size(), raw.current.size(), needed);
    }
    const double before = wanted.preTrigger * static_cast<double>(needed);
    const double latest = static_cast<double>(raw.voltage.size() - needed);
    const double firstAt = std::clamp(std::ceil(trigger - before), 0.0, latest);
    const auto first = static_cast<std::size_t>(firstAt);

    Capture capture;
    capture.rate_hz = wanted.sampleRate.value();
    const double rawStart_s = raw.end_s - static_cast<double>(raw.voltage.size()) / raw.rate_hz;
    capture.start_s = rawStart_s + (firstAt + 0.5 * (whole - 1)) / raw.rate_hz;
    capture.trigger_s = rawStart_s + trigger / raw.rate_hz;
    auto& volts =
        capture.channels.emplace_back(channelOf("voltage", "V", raw.voltage, plan.voltageScale, raw.resolution, 1));
    volts.samples.resize(wanted.samples);
    average(raw.voltage, first, times, 1, volts.samples);
    if (wiring.current) {
        const double perVolt = 1 / wiring.shunt.value();
        auto& amps = capture.channels.emplace_back(
            channelOf("current", "A", raw.current, plan.currentScale, raw.resolution, perVolt));
        amps.samples.resize(wanted.samples);
        average(raw.current, first, times, perVolt, amps.samples);
    }
    return capture;
}

}  // namespace tacto::sigrok_driver
