// LimitSetView.h - the limit sets in force, to be read: one at a time by its title, each limit with its value, the time
// over which it is taken, where it is judged, what it does, and its source; then what the set asks to be stated.
//
// All sets apply, not only the one shown.
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
    /// `sets` outlives it.
    explicit LimitSetView(const std::vector<LimitSet>& sets, QWidget* parent);
    /// Shows the set with that id; changes nothing if there is none.
    void choose(const QString& id);

private:
    void show(int index);
    const std::vector<LimitSet>& sets_;
    QComboBox* chooser_;
    QTableWidget* table_;
    QLabel* stated_;
};

/// The view in a window of its own, with this set shown.
[[nodiscard]] QDialog* makeLimitSetWindow(const std::vector<LimitSet>& sets, const QString& id, QWidget* parent);

}  // namespace tacto::gui
