// LaneColours.h - the colour in which a lane of the oscilloscope is drawn, and in which its words are written.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QColor>

#include "app/gui/scope/model/ScopeModel.h"

namespace tacto::gui {

/// In the current theme.
[[nodiscard]] QColor laneColour(const ScopeModel& model, const ScopeLane& lane);
/// The same for words and numbers: at least 4.5:1 on the screen's ground.
[[nodiscard]] QColor laneInk(const ScopeModel& model, const ScopeLane& lane);

}  // namespace tacto::gui
