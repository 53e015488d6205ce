// BenchController.h - the window's only access to the bench: opens and drives the bench, runs protocols on it, and
// provides data for displays.
//
// The bench lives on its own thread; no call blocks the window. Calls are carried out in order on that thread; failed()
// reports failures. stop() switches the outputs off directly, bypassing every queue, and ends everything requested
// before it, whether waiting, opening devices or running: an action that may start output is carried out only if no
// stop came after its request.
//
// A bench of simulated devices and recordings runs on the virtual clock, which that thread moves at `speed` times real
// time; a bench with hardware runs on the steady clock. Every open bench records to a session file.
//
// Thread-safety: the GUI thread, except stop(), which any thread may call.
#pragma once

#include <QObject>
#include <QString>
#include <atomic>
#include <functional>
#include <memory>
#include <optional>

#include "app/gui/controller/DayNotes.h"
#include "app/gui/controller/DeviceWatch.h"
#include "app/gui/controller/OpenBench.h"
#include "app/gui/controller/PublishedBench.h"
#include "app/gui/controller/RunFeed.h"
#include "app/gui/controller/TaskThread.h"
#include "app/gui/controller/WindowOperator.h"
#include "app/run/PilotRun.h"
#include "app/run/ProtocolRun.h"
#include "core/bench/sensing/BenchTap.h"

namespace tacto::gui {

class DrivenBench;

enum class Activity {
    Closed,  ///< no bench
    Opening,
    Live,     ///< a bench is open for viewing and for driving by hand
    Running,  ///< a protocol uses the bench
    Closing,
};

/// Suffix of a stop's `by` if the operator's key was pressed earlier and is still held.
inline constexpr const char* kStillHeld = ", held)";

/// A pilot session's study and the two people who take part.
struct PilotSeats {
    std::filesystem::path study;
    std::shared_ptr<const Secret> passphrase = {};  ///< null for a rehearsal
    /// Answers for both people; must outlive the run. Null: the virtual participant answers.
    PilotParticipant* people = nullptr;
    bool codeConfirmed = false;
    std::vector<ExclusionAnswer> exclusions = {};
    std::optional<MarkerAddress> markers = {};  ///< nothing: no markers are sent
    PilotParticipant* watch = nullptr;          ///< as PilotOrder::watch
    double pace = 0;                            ///< as PilotOrder::pace
    /// Called on the bench's thread before any question, with the session's clock and the number of the participant's
    /// stops in earlier parts. May be empty.
    std::function<void(std::shared_ptr<const Clock> clock, int stops)> begun = {};
    /// Returns true, with the output off, if the session handled a stop itself as a test of the operator's STOP; such a
    /// stop ends no script. Any thread; may be empty.
    std::function<bool(const char* by)> takesStop = {};
};

/// The end of a run, with the reports written about it.
struct FinishedRun {
    std::uint64_t number = 0;  ///< the number that run() returned
    RunOrder order;
    RunResult result;
    std::filesystem::path html, pdf;        ///< empty if not written
    std::optional<Seconds> benchTime = {};  ///< duration on the virtual clock; nothing on the steady clock
};

class BenchController final : public QObject {
    Q_OBJECT
public:
    using MakeRegistry = std::function<Registry()>;
    /// `today`: as for DayNotes.
    explicit BenchController(MakeRegistry makeRegistry, QObject* parent = nullptr, std::function<QDate()> today = {});
    ~BenchController() override;  ///< switches outputs off, closes the bench, joins the thread

    [[nodiscard]] Activity activity() const noexcept { return activity_; }
    /// Null while Closed or Opening.
    [[nodiscard]] std::shared_ptr<const OpenBench> open() const { return open_; }
    /// Disconnected if there is no bench.
    [[nodiscard]] Telemetry telemetry() const { return published_.telemetry(); }
    /// Returns the open device's own report in that role: losses, clock drift. Nothing if the device has none.
    [[nodiscard]] std::optional<DeviceReport> deviceReport(Role role) const { return published_.deviceReport(role); }
    /// Returns the samples, frames and trains of the open bench; null if none. Only LiveHistory may read the tap.
    [[nodiscard]] std::shared_ptr<BenchTap> tap() const { return tap_; }
    /// Returns the profile in force: the open bench's, otherwise that of the last order, or the shipped one.
    [[nodiscard]] const Profile& profile() const noexcept { return profile_; }
    [[nodiscard]] const ShippedLimits& limits() const noexcept { return limits_; }
    /// Returns who works here today and on which sample; written into every session that begins.
    [[nodiscard]] DayNotes& day() noexcept { return day_; }
    /// Returns a run of that script, with the present profile, limits and notes of the day.
    [[nodiscard]] RunOrder orderOf(ProtocolSource script, ProtocolDeclaration declaration,
                                   ProtocolSettings settings) const;
    /// Watches which devices are present.
    [[nodiscard]] DeviceWatch& watch() noexcept { return watch_; }
    /// Returns true if all devices are simulated or recordings, which cannot put out a current. Errors: as
    /// Registry::allVirtual().
    [[nodiscard]] Result<bool> allVirtual(const std::vector<DeviceUri>& uris) const;

