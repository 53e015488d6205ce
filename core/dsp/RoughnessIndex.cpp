#include "core/dsp/RoughnessIndex.h"

#include <cmath>
#include <limits>

namespace tacto {

namespace {
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kHold_s = 0.25;
constexpr double kDecay_s = 0.25;
}  // namespace

RoughnessIndex::RoughnessIndex(const RoughnessSettings& settings, double period_s) noexcept
    : settings_(settings), alpha_(1 - std::exp(-period_s / settings.smoothing.count())) {}

double RoughnessIndex::combine(const RoughnessSettings& settings, double spectral, double taxel) noexcept {
    double sum = 0;
    double weights = 0;
    if (const double g = settings.spectralScale().g(spectral); !std::isnan(g)) {
        sum += settings.spectralWeight * g;
        weights += settings.spectralWeight;
    }
    if (const double g = settings.taxelScale().g(taxel); !std::isnan(g)) {
        sum += settings.taxelWeight * g;
        weights += settings.taxelWeight;
    }
    return weights > 0 ? sum / weights : kNan;
}

double RoughnessIndex::next(double t_s, Motion motion, double spectral, double taxel) noexcept {
    switch (motion) {
        case Motion::NoContact:
            started_ = false;
            return kNan;
        case Motion::Unknown:
            return kNan;
        case Motion::Sliding: {
            const double raw = combine(settings_, spectral, taxel);
            if (std::isnan(raw)) {
                lastSliding_ = t_s;
                return kNan;
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
    if (!started_) return kNan;
    const double resting = t_s - lastSliding_;
    if (resting > kHold_s) current_ = held_ * std::exp(-(resting - kHold_s) / kDecay_s);
    return current_;
}

}  // namespace tacto
