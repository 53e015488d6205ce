// CalibrationHistory.h - all calibrations of a stimulator: their change over time, and a list, newest first, that shows
// which is valid and which were superseded.
#pragma once

#include <QLabel>
#include <QTableWidget>
#include <QWidget>

#include "app/gui/calibrate/CalibrationBook.h"

namespace tacto::gui {

class CalibrationTrendView;

class CalibrationHistory final : public QWidget {
    Q_OBJECT
public:
    explicit CalibrationHistory(QWidget* parent = nullptr);
    /// `stimulator`: nothing if none is known.
    void list(const CalibrationBook& book, const std::optional<StimulatorId>& stimulator);

private:
    void fitColumns();
    QLabel* empty_;
    CalibrationTrendView* trend_;
    QTableWidget* table_;
};

}  // namespace tacto::gui
