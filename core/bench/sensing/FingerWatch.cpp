#include "core/bench/sensing/FingerWatch.h"

#include <cmath>
#include <utility>

namespace tacto {

namespace {
constexpr Instant kReportPoll = std::chrono::milliseconds(100);
constexpr Instant kReportEvery = std::chrono::seconds(10);  // of a line that goes on losing
}  // namespace

void FingerWatch::replace(NextFinger next) noexcept {
    if (finger_) {
        auto flags = finger_->flags();
        if (next.before == RBefore::Measuring) flags.dropCalibration();
        flags.dropAbsence();
        flagsKept_.include(flags);
    }
    finger_ = std::move(next.finger);
}

void FingerWatch::read(Instant now, StepTelemetry& shown) noexcept {
    if (!finger_) return;
    finger_->update();
    journal_.finger(*finger_);
    taps_.push(*finger_);
    for (const auto& frame : finger_->frames()) {
        if (frame.contact && !std::isnan(frame.h) && frame.sliding) {
            ++shown.slidingFrames;
            shown.sumH += frame.h;
        }
        if (frame.contact && !std::isnan(frame.v)) {
            ++shown.contactFrames;
            shown.sumV += frame.v;
        }
    }
    const auto& newest = finger_->latest();
    shown.roughness = newest.R;
    shown.pressure = newest.P;
    shown.h = newest.h;
    shown.v = newest.v;
    shown.pressure_pa = newest.pressure_pa;
    shown.contact = newest.contact;
    shown.sliding = newest.sliding;
    shown.sensorAge_s = finger_->age_s(toSeconds(now));
    shown.finger = finger_->standing(toSeconds(now));
    shown.samplesLost = finger_->session().samplesLost();
    shown.sensorFinished = finger_->session().finished();
    shown.gaps = finger_->gaps();
    shown.flags = flags();
}

std::optional<LoopFault> FingerWatch::failure() noexcept {
    if (!finger_) return std::nullopt;
    const auto& session = finger_->session();
    const auto failures = session.failures();
    if (std::exchange(failuresSeen_, failures) == failures) return std::nullopt;
    const auto why = fmt::format("the fingertip sensor failed: {}", session.error().view());
    return LoopFault{FaultCause::DeviceFault, std::string_view(why)};
}

void FingerWatch::noteLosses(Instant now) noexcept {
    if (!finger_ || report_ == nullptr || now < lossesDue_) return;
    const auto report = report_->deviceReport();
    lossesDue_ = now + kReportPoll;
    if (report.losses <= lossesNoted_) return;
    lossesNoted_ = report.losses;
    lossesDue_ = now + kReportEvery;
    journal_.sensorLost(now, report);
}

void FingerWatch::noteFlags(Instant now) noexcept {
    const auto flags = finger_->flags();
    for (std::size_t i = 0; i < flags.times.size(); ++i) {
        if (flags.times[i] != 0 && flagsKept_.times[i] == 0) journal_.flag(now, static_cast<RoughnessFlag>(i));
    }
    flagsKept_.include(flags);
}

RoughnessFlags FingerWatch::flags() const noexcept {
    auto all = flagsKept_;
    if (finger_) all.include(finger_->flags());
    return all;
}

}  // namespace tacto
