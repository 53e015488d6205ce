// PhaseShape.h - one excursion from the baseline, measured: plateau, edges, overshoot, droop. Private to core/measure.
//
// An edge passes a level where the straight line between two samples does. Where noise carries it to and fro, the
// passages up less the passages down are taken: on average that is where it would have passed without noise, while the
// first passage is early.
#pragma once

#include <cstddef>

#include "core/measure/PhaseFinder.h"

namespace tacto {

/// `phase` becomes what lies at `span`, with all of its measures but the charge.
void measureShape(const PhaseSpan& span, double baseline, FoundPhase& phase);

/// ∫ from one position to another in the phase's view, of the straight lines between samples, from the baseline and in
/// the phase's direction; in unit times samples of the view.
[[nodiscard]] double integralOf(const FoundPhase& phase, double baseline, double from, double to);

}  // namespace tacto
