// CalibrationTrendView.h - changes of a stimulator between calibrations: gain, offset and expanded uncertainty U over
// the days, with error bars, the newest one's due date, and a sentence for each change larger than its uncertainty.
#pragma once

#include <QComboBox>
#include <QLabel>
#include <QWidget>
#include <array>
#include <qcustomplot.h>
#include <vector>

#include "core/calibration/CalibrationTrend.h"

namespace tacto::gui {

class CalibrationTrendView final : public QWidget {
    Q_OBJECT
public:
    explicit CalibrationTrendView(QWidget* parent = nullptr);
    /// Shows all stored calibrations of one stimulator, in their order.
    void show(std::vector<StoredCalibration> stored);
    /// Returns the points of the quantity shown.
    [[nodiscard]] const std::vector<TrendPoint>& points() const { return points_; }

private:
    struct Lane {
        QCPAxisRect* axes = nullptr;
        QCPGraph* line = nullptr;
        QCPGraph* jumps = nullptr;
        QCPErrorBars* bars = nullptr;
        QCPItemLine* due = nullptr;
        QCPItemLine* today = nullptr;
    };
    enum LaneOf { kGainLane, kOffsetLane, kULane, kLanes };

    void buildPlot();
    [[nodiscard]] Lane makeLane(int row, bool last);
    void fillChooser();
    void draw();
    void drawLane(LaneOf which, const std::vector<TrendJump>& jumps);
    void drawDays();
    void colour();
    [[nodiscard]] QString dueText() const;
    [[nodiscard]] QString jumpText(const std::vector<TrendJump>& jumps) const;
    [[nodiscard]] QString unit() const;

    std::vector<StoredCalibration> stored_;
    std::vector<TrendPoint> points_;
    CalibrationDate due_{};
    QLabel* says_;
    QLabel* warns_;
    QComboBox* quantity_;
    QCustomPlot* plot_;
    std::array<Lane, kLanes> lanes_{};
    QCPItemText* dueWord_ = nullptr;
    QCPItemText* todayWord_ = nullptr;
    QCPItemText* watermark_ = nullptr;
};

}  // namespace tacto::gui
