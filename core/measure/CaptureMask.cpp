#include "core/measure/CaptureMask.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>

#include "core/base/QuantityText.h"
#include "core/measure/Clipping.h"

namespace tacto {

namespace {

constexpr float kNoBand = std::numeric_limits<float>::quiet_NaN();

/// Computes the extreme of the samples up to `reach` before and after each sample. Missing samples are ignored.
template <class Before>
std::vector<float> widened(const std::vector<float>& samples, std::size_t reach, Before wins) {
    std::vector<float> result(samples.size(), kNoBand);
    std::deque<std::size_t> best;  // indices of samples that no later sample beats
    for (std::size_t next = 0, i = 0; i < samples.size(); ++i) {
        for (; next < samples.size() && next <= i + reach; ++next) {
            if (std::isnan(samples[next])) continue;
            while (!best.empty() && !wins(samples[best.back()], samples[next])) best.pop_back();
            best.push_back(next);
        }
        while (!best.empty() && best.front() + reach < i) best.pop_front();
        // For a missing sample, the neighbours say nothing about its own value.
        if (!best.empty() && !std::isnan(samples[i])) result[i] = samples[best.front()];
    }
    return result;
}

double fromItsTrigger(const Capture& capture) { return capture.start_s - capture.trigger_s; }

}  // namespace

Result<CaptureMask> CaptureMask::around(const Capture& reference, const MaskBand& band) {
    if (!std::isfinite(reference.trigger_s) || !(reference.rate_hz > 0)) {
        return invalid("a mask takes a reference with a trigger, and this record has none");
    }
    if (!(band.time_s >= 0) || !std::isfinite(band.time_s)) {
        return invalid("the mask's time is {}, not 0 s or more", exactText(band.time_s, "s"));
    }
    for (const auto& [unit, level] : band.level) {
        if (level > 0 && std::isfinite(level)) continue;
        return invalid("the mask's level is {}, not above {}", exactText(level, unit), exactText(0, unit));
    }
    CaptureMask mask;
    mask.band_ = band;
    mask.rate_hz_ = reference.rate_hz;
    mask.start_s_ = fromItsTrigger(reference);
    const auto reach = static_cast<std::size_t>(
        std::min(std::ceil(band.time_s * reference.rate_hz - 1e-9), static_cast<double>(reference.samples())));
    for (const auto& channel : reference.channels) {
        const auto level = band.level.find(channel.unit);
        if (level == band.level.end()) continue;
        Channel its{channel.name, channel.unit, widened(channel.samples, reach, std::less<>()),
                    widened(channel.samples, reach, std::greater<>()), level->second};
        for (auto& x : its.low) x = static_cast<float>(static_cast<double>(x) - level->second);
        for (auto& x : its.high) x = static_cast<float>(static_cast<double>(x) + level->second);
        mask.channels_.push_back(std::move(its));
    }
    if (mask.channels_.empty()) {
        return invalid("no channel of the reference has a unit that the mask has a level for");
    }
    return mask;
}

MaskCheck CaptureMask::check(const Capture& capture) const {
    MaskCheck result;
    if (!std::isfinite(capture.trigger_s)) {
        result.why = "it has no trigger";
        return result;
    }
    double worst = 0;
    const double offset = (fromItsTrigger(capture) - start_s_) * rate_hz_, step = rate_hz_ / capture.rate_hz;
    const auto doubt = [&](std::string why) {
        if (result.why.empty()) result.why = std::move(why);
    };
    for (const auto& mask : channels_) {
        const auto channel = std::find_if(capture.channels.begin(), capture.channels.end(),
                                          [&](const auto& c) { return c.name == mask.name && c.unit == mask.unit; });
        if (channel == capture.channels.end()) {
            doubt("it has no channel '" + mask.name + "'");
            continue;
        }
        const auto limits = clipLimits(*channel);
        const double last = static_cast<double>(mask.low.size()) - 1;
        std::size_t judged = 0;
        for (std::size_t i = 0; i < channel->samples.size(); ++i) {
            const double at = offset + static_cast<double>(i) * step;
            if (at < -1e-6 || at > last + 1e-6) continue;
            const auto before = static_cast<std::size_t>(std::clamp(std::floor(at + 1e-6), 0.0, last));
            const auto after = static_cast<std::size_t>(std::clamp(std::ceil(at - 1e-6), 0.0, last));
            const auto low = static_cast<double>(std::min(mask.low[before], mask.low[after]));
            const auto high = static_cast<double>(std::max(mask.high[before], mask.high[after]));
            if (std::isnan(mask.low[before]) || std::isnan(mask.low[after])) continue;
            const auto x = static_cast<double>(channel->samples[i]);
            ++judged;
            if (std::isnan(x)) {
                doubt("samples of '" + mask.name + "' are missing");
                continue;
            }
            if (x >= low && x <= high) {
                if (limits && limits->reachedBy(x)) doubt("'" + mask.name + "' is clipped");
                continue;
            }
            ++result.outside;
            const double limit = x > high ? high : low;
            const double beyond = std::abs(x - limit) / mask.halfWidth;
            if (result.worst && !(beyond > worst)) continue;
            worst = beyond;
            result.worst =
                MaskViolation{mask.name, fromItsTrigger(capture) + static_cast<double>(i) / capture.rate_hz, x, limit};
        }
        // The mask ends with its reference: a capture may be shorter by the shift of its samples.
        if (judged == 0) {
            doubt("no sample of '" + mask.name + "' lies in the mask's time");
        } else if (offset > 1 || offset + static_cast<double>(channel->samples.size()) * step < last) {
            doubt("it covers a part of the mask's time only");
        }
    }
    if (result.outside > 0) {
        result.verdict = MaskVerdict::Outside;
        result.why.clear();
    } else if (result.why.empty()) {
        result.verdict = MaskVerdict::Inside;
    }
    return result;
}

}  // namespace tacto
