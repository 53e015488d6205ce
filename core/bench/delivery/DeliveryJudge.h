// DeliveryJudge.h - judges what the stimulator and the oscilloscope say about a train that was delivered: its status,
// its amplitude, its load. The control loop acts on the fault that is found.
//
// Thread-safety: none; the control loop owns it. Allocates for a fault alone.
#pragma once

#include <optional>
#include <vector>

#include "core/bench/Telemetry.h"
#include "core/bench/arming/ArmingSequence.h"
#include "core/bench/delivery/StimulatorSession.h"
#include "core/bench/delivery/TrainReport.h"
#include "core/bench/sensing/CaptureLoad.h"
#include "core/safety/FixedText.h"
#include "core/safety/TrainCheck.h"

namespace tacto {

/// The end of delivery, and its reason.
struct LoopFault {
    FaultCause cause;
    FixedText<255> reason;  ///< no heap before the output is off
};

/// The train as the report's status tells it.
[[nodiscard]] TrainReadBack readBackOf(const TrainReport& report) noexcept;

class DeliveryJudge {
public:
    /// All arguments outlive the judge, which keeps `load` up to date. `source`: the stimulator's.
    DeliveryJudge(OutputMode mode, SafetyGate& gate, const Interlock& interlock, ArmedLoad& load,
                  const SourceTraits& source)
        : mode_(mode), gate_(gate), interlock_(interlock), load_(load), source_(source) {
        rows_.reserve(kMaxExposureRows);
    }

    /// The amplitude that the train that was posted last should come out with, V or mA.
    void expect(double amplitude) noexcept { expected_ = amplitude; }

    /// Judges a train or a check pulse; `permitted`: trains like it may still be posted, so its reading counts.
    [[nodiscard]] std::optional<LoopFault> delivered(const TrainReport& report, bool permitted);
    /// Judges its status.
    [[nodiscard]] TrainJudgement status(const TrainReport& report) const noexcept;
    [[nodiscard]] bool wasCutOff(const TrainReport& report) const noexcept;
    /// Whether the amplitude that is read back is the one that was commanded.
    [[nodiscard]] std::optional<LoopFault> readBack(const TrainReport& report);
    /// Judges the amplitude in a capture in the same way.
    [[nodiscard]] std::optional<LoopFault> amplitude(const SeenAmplitude& seen);
    /// The measurements of the output since it was armed; before the first: NaN.
    [[nodiscard]] const MeasuredOutput& measured() const noexcept { return measured_; }
    void forgetMeasured() noexcept { measured_ = {}; }
    /// The unit of amplitudes: "V" or "mA".
    [[nodiscard]] const char* unit() const noexcept { return amplitudeUnit(source_.drive); }
    /// Judges the load in a capture, where the stimulator does not read back.
    [[nodiscard]] std::optional<LoopFault> load(const SeenLoad& seen, bool permitted, Instant now);
    /// A train that should have ended at `trainEnd`; by `now` nothing is known of it, or only that it continues.
    [[nodiscard]] std::optional<LoopFault> silence(Instant trainEnd, bool goesOn, Instant now) const;

private:
    [[nodiscard]] std::optional<LoopFault> updateImpedance(Ohms measured, Instant at);
    [[nodiscard]] std::optional<LoopFault> reading(const TrainReport& report);
    [[nodiscard]] std::optional<LoopFault> overLimit(const SeenAmplitude& seen);
    [[nodiscard]] std::optional<LoopFault> unasked(const SeenAmplitude& seen);
    void keep(const SeenAmplitude& seen, bool beyond) noexcept;
    [[nodiscard]] double voltsOf(double amplitude) const noexcept;

    OutputMode mode_;
    SafetyGate& gate_;
    const Interlock& interlock_;
    ArmedLoad& load_;
    const SourceTraits& source_;
    double expected_ = NAN;
    bool readsAmplitude_ = false;  // the device has read it back at least once
    MeasuredOutput measured_;
    std::vector<ExposureRow> rows_;
};

// The reading of |Z| that delivery rests on: whether the stimulator's status is overdue, and when the
// reading grows old.

class ReadingWatch {
public:
    /// All arguments outlive the watch; the stimulator may be null.
    ReadingWatch(const StimulatorSession* stimulator, const ArmedLoad& load, const DeliveryJudge& judge) noexcept
        : stimulator_(stimulator), load_(load), judge_(judge) {}

    /// A train that ended without a status in time.
    [[nodiscard]] std::optional<LoopFault> silence(Instant now) const {
        if (stimulator_ == nullptr || stimulator_->idle()) return std::nullopt;
        return judge_.silence(stimulator_->trainEnd(), stimulator_->saysItDelivers(), now);
    }
    /// When the reading grows old; nothing where none is taken.
    [[nodiscard]] std::optional<Instant> until() const noexcept {
        if (stimulator_ == nullptr || !stimulator_->device().traits().readsBack) return std::nullopt;
        return load_.impedanceAt + Interlock::kImpedanceAge;
    }
    [[nodiscard]] bool isOld(Instant now) const noexcept {
        const auto end = until();
        return end && now > *end;
    }

private:
    const StimulatorSession* stimulator_;
    const ArmedLoad& load_;
    const DeliveryJudge& judge_;
};

}  // namespace tacto
