// DeliveryJudge.h - judges what the stimulator and the oscilloscope report about a delivered train: its status, its
// amplitude, its load. The control loop acts on any fault found.
//
// Thread-safety: none; the control loop owns it. Allocates only for a fault.
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

/// A fault that ends delivery, and its reason.
struct LoopFault {
    FaultCause cause;
    FixedText<255> reason;  ///< fixed text, to allocate nothing before the output is off
};

/// Returns the train as the status in the report describes it.
[[nodiscard]] TrainReadBack readBackOf(const TrainReport& report) noexcept;

class DeliveryJudge {
public:
    /// All arguments outlive the judge, which keeps `load` up to date. `source` is the stimulator's.
    DeliveryJudge(OutputMode mode, SafetyGate& gate, const Interlock& interlock, ArmedLoad& load,
                  const SourceTraits& source)
        : mode_(mode), gate_(gate), interlock_(interlock), load_(load), source_(source) {
        rows_.reserve(kMaxExposureRows);
    }

    /// Sets the amplitude at which the last posted train should come out, V or mA.
    void expect(double amplitude) noexcept { expected_ = amplitude; }

    /// Judges a train or a check pulse. `permitted`: similar trains may still be posted, so this reading is used.
    [[nodiscard]] std::optional<LoopFault> delivered(const TrainReport& report, bool permitted);
    /// Judges the status in the report.
    [[nodiscard]] TrainJudgement status(const TrainReport& report) const noexcept;
    [[nodiscard]] bool wasCutOff(const TrainReport& report) const noexcept;
    /// Checks that the amplitude read back equals the commanded one.
    [[nodiscard]] std::optional<LoopFault> readBack(const TrainReport& report);
    /// Checks the amplitude in a capture in the same way.
    [[nodiscard]] std::optional<LoopFault> amplitude(const SeenAmplitude& seen);
    /// The largest recent measurement of the output since it was armed; NaN before the first.
    [[nodiscard]] const MeasuredOutput& measured() const noexcept { return measured_; }
    void forgetMeasured() noexcept { measured_ = {}; }
    /// The unit of amplitudes: "V" or "mA".
    [[nodiscard]] const char* unit() const noexcept { return amplitudeUnit(source_.drive); }
    /// Judges the load in a capture if the stimulator does not read back.
    [[nodiscard]] std::optional<LoopFault> load(const SeenLoad& seen, bool permitted, Instant now);
    /// Returns a fault if a train due to end at `trainEnd` has no status by `now`, or only a status that it goes on.
    [[nodiscard]] std::optional<LoopFault> silence(Instant trainEnd, bool goesOn, Instant now) const;

private:
    [[nodiscard]] std::optional<LoopFault> updateImpedance(Ohms measured, Instant at);
    [[nodiscard]] std::optional<LoopFault> reading(const TrainReport& report);
    [[nodiscard]] std::optional<LoopFault> deviation(const SeenAmplitude& seen);
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
    bool readsAmplitude_ = false;  // true once the device has read an amplitude back
    MeasuredOutput measured_;
    std::vector<ExposureRow> rows_;
};

// Watches the reading of |Z| that delivery relies on: whether the stimulator's status is overdue, and when the reading
// becomes too old.

class ReadingWatch {
public:
    /// All arguments outlive the watch; the stimulator may be null.
    ReadingWatch(const StimulatorSession* stimulator, const ArmedLoad& load, const DeliveryJudge& judge) noexcept
        : stimulator_(stimulator), load_(load), judge_(judge) {}

    /// Returns a fault for a train that ended without a status in time.
    [[nodiscard]] std::optional<LoopFault> silence(Instant now) const {
        if (stimulator_ == nullptr || stimulator_->idle()) return std::nullopt;
        return judge_.silence(stimulator_->trainEnd(), stimulator_->saysItDelivers(), now);
    }
    /// Returns when the reading becomes too old; nothing if the source takes none.
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
