// TimeFlags.h - the flags with the values at the oscilloscope's two time cursors, placed where they hide least of the
// traces.
#pragma once

#include <QRectF>
#include <vector>

#include "app/gui/scope/screen/OverlayState.h"
#include "app/gui/scope/screen/ScopePlane.h"

namespace tacto::gui {

class TimeFlags {
public:
    /// Both arguments outlive this.
    TimeFlags(const ScopePlane& plane, const OverlayState& state) : plane_(plane), state_(state) {}

    /// The boxes in the order of the cursors; empty if there are no cursors.
    [[nodiscard]] std::vector<QRectF> boxes() const;
    void draw(QCPPainter& painter) const;

private:
    /// The pixels that the traces cover.
    [[nodiscard]] std::vector<QRectF> drawnBoxes() const;
    /// The place of the text between the time cursors, beside the flags.
    [[nodiscard]] QRectF spanBox(const std::vector<QRectF>& flags) const;
    [[nodiscard]] double belowTheMark() const;  ///< the trigger's mark at the top of the screen
    [[nodiscard]] QSizeF sizeOf(const OverlayState::Flag& flag) const;
    void drawFlag(QCPPainter& painter, const QRectF& box, const OverlayState::Flag& flag, bool focused) const;

    const ScopePlane& plane_;
    const OverlayState& state_;
};

}  // namespace tacto::gui
