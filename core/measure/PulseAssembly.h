// PulseAssembly.h - from phases to pulses: each phase is measured, ringing is left out, charges are integrated and the
// phases that belong together are paired. Private to core/measure.
//
// Phases come one by one, in time order, and leave as pulses two phases later. Nothing looks further ahead, so that a
// record of hundreds of thousands of pulses keeps only a few measured phases at a time.
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
    /// `capture` and `levels` must outlive this. Opposite phases at most `gapMax_s` apart become one pulse where there
    /// are three states; else each phase is a pulse. `phases`: how many are to come, at most.
    PulseAssembly(const Capture& capture, const StateLevels& levels, double gapMax_s, std::size_t phases);

    /// The next phase in time. Its view must outlive this.
    void add(const PhaseSpan& span);
    /// No phase follows. Call it once, after the last.
    [[nodiscard]] std::vector<PulseMeasurement> finish();
    /// The longest phase that was not ringing.
    [[nodiscard]] double widest_s() const noexcept { return widest_s_; }

private:
    void settleNewest(bool last);
    void integrate(std::size_t k);
    void pairNext();
    [[nodiscard]] double gapTo(std::size_t k, std::size_t second) const;
    [[nodiscard]] bool isSplit(std::size_t k) const;
    [[nodiscard]] bool mayLackLeading(std::size_t k) const;
    void addPulse(std::initializer_list<const FoundPhase*> phases, const PulseFlags& flags);

    /// Phases are numbered as they are kept. The newest, which may not turn out to be one, has number kept_.
    [[nodiscard]] FoundPhase& at(std::size_t k) noexcept { return window_[k % window_.size()]; }
    [[nodiscard]] const FoundPhase& at(std::size_t k) const noexcept { return window_[k % window_.size()]; }

    const Capture& capture_;
    const StateLevels& levels_;
    double gapMax_s_;
    std::array<FoundPhase, 8> window_;  ///< the last phases: five are looked at
    bool hasNewest_ = false;
    std::size_t kept_ = 0;       ///< phases that are not ringing
    std::size_t paired_ = 0;     ///< how many of these belong to pulses already
    bool chainedToCut_ = false;  ///< the next to be paired
    bool chainedToHidden_ = false;
    bool upLeads_ = false;  ///< whether the upper phase leads in the pulses with two phases so far
    bool downLeads_ = false;
    double widest_s_ = 0;
    std::vector<PulseMeasurement> pulses_;
};

}  // namespace tacto
