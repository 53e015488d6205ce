// ComingLines.h - draws the train that comes next over the last one: dashed, with what it will be.
//
// Thread-safety: the GUI thread.
#pragma once

#include "app/gui/scope/screen/OverlayState.h"
#include "app/gui/scope/screen/ScopePlane.h"

namespace tacto::gui {

class ComingLines {
public:
    /// Both outlive it.
    ComingLines(const ScopePlane& plane, const OverlayState& state) : plane_(plane), state_(state) {}

    void draw(QCPPainter& painter) const;
    /// Where its words stand, inside the plot.
    [[nodiscard]] QRectF wordsBox(const OverlayState::Coming& coming) const;

private:
    const ScopePlane& plane_;
    const OverlayState& state_;
};

}  // namespace tacto::gui
