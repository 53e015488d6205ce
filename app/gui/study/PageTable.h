// PageTable.h - a table of records on a page: shows all rows, no wider than the page, and laid out again when the page
// or the text size changes.
#pragma once

#include "app/gui/theme/RecordColumns.h"

namespace tacto::gui {

class PageTable final : public QTableWidget {
public:
    /// `pad`: from an edge of the page to the table. `chosen`: true if rows are selected as a whole.
    PageTable(const char* name, const QString& title, QWidget& page, int pad, bool chosen);
    /// Replaces the contents.
    void show(const std::vector<ResultColumn>& columns, const nlohmann::json& records);
    /// -1 if no row or more than one is chosen.
    [[nodiscard]] int chosenRow() const;

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    void layOut();
    QWidget& page_;
    const int pad_;
};

}  // namespace tacto::gui
