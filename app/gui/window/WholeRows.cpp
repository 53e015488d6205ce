#include "app/gui/window/WholeRows.h"

#include <QEvent>
#include <QLayout>
#include <QScrollBar>
#include <algorithm>
#include <cstdlib>

namespace tacto::gui {

WholeRows::WholeRows(QWidget* rows, QWidget* parent) : QScrollArea(parent) {
    setFrameShape(QFrame::NoFrame);
    setWidgetResizable(true);
    setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    setMinimumHeight(1);
    setWidget(rows);
    rows->installEventFilter(this);  // after QScrollArea's own: its layout is done
    connect(verticalScrollBar(), &QScrollBar::valueChanged, this, &WholeRows::drawWholeRows);
}

std::vector<QRect> WholeRows::rows() const {
    std::vector<QRect> all;
    for (int i = 0; i < widget()->layout()->count(); ++i) {
        const auto* row = widget()->layout()->itemAt(i)->widget();
        if (row != nullptr && !row->isHidden()) all.push_back(row->geometry());
    }
    return all;
}

void WholeRows::drawWholeRows() {
    if (widget() == nullptr) return;
    auto& bar = *verticalScrollBar();
    const int top = bar.value(), bottom = top + viewport()->height();
    const auto all = rows();
    QRect whole;
    int highest = 0, nearest = -1;
    for (const auto& row : all) {
        if (top <= row.top() && row.bottom() < bottom) whole |= row;
        highest = std::max(highest, row.height());
        if (row.height() > viewport()->height() || row.top() > bar.maximum()) continue;
        if (nearest < 0 || std::abs(row.top() - top) < std::abs(nearest - top)) nearest = row.top();
    }
    bar.setSingleStep(highest + widget()->layout()->spacing());
    // Between two rows that have room for one: it goes to the nearer.
    if (whole.isEmpty() && nearest >= 0 && nearest != top) return bar.setValue(nearest);
    if (whole.isEmpty())
        widget()->clearMask();
    else
        widget()->setMask(QRect(0, whole.top(), widget()->width(), whole.height()));
}

bool WholeRows::eventFilter(QObject* watched, QEvent* event) {
    const bool done = QScrollArea::eventFilter(watched, event);
    if (watched == widget() && (event->type() == QEvent::LayoutRequest || event->type() == QEvent::Resize))
        drawWholeRows();
    return done;
}

void WholeRows::resizeEvent(QResizeEvent* event) {
    QScrollArea::resizeEvent(event);
    drawWholeRows();
}

}  // namespace tacto::gui

#include "moc_WholeRows.cpp"
