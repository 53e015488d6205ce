// LimitSetView.h - shows the limit sets in force, one at a time, chosen by title: for each limit its value, averaging
// time, place, action and source; then what the set requires to be stated.
//
// All sets apply, not only the shown one.
#pragma once

#include <QComboBox>
#include <QDialog>
#include <QLabel>
#include <QTableWidget>
#include <QWidget>
#include <vector>

#include "core/safety/LimitSet.h"

namespace tacto::gui {

class LimitSetView final : public QWidget {
    Q_OBJECT
public:
    /// `sets` outlives this.
    explicit LimitSetView(const std::vector<LimitSet>& sets, QWidget* parent);
    /// Shows the set with this id; does nothing if there is none.
    void choose(const QString& id);

private:
    void show(int index);
    const std::vector<LimitSet>& sets_;
    QComboBox* chooser_;
    QTableWidget* table_;
    QLabel* stated_;
};

/// Makes a window with this view, showing the set with this id.
[[nodiscard]] QDialog* makeLimitSetWindow(const std::vector<LimitSet>& sets, const QString& id, QWidget* parent);

}  // namespace tacto::gui
