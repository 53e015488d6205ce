// MeasurementTable.h - the measured values of every channel with their statistics over the captures seen, a button that
// begins anew, and in words what could not be measured and why.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QWidget>

#include "app/gui/scope/CaptureStatistics.h"

class QLabel;
class QPushButton;
class QTableWidget;

namespace tacto::gui {

class MeasurementTable final : public QWidget {
    Q_OBJECT
public:
    explicit MeasurementTable(QWidget* parent = nullptr);

    /// One more capture.
    void add(const std::vector<ChannelMeasurement>& measured, const std::vector<std::string>& warnings);
    /// What is shown now was not triggered: it is not counted, and that is said until the next capture.
    void passOverUntriggered();
    void clear();
    [[nodiscard]] const CaptureStatistics& statistics() const noexcept { return statistics_; }
    /// The table as tab-separated text, for the clipboard.
    [[nodiscard]] QString asText() const;

protected:
    void keyPressEvent(QKeyEvent* event) override;
    void changeEvent(QEvent* event) override;

private:
    void layRows();
    void sizeColumns();
    void restyle();
    void refill();
    void fillRow(int row, const CaptureStatistics::Channel& channel, int statistic);

    CaptureStatistics statistics_;
    bool passedOver_ = false;
    QTableWidget* table_;
    QLabel* seen_;
    QLabel* warnings_;
    QPushButton* reset_;
};

}  // namespace tacto::gui
