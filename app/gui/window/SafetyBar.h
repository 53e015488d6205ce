// SafetyBar.h - the bar that is visible in every workspace: the interlock in word, shape and colour, what is connected,
// how far the output is from its limits, and STOP.
//
// Where there is little room, the state's word shrinks first, then bars and facts go; STOP and the buttons stay.
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

/// The actions of Pause and Resume in place of the bench's own, and whether it is paused so.
struct PauseInstead {
    std::function<void(bool pause)> pause;
    std::function<bool()> paused;
};

class SafetyBar final : public QFrame {
    Q_OBJECT
public:
    SafetyBar(BenchController& controller, const CalibrationBook& calibrations, QWidget* parent = nullptr);
    /// Thirty times a second.
    void refresh(const Telemetry& telemetry);
    /// During a blind session nothing here shows levels or trains: a word in place of the bars, no pulse with trains.
    void setBlind(bool blind);
    /// Adds to STOP's tool tip what this display does not tell.
    void addToStopTip(const QString& sentence);
    void setParticipantsStop(const QString& words);
    /// Whether a session pauses by itself. Nothing: the bench's own pause counts.
    void setPauseInstead(std::optional<PauseInstead> instead);
    /// Does what the button Pause or Resume does.
    void holdOutput(bool hold);
    /// Whether Pause (true) or Resume (false) would do something, as of the last refresh().
    [[nodiscard]] bool canHold(bool hold) const;
    /// Whether no train comes until Resume.
    [[nodiscard]] bool held(InterlockState state) const;
    /// The state as the bar shows it: while blind, as armed whether or not a train is delivered.
    [[nodiscard]] InterlockState shownState() const { return shown_; }
    [[nodiscard]] QSize minimumSizeHint() const override;

signals:
    void armRequested();
    void detailsRequested();  ///< the details of a fault are asked for
    void resumed();           ///< by hand

protected:
    void changeEvent(QEvent* event) override;

private:
    [[nodiscard]] QWidget* buildFacts();
    [[nodiscard]] QWidget* buildButtons();
    [[nodiscard]] QWidget* buildBlindFacts();
    void showBlind(const Telemetry& telemetry);
    void giveRoom();
    void showState(const Telemetry& telemetry);
    [[nodiscard]] QString protocol() const;
    [[nodiscard]] QString closedWords() const;
    void showDevice(const Telemetry& telemetry);
    [[nodiscard]] double noteImpedance(const Telemetry& telemetry);
    void showCalibration();
    void showExposure(const Telemetry& telemetry);
    void showButtons(InterlockState state);
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
    QString moreOfStop_;  // the rest of STOP's tip
    std::optional<PauseInstead> pauseInstead_;
    bool paused_ = false;  ///< as shown
    QWidget* buttons_ = nullptr;
    ConfirmButton* action_ = nullptr;  ///< Arm…, Disarm, Reset…
    ConfirmButton* pause_ = nullptr;
    QPushButton* details_ = nullptr;  ///< shown in its place while faulted
    StopButton* stop_ = nullptr;
    double measured_ohm_ = NAN;  ///< |Z| as last measured on this bench
    double measuredAt_s_ = NAN;  ///< when it was measured, on the bench's clock
    std::weak_ptr<BenchTap> measuredOn_;
    std::uint64_t trainsSeen_ = 0;
    std::uint64_t refusalsSeen_ = 0;
    bool refused_ = false;  // the newest train was refused
    bool factsFit_ = true;
    int pulse_ = 0;  ///< frames left of the flash that goes with each train
    InterlockState state_ = InterlockState::Disconnected;
    InterlockState shown_ = InterlockState::Disconnected;
};

}  // namespace tacto::gui
