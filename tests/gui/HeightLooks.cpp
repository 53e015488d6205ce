#include "tests/gui/HeightLooks.h"

#include <QAbstractButton>
#include <QComboBox>
#include <QLabel>
#include <QPlainTextEdit>
#include <QScrollBar>
#include <QStyleOptionComboBox>
#include <QTabBar>
#include <QTextEdit>

#include "tests/gui/ShownWidgets.h"

namespace tacto::test {

namespace {

/// Adds a text if a line of the font needs more than the `room` pixels it has.
void addLow(const QString& text, const QWidget& at, const QFontMetrics& font, int room, QStringList& low) {
    const int needs = font.height() + font.lineSpacing() * int(text.count('\n'));
    if (!text.isEmpty() && room + 1 < needs) low << cutOf(text, at, room, needs);
}

void addLowCells(const QAbstractItemView& view, QStringList& low) {
    const auto seen = view.viewport()->rect();
    int least = 0;  // the least height of a visible row
    forEachCell(view, view.rootIndex(), [&](const QModelIndex& cell) {
        const auto place = view.visualRect(cell);
        if (place.isEmpty() || !seen.intersects(place) || view.indexWidget(cell) != nullptr) return;
        least = least == 0 ? place.height() : std::min(least, place.height());
        const auto own = cell.data(Qt::FontRole);
        const QFontMetrics font(own.isValid() ? own.value<QFont>().resolve(view.font()) : view.font());
        addLow(cell.data().toString(), view, font, place.height(), low);
    });
    if (least > seen.height() + 1) low << cutOf("a row", view, seen.height(), least);
}

void addLowFields(const QWidget& in, QStringList& low) {
    forEachShown<QLineEdit>(in, [&](const QLineEdit& edit) {
        const auto text = edit.text().isEmpty() ? edit.placeholderText() : edit.displayText();
        addLow(text, edit, edit.fontMetrics(), roomForText(edit).height(), low);
    });
    forEachShown<QComboBox>(in, [&](const QComboBox& box) {
        QStyleOptionComboBox option;
        option.initFrom(&box);
        option.editable = box.isEditable();
        const auto field =
            box.style()->subControlRect(QStyle::CC_ComboBox, &option, QStyle::SC_ComboBoxEditField, &box);
        addLow(box.currentText(), box, box.fontMetrics(), field.height(), low);
    });
}

void addLowTitles(const QWidget& in, QStringList& low) {
    forEachShown<QTabBar>(in, [&](const QTabBar& tabs) {
        const bool upright = tabs.shape() == QTabBar::RoundedWest || tabs.shape() == QTabBar::RoundedEast;
        for (int i = 0; i < tabs.count(); ++i) {
            const auto place = tabs.tabRect(i) & tabs.rect();
            if (tabs.isTabVisible(i) && !place.isEmpty())
                addLow(tabs.tabText(i), tabs, tabs.fontMetrics(), upright ? place.width() : place.height(), low);
        }
    });
    forEachShown<QHeaderView>(in, [&](const QHeaderView& header) {
        for (int i = 0; i < header.count() && header.model() != nullptr; ++i) {
            const auto text = header.model()->headerData(i, header.orientation()).toString();
            const bool across = header.orientation() == Qt::Horizontal;
            if (header.isSectionHidden(i) || header.sectionViewportPosition(i) >= header.viewport()->width()) continue;
            addLow(text, header, header.fontMetrics(), across ? header.height() : header.sectionSize(i), low);
        }
    });
}

/// Returns the part of the widget that its ancestors leave visible, in the widget's coordinates. Sets `mayScroll` if
/// one of them shows a scroll bar that leads to the rest.
QRect inSight(const QWidget& widget, bool& mayScroll) {
    QRect seen = widget.rect();
    QPoint to;
    for (const auto* at = &widget; at != nullptr; at = at->parentWidget()) {
        seen &= at->rect().translated(-to);
        if (!at->mask().isEmpty()) seen &= at->mask().boundingRect().translated(-to);
        if (const auto* area = qobject_cast<const QAbstractScrollArea*>(at))
            mayScroll = mayScroll || area->verticalScrollBar()->isVisible();
        if (at->isWindow()) break;
        to += at->pos();
    }
    return seen;
}

/// True if some of the widget is visible, but not its full height.
bool isCutBelow(const QRect& whole, const QRect& seen) {
    const auto part = whole & seen;
    return !part.isEmpty() && part.height() + 1 < whole.height();
}

void addCutRows(const QAbstractItemView& view, QStringList& cut) {
    bool mayScroll = view.verticalScrollBar()->isVisible();
    const auto seen = inSight(*view.viewport(), mayScroll);
    if (mayScroll) return;
    forEachCell(view, view.rootIndex(), [&](const QModelIndex& cell) {
        const auto place = view.visualRect(cell);
        if (cell.column() == 0 && isCutBelow(place, seen))
            cut << cutOf(cell.data().toString(), view, (place & seen).height(), place.height());
    });
}

}  // namespace

QStringList lowTexts(const QWidget& in) {
    QStringList low;
    forEachView(in, [&](const QAbstractItemView& view) { addLowCells(view, low); });
    addLowFields(in, low);
    addLowTitles(in, low);
    forEachShown<QLabel>(in, [&](const QLabel& label) {
        if (!label.wordWrap() && !Qt::mightBeRichText(label.text()))
            addLow(label.text(), label, label.fontMetrics(), label.contentsRect().height(), low);
    });
    const auto addText = [&](const QAbstractScrollArea& text) {
        const int needs = text.fontMetrics().height(), has = text.viewport()->height();
        if (has + 1 < needs) low << cutOf("a line", text, has, needs);
    };
    forEachShown<QTextEdit>(in, addText);
    forEachShown<QPlainTextEdit>(in, addText);
    return low;
}

QStringList cutBelow(const QWidget& in) {
    QStringList cut;
    forEachView(in, [&](const QAbstractItemView& view) { addCutRows(view, cut); });
    forEachShown<QAbstractScrollArea>(in, [&](const QAbstractScrollArea& area) {
        const auto* bar = area.verticalScrollBar();
        if (qobject_cast<const QHeaderView*>(&area) != nullptr || bar->isVisible() || bar->maximum() <= bar->minimum())
            return;
        cut << QString("%1: %2 more below, and no scroll bar").arg(called(area)).arg(bar->maximum() - bar->minimum());
    });
    forEachShown<QWidget>(in, [&](const QWidget& widget) {
        const bool words = qobject_cast<const QLabel*>(&widget) != nullptr ||
                           qobject_cast<const QAbstractButton*>(&widget) != nullptr ||
                           qobject_cast<const QLineEdit*>(&widget) != nullptr ||
                           qobject_cast<const QComboBox*>(&widget) != nullptr;
        bool mayScroll = false;
        const auto seen = inSight(widget, mayScroll);
        if (words && !mayScroll && isCutBelow(widget.rect(), seen))
            cut << QString("%1: %2 of %3 px are in sight").arg(called(widget)).arg(seen.height()).arg(widget.height());
    });
    return cut;
}

}  // namespace tacto::test
