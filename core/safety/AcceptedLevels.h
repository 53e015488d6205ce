// AcceptedLevels.h - the levels that a person has accepted in this session, and so the highest next level (H6).
//
// A level is the current of one kind of train: with another width, shape, gap, polarity, number or rate of pulses it
// feels different. So acceptance covers one kind and starts at zero when the kind changes. A level may be one ramp step
// above the highest accepted one at most; an accepted level may be entered in one step; in a series of ascending limits
// the ceiling is one step above the series' last accepted level. No level exceeds the discomfort limit, which only
// falls, or the study's cap.
//
// Thread-safety: none; one caller (the gate). Allocates only for error texts.
#pragma once

#include <limits>
#include <optional>

#include "core/base/Result.h"
#include "core/encoding/PulseTrain.h"

namespace tacto {

/// The levels that a person permits on one scale (mA, or a massager's intensity) by the rules above.
class AcceptedScale {
public:
    /// From now on no level exceeds `level`, which felt uncomfortable. A higher value than before changes nothing.
    void reportDiscomfort(double level) noexcept;
    /// Begins a series of ascending limits: it starts from zero, whatever was accepted before.
    void beginAscending() noexcept;
    void endAscending() noexcept { ascending_ = false; }

protected:
    /// Begins with a new participant, who has accepted nothing.
    void begin(double discomfortLimit, double rampStep) noexcept;
    /// Continues with the same participant and new settings: keeps the accepted levels and the lower discomfort limit.
    void resume(double discomfortLimit, double rampStep) noexcept;
    void forget() noexcept { highest_ = seriesLast_ = 0; }
    void keep(double level) noexcept;
    [[nodiscard]] double accepted() const noexcept { return ascending_ ? seriesLast_ : highest_; }

    double discomfort_ = 0;
    double step_ = 0;
    bool ascending_ = false;

private:
    double highest_ = 0;     // the highest in this session, of the current kind
    double seriesLast_ = 0;  // the last level accepted in this ascending series
};

/// Currents, in mA.
class AcceptedLevels : public AcceptedScale {
public:
    /// Begins as AcceptedScale does; `cap` is the study's cap, if any.
    void begin(Milliamps discomfortLimit, Milliamps rampStep, std::optional<Milliamps> cap = {}) noexcept;
    void resume(Milliamps discomfortLimit, Milliamps rampStep, std::optional<Milliamps> cap = {}) noexcept;

    /// Errors: LimitExceeded naming the level, the ceiling and the rule that set the ceiling.
    [[nodiscard]] Result<void> permits(const PulseTrain& train) const;
    /// Returns the highest current that a train of this kind may have now.
    [[nodiscard]] Milliamps ceilingFor(const PulseTrain& train) const noexcept;

    /// Notes that the participant accepted this train's level. Errors: as permits(), also for a level that was never
    /// permitted.
    [[nodiscard]] Result<void> accept(const PulseTrain& train);
    void reportDiscomfort(Milliamps level) noexcept { AcceptedScale::reportDiscomfort(level.value()); }

    [[nodiscard]] Milliamps discomfortLimit() const noexcept { return Milliamps(discomfort_); }

private:
    [[nodiscard]] bool sameKind(const PulseTrain& train) const noexcept;

    double cap_ = std::numeric_limits<double>::infinity();  // mA; infinite without a cap
    PulseTrain kind_;                                       // its amplitude is ignored
};

/// Strengths of a massager, 0 to 1. All bursts are of one kind: the gate checks their length, and the motor's frequency
/// follows its strength.
class AcceptedIntensities : public AcceptedScale {
public:
    using AcceptedScale::begin;
    using AcceptedScale::resume;

    /// Errors: LimitExceeded naming the intensity, the ceiling and the rule that set the ceiling.
    [[nodiscard]] Result<void> permits(double intensity) const;
    /// Returns the highest intensity that a burst may have now.
    [[nodiscard]] double ceiling() const noexcept;
    /// Notes that the participant accepted this intensity. Errors: as permits(), also for one never permitted.
    [[nodiscard]] Result<void> accept(double intensity);
};

}  // namespace tacto
