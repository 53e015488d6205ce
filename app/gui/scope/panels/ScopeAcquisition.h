// ScopeAcquisition.h - when the oscilloscope takes captures of the open bench, and with which trigger: the four modes,
// run and hold. "Hold" keeps the picture and touches no output: only STOP does that.
#pragma once

#include <QElapsedTimer>
#include <QObject>
#include <filesystem>

#include "app/gui/controller/BenchController.h"
#include "app/gui/scope/model/ScopeModel.h"
#include "app/gui/scope/model/Trace.h"

namespace tacto::gui {

class AcquisitionPanel;

enum class ScopeMode {
    Auto,    ///< the level follows the commanded amplitude; untriggered when no trigger comes
    Normal,  ///< the level is the user's
    Single,  ///< take one capture, then hold
    Roll,    ///< captures one after the other on the session's time
};

class ScopeAcquisition final : public QObject {
    Q_OBJECT
public:
    /// Both arguments outlive this.
    ScopeAcquisition(BenchController& controller, AcquisitionPanel& panel);

    [[nodiscard]] ScopeMode mode() const noexcept { return mode_; }
    /// Does not begin to run.
    void setMode(ScopeMode mode);
    /// The level is not the user's to set.
    [[nodiscard]] bool levelFollows() const noexcept { return mode_ == ScopeMode::Auto || mode_ == ScopeMode::Roll; }
    /// Whether telemetry last said so: trains are on their way, also between two of them.
    [[nodiscard]] bool delivering() const noexcept { return telemetry_.state == InterlockState::Delivering; }
    [[nodiscard]] bool running() const noexcept { return running_; }
    /// Whether a bench is open with an oscilloscope that no protocol uses.
    [[nodiscard]] bool possible() const;
    void run();
    void hold();
    /// Runs as soon as it may, as at first: what held it is over.
    void wantAgain() { wanted_ = true; }
    /// Runs if it should and somewhere the captures are seen. Returns whether an earlier failure is over.
    bool benchChanged(bool seen);
    void settingsChanged();
    void refresh(const Telemetry& telemetry);
    /// A capture of the bench was measured. False: it was under way when the picture was held, and is not shown.
    bool take(const ShownCapture& shown);
    /// The settings of the running capture.
    [[nodiscard]] const ScopeSettings& requestedSettings() const noexcept { return requested_; }
    /// Its state in a sentence, while `shown` is on the screen.
    [[nodiscard]] QString statusText(const ShownCapture* shown, std::uint64_t skipped) const;

signals:
    /// The oscilloscope was set again: what it takes from now on does not follow on what it took.
    void requested();
    /// The oscilloscope failed; why, and what that means for the output.
    void stopped(const QString& problem);

private:
    void request();
    void followAmplitude();
    void fail(const QString& why);
    [[nodiscard]] std::optional<Seconds> untriggeredAfter() const;
    [[nodiscard]] QString runningText(const ShownCapture* shown, std::uint64_t skipped) const;
    [[nodiscard]] QString outputText() const;

    BenchController& controller_;
    AcquisitionPanel& panel_;
    ScopeMode mode_ = ScopeMode::Auto;
    bool wanted_ = true;  ///< runs as soon as there is a bench
    bool running_ = false;
    bool failed_ = false;  ///< the oscilloscope stopped by itself; until the user lets it run again
    Telemetry telemetry_;
    ScopeSettings requested_;
    std::optional<Seconds> requestedWait_;
    QElapsedTimer sinceRequest_;
    QElapsedTimer sinceCapture_;
    int taken_ = 0;
};

/// Chooses the captures for the screen: the bench's, from the open session, or those of a file; and the bench's last
/// train, which stays while the output is off.
class ScopeFeed {
public:
    enum class Taken {
        Nothing,   ///< nobody asked for it any more
        Held,      ///< the shown capture stays: this one would say nothing
        Shown,     ///< one more of its source is shown
        ShownAnew  ///< the first of another source: what was counted is over
    };

    /// Both arguments outlive it.
    ScopeFeed(ScopeModel& model, ScopeAcquisition& acquisition) : model_(model), acquisition_(acquisition) {}

    /// The bench's session is `session`; empty: none is open. Returns whether captures of another one come from now on:
    /// then marks, and a file that was looked at, are gone from the screen.
    [[nodiscard]] bool begin(const std::filesystem::path& session);
    /// The session of the bench that was open last.
    [[nodiscard]] const std::filesystem::path& session() const noexcept { return session_; }

    /// Shows it, unless it was not asked for or the last train stays. Its first train is framed.
    [[nodiscard]] Taken take(const ShownPtr& shown);

private:
    [[nodiscard]] bool staysBefore(const ShownCapture& next) const;

    ScopeModel& model_;
    ScopeAcquisition& acquisition_;
    std::filesystem::path session_;
    bool framed_ = false;  // the first train of it was
};

}  // namespace tacto::gui
