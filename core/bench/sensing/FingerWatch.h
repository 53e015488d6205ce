// FingerWatch.h - the control loop's view of its finger: what displays see of it, the flags of R, which stay when a
// profile brings another finger, and the sensor's failures and losses.
//
// Thread-safety: none; the control loop owns it. Allocates only for a failure or a report.
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

// Where the control loop pushes passing data: the tap of the display with which the bench was opened, and a listener
// that may come and go (BenchTap.h). Either may be missing.

class SampleTaps {
public:
    explicit SampleTaps(BenchTap* display) noexcept : display_(display) {}

    /// Sets the listener, which gets samples only; null ends it. On return the earlier tap gets nothing more.
    void listen(BenchTap* tap);

    /// Pushes the samples of the finger's last update, and its frames for the display.
    void push(const FingerInput& finger) noexcept;
    void push(const TrainReport& report) noexcept {
        if (display_ != nullptr) display_->trains.push(report);
    }

private:
    BenchTap* const display_;
    std::mutex mutex_;  // held to pass on the samples of one step
    BenchTap* listener_ = nullptr;
    std::atomic<bool> listening_{false};
};

class FingerWatch {
public:
    /// `finger` is null without a sensor. `report` is null unless the sensor reports on itself. All outlive this.
    FingerWatch(std::unique_ptr<FingerInput> finger, const ReportingDevice* report, LoopJournal& journal,
                SampleTaps& taps) noexcept
        : finger_(std::move(finger)), report_(report), journal_(journal), taps_(taps) {}

    /// Null without a sensor.
    [[nodiscard]] const FingerInput* input() const noexcept { return finger_.get(); }
    /// Keeps the earlier flags, except the calibration flags if R was neither shown nor driving.
    void replace(NextFinger next) noexcept;

    /// Takes the samples that arrived, for journal, taps and `shown`.
    void read(Instant now, StepTelemetry& shown) noexcept;
    /// Returns a new failure of the sensor, such as a pulled plug: without the sensor, output from any source ends.
    [[nodiscard]] std::optional<LoopFault> failure() noexcept;
    /// Notes the losses that the sensor reports, at most once in ten seconds.
    void noteLosses(Instant now) noexcept;
    /// Notes every flag of R at once while R drives the output, because the bench may never close properly.
    void noteFlags(Instant now) noexcept;
    /// The flags of all fingers so far.
    [[nodiscard]] RoughnessFlags flags() const noexcept;

private:
    std::unique_ptr<FingerInput> finger_;
    const ReportingDevice* const report_;
    LoopJournal& journal_;
    SampleTaps& taps_;
    RoughnessFlags flagsKept_;  // flags of earlier fingers, and flags that applied while R drove
    std::uint64_t failuresSeen_ = 0;
    std::uint64_t lossesNoted_ = 0;
    Instant lossesDue_{0};  // the time before which losses are not reported again
};

}  // namespace tacto
