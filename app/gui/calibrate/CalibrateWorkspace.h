// CalibrateWorkspace.h - the stimulator's guided calibration or a check of the stored one, the fingertip sensor's
// calibration, the stored calibration's state today, and earlier ones. ProtocolWorkspace does the runs.
#pragma once

#include <QWidget>
#include <array>

#include "app/gui/calibrate/CalibrationBook.h"

namespace tacto::gui {

class CalibrationCard;
class CalibrationHistory;
class ProtocolWorkspace;
class TabbedPage;

class CalibrateWorkspace final : public QWidget {
    Q_OBJECT
public:
    CalibrateWorkspace(BenchController& controller, CalibrationBook& book, QWidget* parent = nullptr);
    [[nodiscard]] ProtocolWorkspace& runner() noexcept { return *runner_; }
    /// Returns the workspaces that calibrate the stimulator and the sensor.
    [[nodiscard]] std::array<ProtocolWorkspace*, 2> runners() const noexcept { return {runner_, sensor_}; }
    /// Hides the row of tabs; their keyboard shortcuts still work.
    void showPlotOnly(bool only);

private:
    enum Tab { kGuided, kFingertip, kOverTime };
    /// Builds the page with the state of the stored calibration and with earlier calibrations.
    [[nodiscard]] QWidget* buildStored(QWidget* in);
    void prepare(const QString& mode);
    void showReady();
    BenchController& controller_;
    CalibrationBook& book_;
    CalibrationCard* card_;
    TabbedPage* tabs_;
    ProtocolWorkspace* runner_;
    ProtocolWorkspace* sensor_;
    CalibrationHistory* history_;
};

}  // namespace tacto::gui
