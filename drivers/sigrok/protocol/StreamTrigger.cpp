#include "drivers/sigrok/protocol/StreamTrigger.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tacto::sigrok_driver {

void StreamTrigger::add(std::size_t channel, std::span<const float> samples, double resolution, double now_s) {
    const bool isCurrent = wiring_.current == channel;
    if (channel != wiring_.voltage && !isCurrent) return;
    auto& into = isCurrent ? current_ : voltage_;
    into.insert(into.end(), samples.begin(), samples.end());
    if (resolution > 0) resolution_ = resolution;
    // A packet can only come late, so the earliest beginning computed from any packet is the most accurate.
    const double since = static_cast<double>(dropped_ + into.size()) / plan_.settings.sampleRate.value();
    if (!beginning_s_ || now_s - since < *beginning_s_) beginning_s_ = now_s - since;
}

std::size_t StreamTrigger::ready() const noexcept {
    return wiring_.current ? std::min(voltage_.size(), current_.size()) : voltage_.size();
}

Result<Capture> StreamTrigger::cutAt(double at, bool untriggered) {
    const std::size_t samples = plan_.settings.samples;
    const double before = std::ceil(at - plan_.settings.preTrigger * static_cast<double>(samples));
    const auto first = std::max(free_, static_cast<std::size_t>(std::max(0.0, before)));
    const auto take = [&](const std::vector<float>& from) {
        const auto begin = from.begin() + static_cast<std::ptrdiff_t>(first);
        return std::vector<float>(begin, begin + static_cast<std::ptrdiff_t>(samples));
    };
    RawRecord raw;
    raw.rate_hz = plan_.settings.sampleRate.value();
    raw.end_s = *beginning_s_ + static_cast<double>(dropped_ + first + samples) / raw.rate_hz;
    // The estimate of the beginning moves earlier over time; records must still not overlap.
    raw.end_s = std::max(raw.end_s, lastEnd_s_ + static_cast<double>(samples) / raw.rate_hz);
    lastEnd_s_ = raw.end_s;
    raw.resolution = resolution_;
    raw.voltage = take(voltage_);
    if (wiring_.current) raw.current = take(current_);
    auto capture = cut(raw, plan_, wiring_, at - static_cast<double>(first));
    if (!capture) return capture;
    if (untriggered) {
        capture->untriggered = true;
        capture->trigger_s = std::numeric_limits<double>::quiet_NaN();
    }
    free_ = first + samples;
    searched_ = free_;
    return capture;
}

Result<std::optional<Capture>> StreamTrigger::next() {
    const std::size_t samples = plan_.settings.samples;
    const auto before = static_cast<std::size_t>(std::ceil(plan_.settings.preTrigger * static_cast<double>(samples)));
    const std::size_t end = ready();
    const auto& watched = plan_.settings.triggerOnCurrent ? current_ : voltage_;
    const double level = std::abs(plan_.triggerLevel_V);
    const float sign = plan_.triggerLevel_V < 0 ? -1.0F : 1.0F;
    std::optional<Capture> found;
    std::size_t i = std::max<std::size_t>({searched_, free_ + before, 1});
    for (; i + (samples - before) <= end; ++i) {
        const double last = static_cast<double>(sign * watched[i - 1]);
        const double here = static_cast<double>(sign * watched[i]);
        const bool crossed = last < level && here >= level;
        if (!crossed && !forced_) continue;
        const double at =
            crossed ? static_cast<double>(i - 1) + (level - last) / (here - last) : static_cast<double>(i);
        auto capture = cutAt(at, !crossed);
        if (!capture) return failure(capture);
        forced_ = false;
        found = std::move(*capture);
        break;
    }
    if (!found) searched_ = i;
    dropTo(std::min(free_ > before ? free_ : 0, end));
    if (searched_ > before + 1) dropTo(std::min(searched_ - before - 1, end));
    return found;
}

void StreamTrigger::dropTo(std::size_t index) {
    // Drops large pieces only, because each drop moves the samples that stay.
    if (index < std::max<std::size_t>(plan_.settings.samples, 65'536)) return;
    const auto erase = [&](std::vector<float>& from) {
        from.erase(from.begin(), from.begin() + static_cast<std::ptrdiff_t>(std::min(index, from.size())));
    };
    erase(voltage_);
    if (wiring_.current) erase(current_);
    dropped_ += index;
    free_ -= std::min(free_, index);
    searched_ -= std::min(searched_, index);
}

}  // namespace tacto::sigrok_driver
