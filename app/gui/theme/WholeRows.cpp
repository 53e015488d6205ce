#include "app/gui/theme/WholeRows.h"

#include <QEvent>
#include <QHeaderView>
#include <QLabel>
#include <QLayout>
#include <QScrollBar>
#include <QTableView>
#include <QTreeView>
#include <algorithm>
#include <cstdlib>

namespace tacto::gui {

namespace {

constexpr int kLongText = 4;  // lines: a shorter one is a sentence, which stays whole where it has room

/// Its own, where it is as high as they are.
void addRows(const QAbstractItemView& view, const QPoint& at, std::vector<QRect>& parts) {
    const auto inside = view.viewport()->geometry().translated(at);
    if (inside.top() > at.y() + view.frameWidth())
        parts.emplace_back(at, QPoint(at.x() + view.width() - 1, inside.top() - 1));  // its header
    const auto* rows = view.model();
    for (int i = 0; rows != nullptr && i < rows->rowCount(view.rootIndex()); ++i) {
        const auto row = view.visualRect(rows->index(i, 0, view.rootIndex())).translated(inside.topLeft());
        if (row.isValid()) parts.push_back(row.intersected(inside));
    }
}

void addLines(const QLabel& label, const QPoint& at, int room, std::vector<QRect>& parts) {
    const int all = std::max(1, label.height() / label.fontMetrics().lineSpacing());
    const int lines = all > kLongText || label.height() > room ? all : 1;
    for (int i = 0; i < lines; ++i) {
        const int top = label.height() * i / lines, bottom = label.height() * (i + 1) / lines;
        parts.emplace_back(at.x(), at.y() + top, label.width(), bottom - top);
    }
}

void addParts(const QWidget& in, const QPoint& at, int room, std::vector<QRect>& parts) {
    for (const auto* child : in.findChildren<QWidget*>(Qt::FindDirectChildrenOnly)) {
        if (child->isHidden() || child->isWindow() || child->height() == 0) continue;
        const auto from = at + child->pos();
        if (child->layout() != nullptr)
            addParts(*child, from, room, parts);
        else if (const auto* view = qobject_cast<const QAbstractItemView*>(child))
            addRows(*view, from, parts);
        else if (const auto* label = qobject_cast<const QLabel*>(child); label != nullptr && label->wordWrap())
            addLines(*label, from, room, parts);
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
    addParts(*widget(), {}, viewport()->height(), parts);
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

namespace {

class WholeRowsOfView final : public QObject {
public:
    explicit WholeRowsOfView(QAbstractItemView& view) : QObject(&view), view_(view) {
        view_.viewport()->installEventFilter(this);
        const auto& bar = *view_.verticalScrollBar();
        // The rows are laid out after their bar.
        connect(&bar, &QScrollBar::rangeChanged, this, &WholeRowsOfView::fit, Qt::QueuedConnection);
        connect(&bar, &QScrollBar::valueChanged, this, &WholeRowsOfView::fit, Qt::QueuedConnection);
    }

private:
    void fit() {
        auto& page = *view_.viewport();
        const int end = page.height();
        const auto last = view_.indexAt({1, end - 1});
        const auto row = last.isValid() ? view_.visualRect(last) : QRect();
        if (row.top() <= 0 || row.bottom() < end)
            page.clearMask();
        else
            page.setMask(QRect(0, 0, page.width(), row.top()));
    }
    bool eventFilter(QObject* watched, QEvent* event) override {
        if (event->type() == QEvent::Resize)
            QMetaObject::invokeMethod(this, &WholeRowsOfView::fit, Qt::QueuedConnection);
        return QObject::eventFilter(watched, event);
    }

    QAbstractItemView& view_;
};

}  // namespace

void keepRowsWhole(QAbstractItemView& view) { new WholeRowsOfView(view); }

}  // namespace tacto::gui

#include "moc_WholeRows.cpp"
