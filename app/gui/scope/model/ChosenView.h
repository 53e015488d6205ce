// ChosenView.h - what the user chose to see of the bench's captures, kept from one start to the next.
//
// Thread-safety: as QSettings, the GUI thread.
#pragma once

#include "app/gui/scope/model/Remembered.h"
#include "app/gui/scope/model/Viewport.h"

namespace tacto::gui {

/// Nothing where the whole is shown.
struct ChosenView {
    struct Time {
        double left_s = 0, perDivision_s = 0;
    };
    std::optional<Time> time;
    std::map<QString, LaneScale> lanes;  ///< empty: fitted
};

void saveView(QSettings& settings, const ChosenView& chosen);
/// What is not there, or was not written by saveView(), is left out.
[[nodiscard]] ChosenView restoredView(QSettings& settings);

}  // namespace tacto::gui
