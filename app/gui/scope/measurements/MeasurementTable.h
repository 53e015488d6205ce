// MeasurementTable.h - the chosen readings as rows, and for each channel its last value with the statistics over the
// captures seen; a button that starts over, one that chooses, and in words what could not be measured and why.
//
// Statistics that have no room stand in the tool tip of the last value: the table never scrolls sideways.
#pragma once

#include <QWidget>

#include "app/gui/scope/measurements/CaptureStatistics.h"
#include "app/gui/scope/measurements/Reading.h"

class QLabel;
class QPushButton;
class QTableWidget;

namespace tacto::gui {

class MeasurementTable final : public QWidget {
    Q_OBJECT
public:
    /// `chosen` outlives this.
    explicit MeasurementTable(ChosenReadings& chosen, QWidget* parent = nullptr);

    /// Adds one more capture.
    void add(const ShownPtr& shown);
    /// The newest record was not triggered: it is not counted, and that is said until the next capture. `held`: the
    /// screen does not show it, but the last train.
    void passOverUntriggered(bool held);
    void clear();
    [[nodiscard]] const CaptureStatistics& statistics() const noexcept { return statistics_; }
    /// The table as tab-separated text, for the clipboard.
    [[nodiscard]] QString asText() const;
    /// The last values of the chosen readings in a line for each channel, for a picture.
    [[nodiscard]] QStringList asLines() const;

signals:
    /// The user restarted the statistics: the average restarts too.
    void resetClicked();

protected:
    void keyPressEvent(QKeyEvent* event) override;

private:
    void lay();
    void restyle();
    void refill();
    void fitColumns();
    [[nodiscard]] QString hiddenText(std::size_t channel, Reading reading) const;

    ChosenReadings& chosen_;
    CaptureStatistics statistics_;
    ShownPtr newest_;  // the newest capture that was counted
    bool passedOver_ = false;
    bool held_ = false;
    QTableWidget* table_;
    QLabel* seen_;
    QLabel* warnings_;
    QPushButton* choose_;
    QPushButton* reset_;
};

}  // namespace tacto::gui
