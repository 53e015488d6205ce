// PhaseFinder.h - excursions from the baseline: where they lie, and which were clipped. Private to core/measure.
#pragma once

#include <cstddef>
#include <deque>
#include <limits>

#include "core/measure/PulseMeasurement.h"
#include "core/measure/SampleBlocks.h"
#include "core/measure/StateLevels.h"

namespace tacto {

// An excursion from the baseline on its way to becoming part of a pulse. Private to core/measure.

/// The place of a phase. A record may hold hundreds of thousands: this is all that is known of each before any is
/// measured.
struct PhaseSpan {
    const SampleView* view = nullptr;  ///< the samples in which it was found and is measured
    std::size_t begin = 0;             ///< first of the view's samples beyond the threshold
    std::size_t end = 0;               ///< the sample after the last
    double area = 0;                   ///< ∫ of its samples' distances from the baseline, in unit times second
    signed char sign = 0;              ///< +1 above the baseline, -1 below
    bool truncated = false;
    bool incomplete = false;
    bool clipped = false;
    bool flatTop = false;  ///< see Clipping.h
    /// The distance to a stretch of missing samples in which a phase may lie, before the next phase on that side, in
    /// samples of the view; infinite if there is none. 0: the phase itself may begin or end in it.
    float hiddenBefore = std::numeric_limits<float>::infinity();
    float hiddenAfter = std::numeric_limits<float>::infinity();
    float hiddenFor = 0;  ///< the length of the one before

    [[nodiscard]] double from_s() const noexcept { return view->timeOf(static_cast<double>(begin)); }
    [[nodiscard]] double to_s() const noexcept { return view->timeOf(static_cast<double>(end)); }
};

/// Grows without moving its elements, and takes no more memory than they need: nobody knows how many there will be.
using PhaseSpans = std::deque<PhaseSpan>;

struct FoundPhase : PhaseSpan {
    double onset = kNotMeasured;  ///< 50 % points as positions in the view
    double end50 = kNotMeasured;
    PhaseMeasurement measured;  ///< filled also where a flag stands: the caller decides what to show
};

enum class Sides { Both, Up, Down };  ///< above the baseline, below it

/// The phases in time order. A side on which `levels` has no state has no phases. `view` and `blocks` hold the same
/// samples and must outlive the phases; levels.count is not None.
[[nodiscard]] PhaseSpans findPhases(const SampleView& view, const SampleBlocks& blocks, const StateLevels& levels,
                                    Sides sides);

}  // namespace tacto
