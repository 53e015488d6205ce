// OverlayOf.h - what an oscilloscope's model puts over its traces, as ScopeOverlay draws it.
//
// Thread-safety: the GUI thread.
#pragma once

#include "app/gui/scope/model/ScopeModel.h"
#include "app/gui/scope/screen/OverlayState.h"

namespace tacto::gui {

/// All but what belongs to one screen: the box of a zoom and an alarm. In the current theme.
[[nodiscard]] OverlayState overlayOf(const ScopeModel& model);

}  // namespace tacto::gui
