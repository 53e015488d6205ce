// SafetyBar.h - always there, in every workspace: the interlock in word, shape and colour, what is connected, how far
// the output is from its limits, and STOP.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QFrame>
#include <QLabel>
#include <QPushButton>
#include <vector>

#include "app/gui/calibrate/CalibrationBook.h"
#include "app/gui/desk/BenchDesk.h"
#include "app/gui/window/LimitBar.h"

namespace tacto::gui {

class SafetyBar final : public QFrame {
    Q_OBJECT
public:
    SafetyBar(BenchDesk& desk, const CalibrationBook& calibrations, QWidget* parent = nullptr);
    /// Thirty times a second.
    void refresh(const Telemetry& telemetry);

signals:
    void armRequested();

protected:
    void changeEvent(QEvent* event) override;

private:
    void colourStop();
    void showState(const Telemetry& telemetry);
    void showDevice(const Telemetry& telemetry);
    void showCalibration();
    void showExposure(const Telemetry& telemetry);
    void showButtons(InterlockState state);
    void pressAction();

    BenchDesk& desk_;
    const CalibrationBook& calibrations_;
    QLabel* shape_;
    QLabel* word_;
    QLabel* reason_;
    QLabel* device_;
    QLabel* load_;
    QLabel* calibration_;
    QPushButton* action_;  ///< Arm…, Disarm, Reset…
    QPushButton* pause_;
    QPushButton* stop_ = nullptr;
    struct Shown {
        LimitBar* bar;
        std::vector<Quantity> quantities;  ///< none: the measured net charge
    };
    std::vector<Shown> bars_;
    std::uint64_t trainsSeen_ = 0;
    int pulse_ = 0;  ///< frames left of the flash that goes with each train
    InterlockState state_ = InterlockState::Disconnected;
};

}  // namespace tacto::gui
