// WholeRows.h - a page of rows that scrolls, or a list or table that does: a row that has no room for all of it is left
// out, never cut.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QAbstractItemView>
#include <QScrollArea>
#include <vector>

namespace tacto::gui {

class WholeRows final : public QScrollArea {
    Q_OBJECT
public:
    /// `rows` has a layout, and what is laid out in it, at any depth, makes the rows: the lines of a long text and the
    /// rows of a list among them. Where not one has room, the first is drawn as far as it goes.
    WholeRows(QWidget* rows, QWidget* parent);

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;

private:
    [[nodiscard]] std::vector<QRect> rows() const;
    void drawWholeRows();
};

/// The view draws no row at its end in part. Where not one has room, it is drawn as far as it goes.
void keepRowsWhole(QAbstractItemView& view);

}  // namespace tacto::gui
