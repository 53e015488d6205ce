// SafetyBar.h - the bar at the top of every workspace: the interlock's state as word, shape and colour, what is
// connected, how far the output is from its limits, and STOP.
//
// In a narrow window the state's word shrinks first, then bars and facts go; STOP and the buttons stay.
#pragma once

#include <QFrame>
#include <QLabel>
#include <QPushButton>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "app/gui/calibrate/CalibrationBook.h"
#include "app/gui/controller/BenchController.h"

namespace tacto::gui {

class ConfirmButton;
class ElidedLabel;
class FaultBanner;
class LimitBarRow;
class StateBlock;
class StopButton;

/// A pause that replaces the bench's own Pause and Resume; `paused` returns true while this pause is on.
struct PauseInstead {
    std::function<void(bool pause)> pause;
    std::function<bool()> paused;
};

class SafetyBar final : public QFrame {
    Q_OBJECT
public:
    SafetyBar(BenchController& controller, const CalibrationBook& calibrations, QWidget* parent = nullptr);
    /// Called 30 times a second.
    void refresh(const Telemetry& telemetry);
    /// During a blind session hides levels and trains: a word replaces the bars, and trains make no flash.
    void setBlind(bool blind);
    /// Appends to STOP's tool tip what this display cannot report.
    void addToStopTip(const QString& sentence);
    void setParticipantsStop(const QString& words);
    /// Sets a session's own pause; nothing: uses the bench's pause.
    void setPauseInstead(std::optional<PauseInstead> instead);
    /// Does the same as the button Pause (true) or Resume (false).
    void holdOutput(bool hold);
    /// Does the same as the button Reset; the bench refuses it after a grave cause.
    void resetFault();
    /// Returns why a fault is not reset by hand; empty if it can be.
    [[nodiscard]] static QString whyNoReset(const Telemetry& telemetry);
    /// True if Pause (true) or Resume (false) would have an effect, as of the last refresh().
    [[nodiscard]] bool canHold(bool hold) const;
    /// True if no train comes until Resume.
    [[nodiscard]] bool held(InterlockState state) const;
    /// The state as shown: while blind always "armed", whether a train is being delivered or not.
    [[nodiscard]] InterlockState shownState() const { return shown_; }
    [[nodiscard]] QSize minimumSizeHint() const override;

signals:
    void armRequested();
    /// The operator's reset succeeded, no stop came since, and the output may be armed again. `drove`: what drove it
    /// when the fault came.
    void faultReset(const tacto::DriveCommand& drove);
    void detailsRequested();  ///< the user wants to see the details of a fault
    void resumed();           ///< resumed by hand

protected:
    void changeEvent(QEvent* event) override;

private:
    [[nodiscard]] QWidget* buildFacts();
    [[nodiscard]] QWidget* buildButtons();
    [[nodiscard]] QWidget* buildBlindFacts();
    void showBlind(const Telemetry& telemetry);
    void giveRoom();
    void followReset(const Telemetry& telemetry);
    void showState(const Telemetry& telemetry);
    [[nodiscard]] QString protocol() const;
    [[nodiscard]] QString closedWords() const;
    void showDevice(const Telemetry& telemetry);
    [[nodiscard]] double noteImpedance(const Telemetry& telemetry);
    void showCalibration();
    void showExposure(const Telemetry& telemetry);
    void showButtons(const Telemetry& telemetry);
    void pressAction();
    void pressPause();

    BenchController& controller_;
    const CalibrationBook& calibrations_;
    StateBlock* block_;
    QWidget* facts_ = nullptr;
    ElidedLabel* device_ = nullptr;
    ElidedLabel* load_ = nullptr;
    ElidedLabel* calibration_ = nullptr;
    LimitBarRow* bars_ = nullptr;
    FaultBanner* fault_ = nullptr;   ///< shown in place of facts and bars
    QWidget* blindFacts_ = nullptr;  ///< shown in place of the bars
    QLabel* within_ = nullptr;
    QLabel* participantsStop_ = nullptr;
    bool blind_ = false;
    QString moreOfStop_;  // text appended to STOP's tool tip
    std::optional<PauseInstead> pauseInstead_;
    bool paused_ = false;  ///< the pause state as shown
    QWidget* buttons_ = nullptr;
    ConfirmButton* action_ = nullptr;  ///< Arm…, Disarm or Reset…
    ConfirmButton* pause_ = nullptr;
    QPushButton* details_ = nullptr;  ///< shown instead of pause_ while faulted
    StopButton* stop_ = nullptr;
    double measured_ohm_ = NAN;  ///< |Z| as last measured on this bench, in ohms
    double measuredAt_s_ = NAN;  ///< time of that measurement on the bench's clock
    std::weak_ptr<BenchTap> measuredOn_;
    std::uint64_t trainsSeen_ = 0;
    std::uint64_t refusalsSeen_ = 0;
    bool refused_ = false;  // the newest train was refused
    bool factsFit_ = true;
    int pulse_ = 0;  ///< frames left of the flash for the last train
    std::optional<StopMark> resetAsked_;
    std::uint64_t causesShown_ = 0;
    DriveCommand drove_;  // as of the last refresh without a fault
    InterlockState state_ = InterlockState::Disconnected;
    InterlockState shown_ = InterlockState::Disconnected;
};

}  // namespace tacto::gui
