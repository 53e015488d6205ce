// FingerWatch.h - what the control loop makes of its finger: what displays see of it, the flags of R, which stay when a
// profile brings another finger, and what the sensor failed at or lost.
//
// Thread-safety: none; the control loop owns it. Allocates for a failure and for a report alone.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>

#include "core/bench/LoopInbox.h"
#include "core/bench/LoopJournal.h"
#include "core/bench/delivery/DeliveryJudge.h"
#include "core/bench/sensing/BenchTap.h"
#include "core/bench/sensing/FingerInput.h"
#include "core/devices/Device.h"

namespace tacto {

// Where the control loop shows what passes through it: the tap of the display that the bench was opened
// with, and a listener that comes and goes (BenchTap.h). Either may be missing.

class SampleTaps {
public:
    explicit SampleTaps(BenchTap* display) noexcept : display_(display) {}

    /// `tap` gets samples alone; null ends it. On return nothing pushes into the one before.
    void listen(BenchTap* tap);

    /// The samples of the finger's last update, and its frames for the display.
    void push(const FingerInput& finger) noexcept;
    void push(const TrainReport& report) noexcept {
        if (display_ != nullptr) display_->trains.push(report);
    }

private:
    BenchTap* const display_;
    std::mutex mutex_;  // held to hand over the samples of one step
    BenchTap* listener_ = nullptr;
    std::atomic<bool> listening_{false};
};

class FingerWatch {
public:
    /// `finger` is null without a sensor. `report` is the sensor, if it reports on itself, else null. All outlive this.
    FingerWatch(std::unique_ptr<FingerInput> finger, const ReportingDevice* report, LoopJournal& journal,
                SampleTaps& taps) noexcept
        : finger_(std::move(finger)), report_(report), journal_(journal), taps_(taps) {}

    /// Null without a sensor.
    [[nodiscard]] const FingerInput* input() const noexcept { return finger_.get(); }
    /// The earlier flags stay, except those of calibration where R was not shown and drove nothing.
    void replace(NextFinger next) noexcept;

    /// Takes what arrived, for journal, taps and `shown`.
    void read(Instant now, StepTelemetry& shown) noexcept;
    /// The failure since the last call: a missing sensor ends the output of any source. A plug was pulled at the
    /// finger.
    [[nodiscard]] std::optional<LoopFault> failure() noexcept;
    /// Notes the losses that the sensor reports, once in ten seconds while it keeps losing.
    void noteLosses(Instant now) noexcept;
    /// R drives the output: every flag of it is in the session before the bench closes, since it may never close.
    void noteFlags(Instant now) noexcept;
    /// Flags of all fingers so far.
    [[nodiscard]] RoughnessFlags flags() const noexcept;

private:
    std::unique_ptr<FingerInput> finger_;
    const ReportingDevice* const report_;
    LoopJournal& journal_;
    SampleTaps& taps_;
    RoughnessFlags flagsKept_;  // flags of earlier fingers, and of what has driven the output
    std::uint64_t failuresSeen_ = 0;
    std::uint64_t lossesNoted_ = 0;
    Instant lossesDue_{0};  // losses are not reported before then
};

}  // namespace tacto
