// WheelGuard.h - the wheel changes no setting that has not the focus, and gives none: a list, a number, a slider or the
// tabs under a pointer that scrolls by stay as they are, and what they stand in scrolls (hazard H12).
//
// Thread-safety: the GUI thread.
#pragma once

#include <QObject>

class QWidget;

namespace tacto::gui {

class WheelGuard final : public QObject {
public:
    /// For every window of the program, from now on; again: nothing.
    static void install();
    /// What a turn of the wheel would change.
    [[nodiscard]] static bool isSetting(const QWidget& widget);

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    using QObject::QObject;
};

}  // namespace tacto::gui
