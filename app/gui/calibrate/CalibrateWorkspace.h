// CalibrateWorkspace.h - the stimulator's calibration: how it stands, the guided run, a check of what is stored, and
// everything that was stored before; and the fingertip sensor's. The runs are ProtocolWorkspace's.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QTabWidget>
#include <QWidget>
#include <array>

#include "app/gui/calibrate/CalibrationBook.h"

namespace tacto::gui {

class CalibrationCard;
class CalibrationHistory;
class ProtocolWorkspace;

class CalibrateWorkspace final : public QWidget {
    Q_OBJECT
public:
    CalibrateWorkspace(BenchDesk& desk, CalibrationBook& book, QWidget* parent = nullptr);
    [[nodiscard]] ProtocolWorkspace& runner() noexcept { return *runner_; }
    /// The stimulator's and the sensor's.
    [[nodiscard]] std::array<ProtocolWorkspace*, 2> runners() const noexcept { return {runner_, sensor_}; }

private:
    void run(const QString& mode);
    void showReady();
    BenchDesk& desk_;
    CalibrationBook& book_;
    CalibrationCard* card_;
    QTabWidget* tabs_;
    ProtocolWorkspace* runner_;
    ProtocolWorkspace* sensor_;
    CalibrationHistory* history_;
};

}  // namespace tacto::gui
