// AcceptedLevels.h - which levels a person has accepted in this session, and so how far the next may go (H6).
//
// A level is the current of one kind of train: with another width, shape, gap, polarity, number or rate of pulses the
// same current feels different, so acceptance is kept for one kind and starts again from zero when it changes. A level
// above the highest accepted one may be at most one ramp step above it; an accepted level may be entered in one step;
// in a series of ascending limits the ceiling is the series' last accepted level plus one step; nothing exceeds the
// discomfort limit, which only falls, or the cap of the study.
//
// Thread-safety: none; one caller (the gate's). Never allocates, except ceilings' error texts.
#pragma once

#include <limits>
#include <optional>

#include "core/base/Result.h"
#include "core/encoding/PulseTrain.h"

namespace tacto {

/// The levels that a person permits on one scale, mA or a massager's intensity, by the rules above.
class AcceptedScale {
public:
    /// `level` was called uncomfortable: from now on nothing exceeds it. A higher value than before changes nothing.
    void reportDiscomfort(double level) noexcept;
    /// A series of ascending limits begins: it starts from nothing, whatever was accepted before.
    void beginAscending() noexcept;
    void endAscending() noexcept { ascending_ = false; }

protected:
    /// A new participant: nothing accepted.
    void begin(double discomfortLimit, double rampStep) noexcept;
    /// The same participant continues with other settings: keeps what was accepted and the lower discomfort limit.
    void resume(double discomfortLimit, double rampStep) noexcept;
    void forget() noexcept { highest_ = seriesLast_ = 0; }
    void keep(double level) noexcept;
    [[nodiscard]] double accepted() const noexcept { return ascending_ ? seriesLast_ : highest_; }

    double discomfort_ = 0;
    double step_ = 0;
    bool ascending_ = false;

private:
    double highest_ = 0;     // the highest in this session, of the kind at hand
    double seriesLast_ = 0;  // the last in this ascending series
};

/// Currents, in mA.
class AcceptedLevels : public AcceptedScale {
public:
    /// Begins as AcceptedScale does, with the cap of the study, if it has one.
    void begin(Milliamps discomfortLimit, Milliamps rampStep, std::optional<Milliamps> cap = {}) noexcept;
    void resume(Milliamps discomfortLimit, Milliamps rampStep, std::optional<Milliamps> cap = {}) noexcept;

    /// Errors: LimitExceeded naming the level, the ceiling and which rule set it.
    [[nodiscard]] Result<void> permits(const PulseTrain& train) const;
    /// The highest current that a train of this kind may have now.
    [[nodiscard]] Milliamps ceilingFor(const PulseTrain& train) const noexcept;

    /// The participant accepted this train's level. Errors: as permits(); LimitExceeded also when the level was never
    /// permitted.
    [[nodiscard]] Result<void> accept(const PulseTrain& train);
    void reportDiscomfort(Milliamps level) noexcept { AcceptedScale::reportDiscomfort(level.value()); }

    [[nodiscard]] Milliamps discomfortLimit() const noexcept { return Milliamps(discomfort_); }

private:
    [[nodiscard]] bool sameKind(const PulseTrain& train) const noexcept;

    double cap_ = std::numeric_limits<double>::infinity();  // in mA; infinite: the study has none
    PulseTrain kind_;                                       // Amplitude ignored
};

/// Strengths of a massager, 0 to 1. A burst has one kind: its length is the gate's matter, and the motor's frequency
/// follows its strength.
class AcceptedIntensities : public AcceptedScale {
public:
    using AcceptedScale::begin;
    using AcceptedScale::resume;

    /// Errors: LimitExceeded naming the intensity, the ceiling and which rule set it.
    [[nodiscard]] Result<void> permits(double intensity) const;
    /// The highest intensity that a burst may have now.
    [[nodiscard]] double ceiling() const noexcept;
    /// The participant accepted this intensity. Errors: as permits(): LimitExceeded also when it was never permitted.
    [[nodiscard]] Result<void> accept(double intensity);
};

}  // namespace tacto
