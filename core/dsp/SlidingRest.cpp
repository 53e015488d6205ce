#include "core/dsp/SlidingRest.h"

namespace tacto {

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
