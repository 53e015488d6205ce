// ChosenReadings.h - which readings are shown, chosen freely and remembered; one choice for the table and the dock.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QObject>
#include <vector>

#include "app/gui/scope/measurements/Reading.h"

class QMenu;
class QSettings;
class QWidget;

namespace tacto::gui {

class ChosenReadings final : public QObject {
    Q_OBJECT
public:
    ChosenReadings();
    /// In Reading's order.
    [[nodiscard]] const std::vector<Reading>& all() const noexcept { return chosen_; }
    [[nodiscard]] bool has(Reading reading) const;
    void choose(Reading reading, bool on);
    void chooseStandard();

    void save(QSettings& settings) const;
    /// Names that are none are passed over; without any the choice stays.
    void restore(const QSettings& settings);

signals:
    void changed();

private:
    std::vector<Reading> chosen_;
};

/// A menu in which they are chosen; it stays open from one to the next, until its last row
/// closes it: Esc would stop the output. `chosen` outlives it.
[[nodiscard]] QMenu* makeReadingsMenu(ChosenReadings& chosen, QWidget* parent);

}  // namespace tacto::gui
