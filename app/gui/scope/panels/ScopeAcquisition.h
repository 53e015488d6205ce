// ScopeAcquisition.h - decides when the oscilloscope takes captures of the open bench, and with which trigger: four
// modes, run and hold. "Hold" freezes the picture and does not affect the output: only STOP does.
#pragma once

#include <QElapsedTimer>
#include <QObject>
#include <filesystem>

#include "app/gui/controller/BenchController.h"
#include "app/gui/scope/model/ScopeModel.h"
#include "app/gui/scope/model/Trace.h"
#include "app/gui/scope/panels/AcquisitionPanel.h"

namespace tacto::gui {

enum class ScopeMode {
    Auto,    ///< the level follows the commanded amplitude; takes untriggered captures if no trigger comes
    Normal,  ///< the user sets the level
    Single,  ///< take one capture, then hold
    Roll,    ///< shows captures one after the other on the session's time
};

class ScopeAcquisition final : public QObject {
    Q_OBJECT
public:
    /// Both arguments outlive this.
    ScopeAcquisition(BenchController& controller, AcquisitionPanel& panel);

    [[nodiscard]] ScopeMode mode() const noexcept { return mode_; }
    /// Sets the mode without starting to run.
    void setMode(ScopeMode mode);
    /// True if the level follows the amplitude and the user cannot set it.
    [[nodiscard]] bool levelFollows() const { return freeRuns() && !searched(panel_.trigger().kind); }
    /// True if the latest telemetry says that trains are being delivered, also between two trains.
    [[nodiscard]] bool delivering() const noexcept { return telemetry_.state == InterlockState::Delivering; }
    [[nodiscard]] bool running() const noexcept { return running_; }
    /// True if a bench with an oscilloscope is open and no protocol uses the oscilloscope.
    [[nodiscard]] bool possible() const;
    void run();
    void hold();
    /// Runs again as soon as possible, because the reason for holding is gone.
    void wantAgain() { wanted_ = true; }
    /// Runs if wanted and if the captures are seen somewhere. Returns true if an earlier failure is over.
    bool benchChanged(bool seen);
    /// Captures that show nothing but an untriggered signal are taken only while something shows them.
    void setSeen(bool seen);
    void settingsChanged();
    void refresh(const Telemetry& telemetry);
    /// Notes a measured capture of the bench. False: it was taken before the user pressed Hold, and must not be shown.
    bool take(const ShownCapture& shown);
    /// The settings of the running capture, as the user chose them.
    [[nodiscard]] const ScopeSettings& requestedSettings() const noexcept { return requested_; }
    [[nodiscard]] const SampleTrigger& requestedTrigger() const noexcept { return trigger_; }
    /// What the running capture waits for: "at 5.00 V", "on slope through -2.00 V".
    [[nodiscard]] QString triggerText() const;
    /// The state as a sentence, for the time while `shown` is on the screen.
    [[nodiscard]] QString statusText(const ShownCapture* shown, std::uint64_t skipped) const;

signals:
    /// The oscilloscope's settings changed: the next capture does not follow the previous one.
    void requested();
    /// The oscilloscope failed. `problem` says why, and what that means for the output.
    void stopped(const QString& problem);

private:
    /// True if there is a picture without a trigger, too.
    [[nodiscard]] bool freeRuns() const noexcept { return mode_ == ScopeMode::Auto || mode_ == ScopeMode::Roll; }
    void request();
    void followAmplitude();
    void fail(const QString& why);
    [[nodiscard]] std::optional<Seconds> untriggeredAfter() const;
    [[nodiscard]] QString runningText(const ShownCapture* shown, std::uint64_t skipped) const;
    [[nodiscard]] bool awaitsTrigger() const;
    [[nodiscard]] QString outputText() const;

    BenchController& controller_;
    AcquisitionPanel& panel_;
    ScopeMode mode_ = ScopeMode::Auto;
    bool wanted_ = true;  ///< runs as soon as a bench is open
    bool running_ = false;
    bool seen_ = true;
    bool failed_ = false;  ///< the oscilloscope stopped by itself and waits until the user runs it again
    Telemetry telemetry_;
    ScopeSettings requested_;
    SampleTrigger trigger_;
    std::optional<Seconds> requestedWait_;
    QElapsedTimer sinceRequest_;
    QElapsedTimer sinceCapture_;
    int taken_ = 0;
};

/// Chooses the captures for the screen: from the open bench's session or from a file. The bench's last train stays on
/// the screen while the output is off.
class ScopeFeed {
public:
    enum class Taken {
        Nothing,   ///< not shown: no longer wanted
        Held,      ///< not shown: it has nothing new, and the present capture stays
        Shown,     ///< shown as the next capture of the same source
        ShownAnew  ///< shown as the first capture of another source: counts start again
    };

    /// Both arguments outlive this.
    ScopeFeed(ScopeModel& model, ScopeAcquisition& acquisition) : model_(model), acquisition_(acquisition) {}

    /// Sets the session of the open bench; empty: no bench is open. Returns true if the session is a new one: the marks
    /// and a shown file are then removed from the screen.
    [[nodiscard]] bool begin(const std::filesystem::path& session);
    /// The session of the bench that was open last.
    [[nodiscard]] const std::filesystem::path& session() const noexcept { return session_; }

    /// Shows a capture, unless it is no longer wanted or the last train stays. Zooms to the first train.
    [[nodiscard]] Taken take(const ShownPtr& shown);

private:
    [[nodiscard]] bool staysBefore(const ShownCapture& next) const;

    ScopeModel& model_;
    ScopeAcquisition& acquisition_;
    std::filesystem::path session_;
    bool framed_ = false;  // the view was zoomed to the session's first train
};

}  // namespace tacto::gui
