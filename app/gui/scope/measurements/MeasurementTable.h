// MeasurementTable.h - a table with a row for each chosen reading: the last value of each channel and its statistics
// over the captures seen. Also buttons to restart and to choose readings, and the reasons for missing values.
//
// Statistics that do not fit stand in the tool tip of the last value: the table never scrolls sideways.
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
    /// The newest record was not triggered: it is not counted, and a note says this until the next capture. `held`: the
    /// screen shows the last train instead of this record.
    void passOverUntriggered(bool held);
    void clear();
    [[nodiscard]] const CaptureStatistics& statistics() const noexcept { return statistics_; }
    /// The table as tab-separated text, as Ctrl+C copies it.
    [[nodiscard]] QString asText() const;
    /// One line for each channel with the last values of the chosen readings, for a picture.
    [[nodiscard]] QStringList asLines() const;

signals:
    /// The user restarted the statistics; the average then restarts too.
    void resetClicked();

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