    /// Opens nothing on a new day until its notes have been asked for: DayNotes::asksFirst().
    void openLive(const LiveOrder& order);
    void close();
    /// True if a run closed the bench and nothing was opened or closed since: openAgain() opens the same devices.
    [[nodiscard]] bool closedByRun() const noexcept { return closedByRun_.has_value(); }
    void openAgain();
    /// Returns the addresses with which the bench under Live was opened last; empty: none was.
    [[nodiscard]] std::vector<DeviceUri> liveDevices() const {
        return lastLive_ ? lastLive_->uris : std::vector<DeviceUri>();
    }
    /// Returns the text that the operator confirms before this load is armed (`request.confirmed`). Empty: no bench.
    [[nodiscard]] std::string confirmationOf(const Load& load) const;
    /// Arms the bench. The window takes two deliberate steps; `request.operatorConfirmed` says that both were taken.
    /// After any failure the bench is disarmed.
    void arm(const ArmRequest& request, StopMark asked);
    void arm(const ArmRequest& request) { arm(request, mark()); }
    /// Only checks the impedance, confirmed like arming; always ends disarmed. checked() reports the result.
    void checkImpedance(const ArmRequest& request, StopMark asked);
    void checkImpedance(const ArmRequest& request) { checkImpedance(request, mark()); }
    /// Disarms at once, ahead of all waiting tasks; ends a running protocol.
    void disarm();
    /// Returns a mark, taken at the first of an order's two steps: a stop before the second step voids the order.
    [[nodiscard]] StopMark mark() const noexcept { return stops_->mark(); }
    [[nodiscard]] bool stoppedSince(StopMark asked) const noexcept { return stops_->movedSince(asked); }
    /// Switches the outputs off before it returns; any thread. Also ends a running protocol, and ends the opening of
    /// devices as soon as the present driver call returns.
    void stop(const char* by) noexcept;
    void pause() { published_.pause(); }
    void resume() { published_.resume(); }
    /// True if the output is held back; a protocol then waits, or will at its next step.
    [[nodiscard]] bool paused() const { return published_.paused(); }
    /// Marks the time `at` of the session being recorded with a word, bypassing every queue and without waiting for the
    /// disk; touches no output. Returns false if nothing is recorded.
    [[nodiscard]] bool markMoment(Instant at, const QString& word);
    /// `known`: as Bench::resetFault().
    void resetFault(std::optional<std::uint64_t> known = {});
    void drive(DriveSource source, double roughness = 0, double pressure = 0);
    /// Returns the drive last ordered here; telemetry says whether the bench still follows that order.
    [[nodiscard]] const DriveCommand& lastDrive() const noexcept { return lastDrive_; }
    /// Sets the command that "By hand" would ask for, as last set by a person on this bench. The source in `hand` is
    /// ignored, and nothing is ordered.
    void setHand(const DriveCommand& hand) { hand_ = hand; }
    [[nodiscard]] const DriveCommand& hand() const noexcept { return hand_; }
    void setProfile(const Profile& profile);
    void setSpeed(double speed);
    /// Puts a surface under a simulated finger; an empty material lifts the finger.
    void present(const std::string& material, double speed_mm_s, double force_n);
    /// Switches the output off, then fits the load. After loadFitted() every capture shows that load.
    void fitLoad(const std::string& load);
    /// Starts captures: captured() reports one per trigger, until stopScope() or scopeStopped(). `single`: one only.
    /// `untriggeredAfter`: also captures whenever no trigger comes for that long (if open()->untriggered).
    void runScope(const ScopeSettings& settings, bool single, std::optional<Seconds> untriggeredAfter = {});
    void stopScope();

