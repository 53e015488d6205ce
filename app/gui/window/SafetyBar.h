// SafetyBar.h - always there, in every workspace: the interlock in word, shape and colour, what is connected, how far
// the output is from its limits, and STOP.
//
// Where there is little room the state's word gets smaller first, then bars and facts go; STOP and the buttons stay.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QFrame>
#include <QLabel>
#include <QPushButton>
#include <vector>

#include "app/gui/calibrate/CalibrationBook.h"
#include "app/gui/desk/BenchDesk.h"

namespace tacto::gui {

class ConfirmButton;
class ElidedLabel;
class LimitBarRow;
class StateBlock;
class StopButton;

class SafetyBar final : public QFrame {
    Q_OBJECT
public:
    SafetyBar(BenchDesk& desk, const CalibrationBook& calibrations, QWidget* parent = nullptr);
    /// Thirty times a second.
    void refresh(const Telemetry& telemetry);
    [[nodiscard]] QSize minimumSizeHint() const override;

signals:
    void armRequested();

protected:
    void changeEvent(QEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;

private:
    [[nodiscard]] QWidget* buildFacts();
    [[nodiscard]] QWidget* buildButtons();
    void giveRoom();
    void showState(const Telemetry& telemetry);
    void showDevice(const Telemetry& telemetry);
    void showCalibration();
    void showExposure(const Telemetry& telemetry);
    void showButtons(InterlockState state);
    void pressAction();
    void pressPause();

    BenchDesk& desk_;
    const CalibrationBook& calibrations_;
    StateBlock* block_;
    QWidget* facts_ = nullptr;
    ElidedLabel* device_ = nullptr;
    ElidedLabel* load_ = nullptr;
    ElidedLabel* calibration_ = nullptr;
    LimitBarRow* bars_ = nullptr;
    QWidget* buttons_ = nullptr;
    ConfirmButton* action_ = nullptr;  ///< Arm…, Disarm, Reset…
    ConfirmButton* pause_ = nullptr;
    StopButton* stop_ = nullptr;
    std::uint64_t trainsSeen_ = 0;
    int pulse_ = 0;  ///< frames left of the flash that goes with each train
    InterlockState state_ = InterlockState::Disconnected;
};

}  // namespace tacto::gui
