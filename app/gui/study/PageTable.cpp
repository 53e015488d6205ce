#include "app/gui/study/PageTable.h"

#include <QHeaderView>
#include <QResizeEvent>
#include <algorithm>

#include "app/gui/theme/Building.h"
#include "app/gui/theme/Pages.h"
#include "app/gui/theme/Theme.h"

namespace tacto::gui {

PageTable::PageTable(const char* name, const QString& title, QWidget& page, int pad, bool chosen)
    : QTableWidget(&page), page_(page), pad_(pad) {
    nameWidget(*this, name, title);
    if (chosen) {
        setSelectionBehavior(QAbstractItemView::SelectRows);
        setFocusPolicy(Qt::StrongFocus);
    }
    page.installEventFilter(this);
    afterLookChange(page, [this] { layOut(); });
}

void PageTable::show(const std::vector<ResultColumn>& columns, const nlohmann::json& records) {
    fillRecordTable(*this, columns, records);
    layOut();
}

int PageTable::chosenRow() const {
    const auto rows = selectionModel()->selectedRows();
    return rows.size() == 1 ? rows.front().row() : -1;
}

/// Lays out the table in its present style and text size.
void PageTable::layOut() {
    if (columnCount() == 0) return;
    ensurePolished();
    horizontalHeader()->ensurePolished();
    layOutRecordTable(*this, std::max(1, widthInSight(page_) - 2 * (pad_ + 1)));
}

bool PageTable::eventFilter(QObject* watched, QEvent* event) {
    if (watched == &page_ && event->type() == QEvent::Resize) {
        const auto* resized = static_cast<QResizeEvent*>(event);
        if (resized->size().width() != resized->oldSize().width()) layOut();
    }
    return QTableWidget::eventFilter(watched, event);
}

}  // namespace tacto::gui
