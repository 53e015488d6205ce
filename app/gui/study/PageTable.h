// PageTable.h - a table of records on a page: all rows in sight, no wider than the page has room for, laid out again
// when the page or the size of text changes.
#pragma once

#include "app/gui/theme/RecordColumns.h"

namespace tacto::gui {

class PageTable final : public QTableWidget {
public:
    /// `pad`: from an edge of the page to the table. `chosen`: rows can be chosen, one at a time.
    PageTable(const char* name, const QString& title, QWidget& page, int pad, bool chosen);
    /// Replaces what it shows.
    void show(const std::vector<ResultColumn>& columns, const nlohmann::json& records);
    /// -1 for none.
    [[nodiscard]] int chosenRow() const;

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    void layOut();
    QWidget& page_;
    const int pad_;
    const bool chosen_;
};

}  // namespace tacto::gui