    /// Closes a live bench and runs a protocol on a bench of its own. finished() reports every kind of end together
    /// with the change to Closed: no run can begin between the two. Returns the run's number, unique in this
    /// controller.
    std::uint64_t run(const RunOrder& order, StopMark asked);
    std::uint64_t run(const RunOrder& order) { return run(order, mark()); }
    /// Runs a session of a study, like run() for a protocol.
    std::uint64_t runPilot(const RunOrder& order, const PilotSeats& seats, StopMark asked);
    [[nodiscard]] RunFeed takeRunFeed() { return feed_.take(); }
    [[nodiscard]] WindowOperator& windowOperator() noexcept { return operator_; }

signals:
    void changed();                    ///< activity, open bench or profile changed
    void failed(const QString& what);  ///< a sentence that says what happened; the output is off or unchanged
    void armed();
    void checked(double impedance_ohm);  ///< the electrodes' impedance; NaN if the stimulator does not measure it
    void marked(double at_s, const QString& word);
    /// The window or a script put another surface under the finger. Empty material: the finger is lifted.
    void presented(const QString& material, double speed_mm_s, double force_n);
    void captured(std::shared_ptr<const tacto::Capture> capture);
    void loadFitted(const QString& load);
    /// The oscilloscope failed or refused its settings: no capture comes until runScope(). `why`: half a sentence. The
    /// output is not affected. failed() reports it too.
    void scopeStopped(const QString& why);
    void finished(std::shared_ptr<const tacto::gui::FinishedRun> run);

private:
    /// Carries out `task` on the live bench unless a stop comes first; reports failures. For all that may start output.
    void order(std::function<Result<void>(Bench&)> task) { order(mark(), std::move(task)); }
    void order(StopMark asked, std::function<Result<void>(Bench&)> task);
    void tell(std::function<void()> onWindow);
    void report(const Error& error);
    /// Returns true if a bench is open that needs to be served again.
    bool serveLive();
    void serveScope();
    void scopeFailed(const Error& error);
    void openOnThread(const LiveOrder& order, StopMark asked);
    void closeOnThread();
    /// A prepared run of a protocol or of a study's session.
    struct Prepared;
    /// `found`: the fault that refused the run, if one did.
    using Prepare = std::function<Result<Prepared>(Registry& registry, std::shared_ptr<BenchTap> tap,
                                                   std::optional<LeftFault>& found)>;
    [[nodiscard]] RunOrder begun(const RunOrder& order, StopMark asked);
    void runOnThread(const RunOrder& order, std::uint64_t number, const Prepare& prepare);
    /// `why`: emitted by failed() in the same event as the change, so that both are seen together.
    void become(Activity activity, std::shared_ptr<const OpenBench> open, std::shared_ptr<BenchTap> tap,
                const std::optional<Error>& why = std::nullopt);

    const MakeRegistry makeRegistry_;
    const std::shared_ptr<WindowHeartbeat> heartbeat_ = std::make_shared<WindowHeartbeat>();
    WindowOperator operator_;
    DeviceWatch watch_;
    DayNotes day_;

    // Used by the GUI thread only:
    Activity activity_ = Activity::Closed;
    std::shared_ptr<const OpenBench> open_;
    std::shared_ptr<BenchTap> tap_;
    Profile profile_;
    DriveCommand lastDrive_, hand_;
    std::uint64_t lastRun_ = 0;             ///< the number of the last run
    std::optional<LiveOrder> lastLive_;     ///< the order for the open bench
    std::optional<LiveOrder> closedByRun_;  ///< see closedByRun()
    ShippedLimits limits_;

    // One counter for this controller and all its benches.
    const std::shared_ptr<StopCounter> stops_ = std::make_shared<StopCounter>();
    PublishedBench published_;

    RunFeedCollector feed_;
    std::atomic<double> speed_{1};
    std::unique_ptr<DrivenBench> live_;  // used by the bench's thread only
    TaskThread thread_;                  // declared last: starts when all else is ready
};

}  // namespace tacto::gui

Q_DECLARE_METATYPE(std::shared_ptr<const tacto::Capture>)
Q_DECLARE_METATYPE(std::shared_ptr<const tacto::gui::FinishedRun>)
