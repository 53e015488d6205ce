// BenchLevels.h - passes the participant's word on levels to the gate and records it; knows which levels exist.
//
// Thread-safety: one caller, the bench's.
#pragma once

#include "core/bench/Bench.h"
#include "core/bench/BenchTime.h"
#include "core/bench/arming/ArmingTerms.h"

namespace tacto {

class BenchLevels {
public:
    /// All arguments outlive this; `loop` is set before the first call. A level that was too strong lowers the limit in
    /// `config`, so that the limit holds at every arming.
    BenchLevels(BenchConfig& config, const BenchOutput& output, const BenchCalibration& calibration,
                const ArmingTerms& terms, const BenchNotes& notes, SafetyGate& gate, BenchTime& time,
                const std::unique_ptr<ControlLoop>& loop) noexcept
        : config_(config),
          output_(output),
          calibration_(calibration),
          terms_(terms),
          notes_(notes),
          gate_(gate),
          time_(time),
          loop_(loop) {}

    /// Errors: Unsupported if the output takes no such level; InvalidArgument for a level off the device's grid.
    [[nodiscard]] Result<void> checkSettable(const StimulusLevel& level) const;
    /// Notes that a presentation ended: only the level of a complete presentation may be accepted.
    void presented(const StimulusLevel& level, const Presented& ended) noexcept;

    /// See Bench.h.
    [[nodiscard]] Result<void> accept(const StimulusLevel& level);
    [[nodiscard]] Result<void> reportDiscomfort(const StimulusLevel& level);
    [[nodiscard]] Result<void> ascend(bool begin);
    [[nodiscard]] Result<StimulusLevel> ceiling();
    [[nodiscard]] Result<PermittedLevel> limit(Seconds interval) const;

private:
    [[nodiscard]] Result<void> checkPerson() const;
    [[nodiscard]] Result<PulseTrain> trainAt(Milliamps level) const;
    [[nodiscard]] Milliamps step() const noexcept;
    [[nodiscard]] StimulusLevel none() const noexcept;
    [[nodiscard]] bool takesIntensities() const noexcept { return output_.massager() != nullptr; }
    [[nodiscard]] Result<void> checkKind(const StimulusLevel& level) const;
    [[nodiscard]] Result<LevelRequest> requestFor(LevelRequest::What what, const StimulusLevel& level) const;
    [[nodiscard]] Result<StimulusLevel> tell(const LevelRequest& request);
    [[nodiscard]] std::string hindranceTo(Milliamps level, Seconds interval, const GateSetup& setup) const;

    BenchConfig& config_;
    const BenchOutput& output_;
    const BenchCalibration& calibration_;
    const ArmingTerms& terms_;
    const BenchNotes& notes_;
    SafetyGate& gate_;
    BenchTime& time_;
    const std::unique_ptr<ControlLoop>& loop_;
    std::optional<StimulusLevel> presented_;  // the last presentation's level, if it was complete and not empty
};

}  // namespace tacto
