// TourFrame.h - a frame around a control that the tour talks about. It lies in the control's own window and takes
// neither clicks nor keys.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QPointer>
#include <QWidget>

namespace tacto::gui {

/// A part of a widget, or all of it where `part` is null.
struct TourTarget {
    QWidget* widget = nullptr;
    QRect part{};
};

class TourFrame final : public QWidget {
    Q_OBJECT
public:
    explicit TourFrame(QWidget* window);
    /// Goes around what can be seen of it; hides where nothing can.
    void follow(const TourTarget& target);

protected:
    void paintEvent(QPaintEvent* event) override;
};

/// What can be seen of it, in the coordinates of its window; empty where nothing can.
[[nodiscard]] QRect visiblePart(const TourTarget& target);

}  // namespace tacto::gui
