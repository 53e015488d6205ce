// ControlColumn.h - a column of controls that scrolls up and down and is always as wide as they are.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QEvent>
#include <QScrollArea>
#include <QScrollBar>

namespace tacto::gui {

class ControlColumn : public QScrollArea {
public:
    explicit ControlColumn(QWidget* parent) : QScrollArea(parent) {
        setWidgetResizable(true);
        setFrameShape(QFrame::NoFrame);
        setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
        setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Expanding);
    }
    QSize sizeHint() const override {
        const int width = widget() == nullptr ? 0 : widget()->minimumSizeHint().width();
        return {width + verticalScrollBar()->sizeHint().width(), QScrollArea::sizeHint().height()};
    }
    QSize minimumSizeHint() const override { return {sizeHint().width(), fontMetrics().height() * 6}; }

protected:
    bool eventFilter(QObject* watched, QEvent* event) override {
        if (watched == widget() && event->type() == QEvent::LayoutRequest) updateGeometry();
        return QScrollArea::eventFilter(watched, event);
    }
};

}  // namespace tacto::gui
