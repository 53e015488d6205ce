// PilotOrder.h - the run that a pilot session is, from what its first page was told.
//
// Thread-safety: the GUI thread.
#pragma once

#include "app/gui/controller/BenchController.h"
#include "app/gui/pilot/PilotStart.h"

namespace tacto::gui {

/// With the profile, the limits and the notes of the day as they are now.
[[nodiscard]] Result<RunOrder> pilotOrder(const PilotStart& start, BenchController& controller);

}  // namespace tacto::gui
