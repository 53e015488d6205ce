// SampleTaps.h - where the control loop shows what passes through it: the tap of the display that the bench was opened
// with, and a listener that comes and goes (BenchTap.h). Either may be missing.
//
// Thread-safety: listen() any thread; the rest has one caller, the control loop. Never allocates.
#pragma once

#include <atomic>
#include <mutex>

#include "core/bench/sensing/BenchTap.h"
#include "core/bench/sensing/FingerInput.h"

namespace tacto {

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

}  // namespace tacto
