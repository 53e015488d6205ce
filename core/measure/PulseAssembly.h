// PulseAssembly.h - builds pulses from phases: measures each phase, leaves out ringing, integrates charges and pairs
// phases that belong together. Private to core/measure.
//
// Phases are added one by one, in time order, and become pulses two phases later. The assembly looks no further ahead,
// so that only a few measured phases are held at a time, even for a record of hundreds of thousands of pulses.
//
// Thread-safety: none; one owner.
#pragma once

#include <array>
#include <cstddef>
#include <initializer_list>
#include <vector>

#include "core/measure/Capture.h"
#include "core/measure/PhaseFinder.h"
#include "core/measure/PulseMeasurement.h"
#include "core/measure/StateLevels.h"

namespace tacto {

class PulseAssembly {
public:
    /// `capture` and `levels` must outlive this object. With three states, opposite phases at most `gapMax_s` apart
    /// become one pulse; otherwise each phase is a pulse. `phases`: the largest number to be added.
    PulseAssembly(const Capture& capture, const StateLevels& levels, double gapMax_s, std::size_t phases);

    /// Adds the next phase in time. Its view must outlive this object.
    void add(const PhaseSpan& span);
    /// Ends the assembly. Call it once, after the last phase.
    [[nodiscard]] std::vector<PulseMeasurement> finish();
    /// Returns the width of the longest phase that was not ringing.
    [[nodiscard]] double widest_s() const noexcept { return widest_s_; }

private:
    void settleNewest(bool last);
    void integrate(std::size_t k);
    void pairNext();
    [[nodiscard]] double gapTo(std::size_t k, std::size_t second) const;
    [[nodiscard]] bool isSplit(std::size_t k) const;
    [[nodiscard]] bool mayLackLeading(std::size_t k) const;
    void addPulse(std::initializer_list<const FoundPhase*> phases, const PulseFlags& flags);

    /// Kept phases are numbered in order. The newest, which may still be dropped, has the number kept_.
    [[nodiscard]] FoundPhase& at(std::size_t k) noexcept { return window_[k % window_.size()]; }
    [[nodiscard]] const FoundPhase& at(std::size_t k) const noexcept { return window_[k % window_.size()]; }

    const Capture& capture_;
    const StateLevels& levels_;
    double gapMax_s_;
    std::array<FoundPhase, 8> window_;  ///< the last phases; five of them are used
    bool hasNewest_ = false;
    std::size_t kept_ = 0;       ///< number of kept phases, which are not ringing
    std::size_t paired_ = 0;     ///< how many kept phases belong to pulses already
    bool chainedToCut_ = false;  ///< applies to the next phase to be paired
    bool chainedToHidden_ = false;
    bool upLeads_ = false;  ///< true if the upper phase leads in the pulses with two phases so far
    bool downLeads_ = false;
    double widest_s_ = 0;
    std::vector<PulseMeasurement> pulses_;
};

}  // namespace tacto
