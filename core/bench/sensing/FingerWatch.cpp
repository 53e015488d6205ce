#include "core/bench/sensing/FingerWatch.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tacto {

namespace {
constexpr Instant kReportPoll = std::chrono::milliseconds(100);
constexpr Instant kReportEvery = std::chrono::seconds(10);  // how often continuing losses are reported
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
    for (const auto& frame : finger_->encoded().frames) {
        shown.boardRoughness = frame.R;
        shown.boardPressure = frame.P;
    }
    for (const auto& silence : finger_->encoded().silences) {
        if (silence.why == shown.boardSilent) continue;  // said again for each train refused
        shown.boardSilent = silence.why;
        journal_.boardSilent(now, silence.why.view());
    }
    shown.boardDrives = finger_->boardDrives();
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

namespace {

void pushSamples(const FingerInput& finger, BenchTap& tap) noexcept {
    const auto blocks = finger.blocks();
    const auto streams = finger.session().device().streams();
    for (std::size_t s = 0; s < blocks.size(); ++s) {
        TapSample sample;
        sample.stream = static_cast<std::uint32_t>(s);
        const auto all = streams[s].channels;
        const auto shown = std::min(all, TapSample::kMaxChannels);
        sample.channels = static_cast<std::uint32_t>(shown);
        for (std::size_t i = 0; i < blocks[s].samples(); ++i) {
            sample.t_s = blocks[s].t_s[i];
            for (std::size_t c = 0; c < shown; ++c)
                sample.values[c] = static_cast<float>(blocks[s].values[i * all + c]);
            tap.samples.push(sample);
        }
    }
}

}  // namespace

void SampleTaps::listen(BenchTap* tap) {
    const std::scoped_lock lock(mutex_);
    listener_ = tap;
    listening_.store(tap != nullptr, std::memory_order_release);
}

void SampleTaps::push(const FingerInput& finger) noexcept {
    if (display_ != nullptr) {
        pushSamples(finger, *display_);
        for (const auto& frame : finger.frames()) display_->frames.push(frame);
        for (const auto& frame : finger.encoded().frames) display_->boardFrames.push(frame);
        for (const auto& train : finger.encoded().trains) display_->boardTrains.push(train);
    }
    if (!listening_.load(std::memory_order_acquire)) return;
    const std::scoped_lock lock(mutex_);
    if (listener_ != nullptr) pushSamples(finger, *listener_);
}

}  // namespace tacto
