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

class AcceptedLevels {
public:
    /// A new participant: nothing accepted.
    void begin(Milliamps discomfortLimit, Milliamps rampStep, std::optional<Milliamps> cap = {}) noexcept;
    /// The same participant again with other settings: keeps what was accepted and the lower discomfort limit.
    void resume(Milliamps discomfortLimit, Milliamps rampStep, std::optional<Milliamps> cap = {}) noexcept;

    /// Errors: LimitExceeded naming the level, the ceiling and which rule set it.
    [[nodiscard]] Result<void> permits(const PulseTrain& train) const;
    /// The highest current that a train of this kind may have now.
    [[nodiscard]] Milliamps ceilingFor(const PulseTrain& train) const noexcept;

    /// The participant accepted this train's level. Errors: as permits(); LimitExceeded also when the level was never
    /// permitted.
    [[nodiscard]] Result<void> accept(const PulseTrain& train);
    /// The participant called `level` uncomfortable: from now on nothing exceeds it. A higher value than before changes
    /// nothing.
    void reportDiscomfort(Milliamps level) noexcept;

    /// A series of ascending limits begins: it starts from nothing, whatever was accepted before.
    void beginAscending() noexcept;
    void endAscending() noexcept { ascending_ = false; }

    [[nodiscard]] Milliamps discomfortLimit() const noexcept { return Milliamps(discomfort_); }

private:
    [[nodiscard]] bool sameKind(const PulseTrain& train) const noexcept;
    // All in mA.
    double discomfort_ = 0;
    double cap_ = std::numeric_limits<double>::infinity();  // Infinite: the study has none
    double step_ = 0;
    double highest_ = 0;     // For trains of kind_, in this session
    double seriesLast_ = 0;  // For trains of kind_, in this ascending series
    bool ascending_ = false;
    PulseTrain kind_;  // Amplitude ignored
};

}  // namespace tacto
