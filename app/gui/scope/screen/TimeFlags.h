// TimeFlags.h - the two time cursors of an oscilloscope with what they read, as flags that stand where they hide least
// of the traces.
#pragma once

#include <QRectF>
#include <vector>

#include "app/gui/scope/screen/OverlayState.h"
#include "app/gui/scope/screen/ScopePlane.h"

namespace tacto::gui {

class TimeFlags {
public:
    /// Both arguments outlive it.
    TimeFlags(const ScopePlane& plane, const OverlayState& state) : plane_(plane), state_(state) {}

    /// The boxes in the order of the cursors; empty without them.
    [[nodiscard]] std::vector<QRectF> boxes() const;
    void draw(QCPPainter& painter) const;

private:
    /// The pixels that the traces cover.
    [[nodiscard]] std::vector<QRectF> drawnBoxes() const;
    /// Where the words between the time cursors stand.
    [[nodiscard]] QRectF spanBox(const std::vector<QRectF>& drawn) const;
    [[nodiscard]] QSizeF sizeOf(const OverlayState::Flag& flag) const;
    void drawFlag(QCPPainter& painter, const QRectF& box, const OverlayState::Flag& flag, bool focused) const;

    const ScopePlane& plane_;
    const OverlayState& state_;
};

}  // namespace tacto::gui
