#include "app/gui/window/WholeRows.h"

#include <QEvent>
#include <QLayout>
#include <QScrollBar>
#include <algorithm>
#include <cstdlib>

namespace tacto::gui {

namespace {

void addParts(const QWidget& in, const QPoint& at, std::vector<QRect>& parts) {
    for (const auto* child : in.findChildren<QWidget*>(Qt::FindDirectChildrenOnly)) {
        if (child->isHidden() || child->isWindow() || child->height() == 0) continue;
        if (child->layout() != nullptr)
            addParts(*child, at + child->pos(), parts);
        else
            parts.push_back(child->geometry().translated(at));
    }
}

}  // namespace

WholeRows::WholeRows(QWidget* rows, QWidget* parent) : QScrollArea(parent) {
    setFrameShape(QFrame::NoFrame);
    setWidgetResizable(true);
    setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    setMinimumHeight(1);
    setWidget(rows);
    rows->installEventFilter(this);  // after QScrollArea's own: its layout is done
    connect(verticalScrollBar(), &QScrollBar::valueChanged, this, &WholeRows::drawWholeRows);
}

/// What stands beside each other is one row.
std::vector<QRect> WholeRows::rows() const {
    std::vector<QRect> parts;
    addParts(*widget(), {}, parts);
    std::ranges::sort(parts, {}, &QRect::top);
    std::vector<QRect> all;
    for (const auto& part : parts) {
        if (!all.empty() && part.top() <= all.back().bottom())
            all.back() |= part;
        else
            all.push_back(part);
    }
    return all;
}

void WholeRows::drawWholeRows() {
    if (widget() == nullptr) return;
    auto& bar = *verticalScrollBar();
    const int top = bar.value(), bottom = top + viewport()->height();
    const auto all = rows();
    QRect whole;
    int highest = 0;
    const QRect* nearest = nullptr;
    for (const auto& row : all) {
        if (top <= row.top() && row.bottom() < bottom) whole |= row;
        highest = std::max(highest, row.height());
        if (row.top() > bar.maximum()) continue;
        if (nearest == nullptr || std::abs(row.top() - top) < std::abs(nearest->top() - top)) nearest = &row;
    }
    bar.setSingleStep(highest + widget()->layout()->spacing());
    // Between two rows that have room for one: it goes to the nearer.
    if (whole.isEmpty() && nearest != nullptr && nearest->top() != top && nearest->height() <= viewport()->height())
        return bar.setValue(nearest->top());
    if (whole.isEmpty() || (whole.top() == all.front().top() && whole.bottom() == all.back().bottom()))
        return widget()->clearMask();
    if (whole.top() == all.front().top()) whole.setTop(0);
    if (whole.bottom() == all.back().bottom()) whole.setBottom(widget()->height());
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
