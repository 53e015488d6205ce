#include "tests/gui/RoomLooks.h"

#include <QAbstractButton>
#include <QAbstractItemView>
#include <QAbstractScrollArea>
#include <QAction>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QPlainTextEdit>
#include <QScrollBar>
#include <QTableView>
#include <QTextDocument>
#include <QTreeView>

#include "app/gui/theme/Labels.h"
#include "tests/gui/ShownWidgets.h"

namespace tacto::test {

namespace {

QString plain(const QString& text) {
    if (!Qt::mightBeRichText(text)) return text;
    QTextDocument document;
    document.setHtml(text);
    return document.toPlainText();
}

/// True if the tool tip has all the words, however broken into lines; a sign in front of them need not be repeated.
bool tells(const QString& toolTip, const QString& text) {
    auto words = plain(text).simplified();
    if (words.startsWith("⚠ ") || words.startsWith("✔ ")) words.remove(0, 2);
    return plain(toolTip).simplified().contains(words, Qt::CaseInsensitive);
}

const QHeaderView* headerOf(const QAbstractItemView& view) {
    if (const auto* table = qobject_cast<const QTableView*>(&view)) return table->horizontalHeader();
    if (const auto* tree = qobject_cast<const QTreeView*>(&view)) return tree->header();
    return nullptr;
}

bool mayElide(const QAbstractItemView& view, int column) {
    const auto* header = headerOf(view);
    if (header == nullptr) return false;
    int last = header->count() - 1;
    while (last > 0 && header->isSectionHidden(header->logicalIndex(last))) --last;
    return header->logicalIndex(last) == column || header->sectionResizeMode(column) == QHeaderView::Stretch;
}

void addCutCell(const QAbstractItemView& view, const QModelIndex& cell, QStringList& cut) {
    const auto text = cell.data().toString();
    const auto place = view.visualRect(cell);
    if (text.isEmpty() || place.isEmpty() || view.indexWidget(cell) != nullptr ||
        !view.viewport()->rect().intersects(place))
        return;
    QStyleOptionViewItem option;
    option.initFrom(&view);
    option.font = view.font();
    option.fontMetrics = view.fontMetrics();
    option.rect = place;
    option.decorationSize = view.iconSize().isValid() ? view.iconSize() : QSize(16, 16);
    const auto* table = qobject_cast<const QTableView*>(&view);
    const auto* tree = qobject_cast<const QTreeView*>(&view);
    const bool wraps = (table != nullptr && table->wordWrap()) || (tree != nullptr && tree->wordWrap());
    if (wraps) option.features |= QStyleOptionViewItem::WrapText;
    const auto needs = view.itemDelegateForIndex(cell)->sizeHint(option, cell);
    const auto given = cell.data(Qt::SizeHintRole).toSize();
    const int width = given.isValid() ? 0 : needs.width();
    const bool narrow = width > place.width() + 1;
    const bool low = wraps && needs.height() > place.height() + 1;
    if ((!narrow || wraps) && !low) return;
    const bool told = tells(cell.data(Qt::ToolTipRole).toString(), text);
    if (narrow && told && mayElide(view, cell.column())) return;
    cut << QString("\"%1\" in column %2 of %3: %4x%5 of %6x%7%8")
               .arg(text)
               .arg(cell.column())
               .arg(called(view))
               .arg(place.width())
               .arg(place.height())
               .arg(needs.width())
               .arg(needs.height())
               .arg(told ? "" : ", no tool tip");
}

}  // namespace

QStringList cutCells(const QWidget& in) {
    QStringList cut;
    forEachView(in, [&](const QAbstractItemView& view) {
        forEachCell(view, view.rootIndex(), [&](const QModelIndex& cell) { addCutCell(view, cell, cut); });
    });
    return cut;
}

QStringList cutFields(const QWidget& in) {
    QStringList cut;
    forEachShown<QLineEdit>(in, [&](const QLineEdit& edit) {
        const auto text = edit.text().isEmpty() ? edit.placeholderText() : edit.displayText();
        const int needs = edit.fontMetrics().horizontalAdvance(text);
        const int has = roomForText(edit).width();
        if (needs <= has + 1 || tells(edit.toolTip(), text)) return;
        const auto* of = edit.objectName().startsWith("qt_spinbox") ? edit.parentWidget() : &edit;
        cut << cutOf(text, *of, has, needs);
    });
    return cut;
}

QStringList cutSideways(const QWidget& in) {
    QStringList cut;
    forEachShown<QAbstractScrollArea>(in, [&](const QAbstractScrollArea& area) {
        if (qobject_cast<const QHeaderView*>(&area) != nullptr) return;
        const auto* editor = qobject_cast<const QPlainTextEdit*>(&area);
        if (editor != nullptr && editor->lineWrapMode() == QPlainTextEdit::NoWrap) return;
        const auto* bar = area.horizontalScrollBar();
        if (bar->maximum() > bar->minimum())
            cut << QString("%1: %2 px more than its %3")
                       .arg(called(area))
                       .arg(bar->maximum() - bar->minimum())
                       .arg(area.viewport()->width());
    });
    return cut;
}

QStringList beyondTheirPlace(const QWidget& in) {
    QStringList beyond;
    forEachShown<QWidget>(in, [&](const QWidget& widget) {
        const auto* around = widget.parentWidget();
        if (widget.isWindow() || around == nullptr || around->layout() == nullptr || widget.width() < 2 ||
            widget.height() < 2 || widget.objectName() == "qt_qmainwindow_extended_splitter")
            return;
        const auto cut = widget.geometry().united(around->rect()).size() - around->size();
        if (cut.width() > 1 || cut.height() > 1)
            beyond << QString("%1 in %2: by %3x%4")
                          .arg(called(widget), called(*around))
                          .arg(cut.width())
                          .arg(cut.height());
    });
    return beyond;
}

QStringList untoldElisions(const QWidget& in) {
    QStringList untold;
    forEachShown<QLabel>(in, [&](const QLabel& label) {
        const auto* elided = dynamic_cast<const gui::ElidedLabel*>(&label);
        const bool ignored = label.sizePolicy().horizontalPolicy() == QSizePolicy::Ignored && !label.wordWrap();
        const bool ends = elided != nullptr ? elided->shownText() != label.text()
                                            : ignored && label.sizeHint().width() > label.width() + 1;
        if (!ends || label.text().isEmpty()) return;
        for (const auto* at = static_cast<const QWidget*>(&label); at != nullptr; at = at->parentWidget())
            if (tells(at->toolTip(), label.text())) return;
        untold << QString("%1 \"%2\" has no tool tip with its whole text").arg(called(label), label.text());
    });
    return untold;
}

}  // namespace tacto::test
