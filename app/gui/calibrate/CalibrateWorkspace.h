// CalibrateWorkspace.h - the stimulator's calibration: the guided run, or a check of what is stored; the fingertip
// sensor's; how the stored one stands today, and what was stored before. The runs are ProtocolWorkspace's.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QTabWidget>
#include <QWidget>
#include <array>

#include "app/gui/calibrate/CalibrationBook.h"
#include "app/gui/theme/TabKeys.h"

namespace tacto::gui {

class CalibrationCard;
class CalibrationHistory;
class ProtocolWorkspace;

class CalibrateWorkspace final : public QWidget {
    Q_OBJECT
public:
    CalibrateWorkspace(BenchController& controller, CalibrationBook& book, QWidget* parent = nullptr);
    [[nodiscard]] ProtocolWorkspace& runner() noexcept { return *runner_; }
    /// The stimulator's and the sensor's.
    [[nodiscard]] std::array<ProtocolWorkspace*, 2> runners() const noexcept { return {runner_, sensor_}; }
    /// Without the row of tabs; their keys work.
    void showPlotOnly(bool only);

private:
    void prepare(const QString& mode);
    void showReady();
    BenchController& controller_;
    CalibrationBook& book_;
    CalibrationCard* card_;
    QTabWidget* tabs_;
    ProtocolWorkspace* runner_;
    ProtocolWorkspace* sensor_;
    CalibrationHistory* history_;
    TabKeys tabKeys_{*this, [this](int page) { tabs_->setCurrentIndex(page); }};
    QWidget* stored_;  ///< its page, with the card above
};

}  // namespace tacto::gui
