// CalibrationHistory.h - every calibration of a stimulator: how it changed over time, and a list, the newest first:
// which one counts, which were superseded.
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
    /// `of`: nothing where no stimulator is known.
    void list(const CalibrationBook& book, const std::optional<StimulatorId>& stimulator);

private:
    void fitColumns();
    QLabel* empty_;
    CalibrationTrendView* trend_;
    QTableWidget* table_;
};

}  // namespace tacto::gui
