// AcceptedIntensities.h - which strengths of a massager a person has accepted in this session, and so how far the next
// may go (H6).
//
// As AcceptedLevels, for intensities from 0 to 1. A burst has one kind: its length is the gate's matter, and the
// motor's frequency follows its strength. An intensity above the highest accepted one may be at most one ramp step
// above it; an accepted one may be entered in one step; in a series of ascending limits the ceiling is the series' last
// accepted intensity plus one step; nothing exceeds the discomfort limit, which only falls.
//
// Thread-safety: none; one caller (the gate's). Never allocates, except ceilings' error texts.
#pragma once

#include "core/base/Result.h"

namespace tacto {

class AcceptedIntensities {
public:
    /// A new participant: nothing accepted.
    void begin(double discomfortLimit, double rampStep) noexcept;
    /// The same participant again with other settings: keeps what was accepted and the lower discomfort limit.
    void resume(double discomfortLimit, double rampStep) noexcept;

    /// Errors: LimitExceeded naming the intensity, the ceiling and which rule set it.
    [[nodiscard]] Result<void> permits(double intensity) const;
    /// The highest intensity that a burst may have now.
    [[nodiscard]] double ceiling() const noexcept;

    /// The participant accepted this intensity. Errors: as permits(): LimitExceeded also when it was never permitted.
    [[nodiscard]] Result<void> accept(double intensity);
    /// The participant called `intensity` uncomfortable: from now on nothing exceeds it. A higher value than before
    /// changes nothing.
    void reportDiscomfort(double intensity) noexcept;

    /// A series of ascending limits begins: it starts from nothing, whatever was accepted before.
    void beginAscending() noexcept;
    void endAscending() noexcept { ascending_ = false; }

private:
    double discomfort_ = 0;
    double step_ = 0;
    double highest_ = 0;     // In this session
    double seriesLast_ = 0;  // In this ascending series
    bool ascending_ = false;
};

}  // namespace tacto
