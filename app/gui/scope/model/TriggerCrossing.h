// TriggerCrossing.h - where a sampled signal crosses the trigger level, between two samples: there the screen has its
// time 0, so that an edge stands still from capture to capture though the samples fall elsewhere on it each time.
//
// Thread-safety: pure functions.
#pragma once

#include <memory>

#include "core/devices/Oscilloscope.h"
#include "core/measure/Capture.h"

namespace tacto::gui {

/// The same samples at the same times, with the trigger where the line between two samples of the trigger's channel
/// rises through the level. The capture itself where no such crossing lies within a sample interval of the trigger that
/// the oscilloscope states: then that one stays. What was measured of it stays as well.
[[nodiscard]] std::shared_ptr<const Capture> triggeredAtCrossing(std::shared_ptr<const Capture> capture,
                                                                 const ScopeSettings& settings);

}  // namespace tacto::gui
