#include "core/dsp/RoughnessIndex.h"

#include <cmath>

#include "core/base/NaN.h"

namespace tacto {

namespace {
constexpr double kHold_s = 0.25;
constexpr double kDecay_s = 0.25;

double weighed(const RoughnessSettings& settings, double spectral, double taxel) noexcept {
    double sum = 0;
    double weights = 0;
    if (!std::isnan(spectral)) {
        sum += settings.spectralWeight * spectral;
        weights += settings.spectralWeight;
    }
    if (!std::isnan(taxel)) {
        sum += settings.taxelWeight * taxel;
        weights += settings.taxelWeight;
    }
    return weights > 0 ? sum / weights : kNaN;
}
}  // namespace

RoughnessIndex::RoughnessIndex(const RoughnessSettings& settings, double period_s) noexcept
    : settings_(settings), alpha_(1 - std::exp(-period_s / settings.smoothing.count())) {}

double RoughnessIndex::combine(const RoughnessSettings& settings, double spectral, double taxel) noexcept {
    return weighed(settings, settings.spectralScale().g(spectral), settings.taxelScale().g(taxel));
}

double RoughnessIndex::ofSlide(const RoughnessSettings& settings, double spectral, double taxel) noexcept {
    return weighed(settings, settings.spectralScale().position(spectral), settings.taxelScale().position(taxel));
}

double RoughnessIndex::next(double t_s, Motion motion, double spectral, double taxel) noexcept {
    switch (motion) {
        case Motion::NoContact:
            started_ = false;
            return kNaN;
        case Motion::Unknown:
            return kNaN;
        case Motion::Sliding: {
            const double raw = combine(settings_, spectral, taxel);
            if (std::isnan(raw)) {
                lastSliding_ = t_s;
                return kNaN;
            }
            // After a rest it goes on from what was felt last, decayed or not.
            current_ = held_ = started_ ? current_ + alpha_ * (raw - current_) : raw;
            started_ = true;
            lastSliding_ = t_s;
            return current_;
        }
        case Motion::Resting:
            break;
    }
    if (!started_) return kNaN;
    const double resting = t_s - lastSliding_;
    if (resting > kHold_s) current_ = held_ * std::exp(-(resting - kHold_s) / kDecay_s);
    return current_;
}

}  // namespace tacto
