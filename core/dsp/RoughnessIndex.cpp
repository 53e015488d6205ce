#include "core/dsp/RoughnessIndex.h"

#include <cmath>

#include "core/base/Statistics.h"

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
            // After a rest, R continues from the last value felt, decayed or not.
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

void SlidingRest::clear() noexcept {
    inDeclared_ = beforeContact_ = {};
    if (!preset_) level_ = std::numeric_limits<double>::quiet_NaN();
    decided_ = preset_;
    assumed_ = false;
}

void SlidingRest::close() noexcept {
    if (decided_ || inDeclared_.count == 0) return;
    level_ = inDeclared_.mean();
    decided_ = true;
}

void SlidingRest::preset(double meanSquare) noexcept {
    level_ = meanSquare;
    decided_ = preset_ = true;
}

void SlidingRest::decide(const Frame& frame) noexcept {
    if (declared_) {
        if (!(frame.end_s > declared_->end_s)) return;
        if (inDeclared_.count > 0) {
            level_ = inDeclared_.mean();
            decided_ = true;
            return;
        }
    }
    if (!frame.contact) return;
    decided_ = true;
    if (frame.firstContact_s - frame.streamBegin_s >= kShortestRest_s && beforeContact_.count > 0) {
        level_ = beforeContact_.mean();
    } else if (profile_) {
        level_ = *profile_;
    } else {
        assumed_ = true;
    }
}

Motion SlidingRest::next(const Frame& frame) noexcept {
    if (!hasAcceleration_) {
        assumed_ = assumed_ || frame.contact;
        return frame.contact ? Motion::Sliding : Motion::NoContact;
    }
    if (!decided_) {
        if (declared_ && frame.begin_s >= declared_->begin_s && frame.end_s <= declared_->end_s) {
            inDeclared_.add(frame.meanSquare);
        }
        if (frame.end_s < frame.firstContact_s) beforeContact_.add(frame.meanSquare);
        decide(frame);
    }
    if (!frame.contact) return Motion::NoContact;
    if (assumed_) return Motion::Sliding;
    if (!decided_) return Motion::Unknown;
    return frame.meanSquare < kFactor * level_ ? Motion::Resting : Motion::Sliding;
}

}  // namespace tacto
