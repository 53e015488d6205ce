// PhaseFinder.h - finds excursions from the baseline and marks clipped ones. Private to core/measure.
#pragma once

#include <cstddef>
#include <deque>
#include <limits>

#include "core/measure/PulseMeasurement.h"
#include "core/measure/SampleBlocks.h"
#include "core/measure/StateLevels.h"

namespace tacto {

// An excursion from the baseline, before it becomes part of a pulse. Private to core/measure.

/// The place of a phase. A record may hold hundreds of thousands of phases, so only this is stored about each before it
/// is measured.
struct PhaseSpan {
    const SampleView* view = nullptr;  ///< samples in which the phase was found and is measured
    std::size_t begin = 0;             ///< first sample of the view beyond the threshold
    std::size_t end = 0;               ///< the sample after the last one
    double area = 0;                   ///< integral of the distance from the baseline, in unit × seconds
    signed char sign = 0;              ///< +1: above the baseline, -1: below
    bool truncated = false;
    bool incomplete = false;
    bool clipped = false;
    bool flatTop = false;  ///< top cut off, see Clipping.h
    /// Distance to missing samples, before the next phase on that side, in which a phase may be hidden; in samples of
    /// the view. Infinite if there are none. 0: this phase itself may begin or end among them.
    float hiddenBefore = std::numeric_limits<float>::infinity();
    float hiddenAfter = std::numeric_limits<float>::infinity();
    float hiddenFor = 0;  ///< length of the missing stretch before

    [[nodiscard]] double from_s() const noexcept { return view->timeOf(static_cast<double>(begin)); }
    [[nodiscard]] double to_s() const noexcept { return view->timeOf(static_cast<double>(end)); }
};

/// Grows without moving its elements and uses little spare memory, because the number of phases is unknown.
using PhaseSpans = std::deque<PhaseSpan>;

struct FoundPhase : PhaseSpan {
    double onset = kNotMeasured;  ///< 50 % points as positions in the view
    double end50 = kNotMeasured;
    PhaseMeasurement measured;  ///< filled even if a flag is set: the caller decides what to show
};

enum class Sides { Both, Up, Down };  ///< sides of the baseline: above or below

/// Returns the phases in time order. A side for which `levels` has no state has no phases. `view` and `blocks` hold the
/// same samples and must outlive the phases; levels.count must not be None.
[[nodiscard]] PhaseSpans findPhases(const SampleView& view, const SampleBlocks& blocks, const StateLevels& levels,
                                    Sides sides);

}  // namespace tacto
