// PhaseShape.h - measures one excursion from the baseline: plateau, edges, overshoot, droop. Private to core/measure.
//
// An edge passes a level at the point where the straight line between two samples does. If noise makes the signal pass
// the level several times, downward passages are subtracted from upward ones: on average this gives the passage without
// noise, whereas the first passage is too early.
#pragma once

#include <cstddef>

#include "core/measure/PhaseFinder.h"

namespace tacto {

/// Fills `phase` with all measures of the phase at `span`, except for the charge.
void measureShape(const PhaseSpan& span, double baseline, FoundPhase& phase);

/// Integrates the straight lines between samples from position `from` to `to` in the phase's view, measured from the
/// baseline in the phase's direction; in unit × samples of the view.
[[nodiscard]] double integralOf(const FoundPhase& phase, double baseline, double from, double to);

}  // namespace tacto
