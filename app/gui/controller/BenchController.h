// BenchController.h - the window's one way to the bench: opens it, drives it, runs protocols on it, and lets displays
// look.
//
// The bench lives on a thread of its own; nothing here blocks the window. Calls are carried out in order on that
// thread; failed() reports what fails. stop() goes straight to the outputs, past every queue, and ends everything
// that was asked for before it, whether it waits, opens devices or runs: what may start output is carried out only if
// no stop came since it was asked for.
//
// A bench of simulated devices and recordings runs on the virtual clock, moved by that thread at `speed` times real
// time; one with hardware runs on the steady clock. Every opened bench records to a session file.
//
// Thread-safety: the GUI thread, but for stop(), which any thread may call.
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
    Live,     ///< a bench is open for looking and driving by hand
    Running,  ///< a protocol has it
    Closing,
};

/// The end of a stop's `by` where the operator's key is held: it was pressed before.
inline constexpr const char* kStillHeld = ", held)";

/// A pilot session and its two people.
struct PilotSeats {
    std::filesystem::path study;
    std::shared_ptr<const Secret> passphrase = {};  ///< null: a rehearsal has none
    /// Answers for both people; outlives the run. Null: the virtual participant does.
    PilotParticipant* people = nullptr;
    bool codeConfirmed = false;
    std::vector<ExclusionAnswer> exclusions = {};
    std::optional<MarkerAddress> markers = {};  ///< nothing: none are sent
    /// Called on the bench's thread, before anything is asked, with the session's clock and the number of the
    /// participant's stops in earlier parts. May be empty.
    std::function<void(std::shared_ptr<const Clock> clock, int stops)> begun = {};
    /// Whether the session took a stop as its own, which then ends no script: a test of the operator's STOP. The output
    /// is off when it returns true. Any thread; may be empty.
    std::function<bool(const char* by)> takesStop = {};
};

/// A run's end, with the reports that were written about it.
struct FinishedRun {
    std::uint64_t number = 0;  ///< the number that run() returned
    RunOrder order;
    RunResult result;
    std::filesystem::path html, pdf;        ///< empty when not written
    std::optional<Seconds> benchTime = {};  ///< how long it took on the virtual clock; nothing on the steady one
};

class BenchController final : public QObject {
    Q_OBJECT
public:
    using MakeRegistry = std::function<Registry()>;
    /// `today` as of DayNotes.
    explicit BenchController(MakeRegistry makeRegistry, QObject* parent = nullptr, std::function<QDate()> today = {});
    ~BenchController() override;  ///< outputs off, bench closed, thread joined

    [[nodiscard]] Activity activity() const noexcept { return activity_; }
    /// Null while Closed or Opening.
    [[nodiscard]] std::shared_ptr<const OpenBench> open() const { return open_; }
    /// Disconnected without a bench.
    [[nodiscard]] Telemetry telemetry() const { return published_.telemetry(); }
    /// The open device's own report in that role: losses, clock drift. Nothing where it has none.
    [[nodiscard]] std::optional<DeviceReport> deviceReport(Role role) const { return published_.deviceReport(role); }
    /// The samples, frames and trains of the open bench. Null without one; one reader, LiveHistory.
    [[nodiscard]] std::shared_ptr<BenchTap> tap() const { return tap_; }
    /// The profile in force: of the open bench, else the one of the last order or the shipped one.
    [[nodiscard]] const Profile& profile() const noexcept { return profile_; }
    [[nodiscard]] const ShippedLimits& limits() const noexcept { return limits_; }
    /// Who works here today, and on which sample: stands in every session that begins.
    [[nodiscard]] DayNotes& day() noexcept { return day_; }
    /// A run of that script, with the profile, the limits and the notes of the day as they are now.
    [[nodiscard]] RunOrder orderOf(ProtocolSource script, ProtocolDeclaration declaration,
                                   ProtocolSettings settings) const;
    /// Watches which devices are present.
    [[nodiscard]] DeviceWatch& watch() noexcept { return watch_; }
    /// Whether these are simulated devices and recordings only: nothing that can put out a current.
    /// Errors: as Registry::allVirtual().
    [[nodiscard]] Result<bool> allVirtual(const std::vector<DeviceUri>& uris) const;

    /// Opens nothing on a new day before its notes were asked for: DayNotes::asksFirst().
    void openLive(const LiveOrder& order);
    void close();
    /// The bench that a run closed, with nothing opened or closed since: openAgain() opens the same devices.
    [[nodiscard]] bool closedByRun() const noexcept { return closedByRun_.has_value(); }
    void openAgain();
    /// The text that the operator reads and confirms before this load is armed: `request.confirmed`. Empty: no bench.
    [[nodiscard]] std::string confirmationOf(const Load& load) const;
    /// The window takes two deliberate steps; `request.operatorConfirmed` says they were taken. Whatever fails leaves
    /// the bench disarmed.
    void arm(const ArmRequest& request, StopMark asked);
    void arm(const ArmRequest& request) { arm(request, mark()); }
    /// The impedance check by itself, confirmed as arming is; it always ends disarmed. checked() reports what it found.
    void checkImpedance(const ArmRequest& request, StopMark asked);
    void checkImpedance(const ArmRequest& request) { checkImpedance(request, mark()); }
    /// Disarms at once, ahead of what waits to be done; ends a running protocol.
    void disarm();
    /// A mark for an order of two steps: taken at the first, so that a stop before the second voids it.
    [[nodiscard]] StopMark mark() const noexcept { return stops_->mark(); }
    [[nodiscard]] bool stoppedSince(StopMark asked) const noexcept { return stops_->movedSince(asked); }
    /// Outputs off before this returns; any thread. Ends a running protocol too, and the opening of devices as soon as
    /// the driver that is at work returns.
    void stop(const char* by) noexcept;
    void pause() { published_.pause(); }
    void resume() { published_.resume(); }
    /// The output is held back; of a protocol: it waits, or will at its next step.
    [[nodiscard]] bool paused() const { return published_.paused(); }
    /// Marks the moment `at` of the session that is being recorded with a word, past every queue and without waiting
    /// for the disk; no output is touched. False where nothing is recorded.
    [[nodiscard]] bool markMoment(Instant at, const QString& word);
    void resetFault();
    void drive(DriveSource source, double roughness = 0, double pressure = 0);
    /// The drive that was last ordered here; telemetry says whether the bench still follows it.
    [[nodiscard]] const DriveCommand& lastDrive() const noexcept { return lastDrive_; }
    /// The command that "By hand" would ask for, as a person last set it on this bench; its source is ignored, and it
    /// orders nothing.
    void setHand(const DriveCommand& hand) { hand_ = hand; }
    [[nodiscard]] const DriveCommand& hand() const noexcept { return hand_; }
    void setProfile(const Profile& profile);
    void setSpeed(double speed);
    /// Puts a surface under a simulated finger; an empty material lifts it.
    void present(const std::string& material, double speed_mm_s, double force_n);
    /// The output is off first. loadFitted() says that the load is there; every capture after it is of that load.
    void fitLoad(const std::string& load);
    /// From now on captures come by captured(), one per trigger, until stopScope() or scopeStopped(). `single`: one,
    /// then none. `untriggeredAfter`: one also whenever no trigger has come for that long (where open()->untriggered).
    void runScope(const ScopeSettings& settings, bool single, std::optional<Seconds> untriggeredAfter = {});
    void stopScope();

    /// Closes a live bench and runs a protocol on one of its own. finished() reports every kind of end, in one step
    /// with the change to Closed: no run can begin between the two. Returns the run's number, which no other run of
    /// this controller has.
    std::uint64_t run(const RunOrder& order, StopMark asked);
    std::uint64_t run(const RunOrder& order) { return run(order, mark()); }
    /// Runs a session of a study, as runProtocol() runs a protocol.
    std::uint64_t runPilot(const RunOrder& order, const PilotSeats& seats, StopMark asked);
    [[nodiscard]] RunFeed takeRunFeed() { return feed_.take(); }
    [[nodiscard]] WindowOperator& windowOperator() noexcept { return operator_; }

signals:
    void changed();                    ///< activity, open bench or profile
    void failed(const QString& what);  ///< a sentence: what happened; the output is off or unchanged
    void armed();
    void checked(double impedance_ohm);  ///< the electrodes' impedance; NaN where the source does not measure it
    void marked(double at_s, const QString& word);
    /// The finger slides over another surface, for the window or a script. An empty material: it is lifted.
    void presented(const QString& material, double speed_mm_s, double force_n);
    void captured(std::shared_ptr<const tacto::Capture> capture);
    void loadFitted(const QString& load);
    /// The oscilloscope failed or refused its settings: no capture comes until runScope(). Half a sentence. The output
    /// is not affected. failed() reports it as well.
    void scopeStopped(const QString& why);
    void finished(std::shared_ptr<const tacto::gui::FinishedRun> run);

private:
    /// Carried out on the live bench unless a stop comes first; what fails is reported. For all that may start output.
    void order(std::function<Result<void>(Bench&)> task) { order(mark(), std::move(task)); }
    void order(StopMark asked, std::function<Result<void>(Bench&)> task);
    void tell(std::function<void()> onWindow);
    void report(const Error& error);
    /// Returns whether there is a bench that wants to be served again.
    bool serveLive();
    void serveScope();
    void scopeFailed(const Error& error);
    void openOnThread(const LiveOrder& order, StopMark asked);
    void closeOnThread();
    /// A run that was prepared: of a protocol by itself, or of a study's session.
    struct Prepared;
    using Prepare = std::function<Result<Prepared>(Registry& registry, std::shared_ptr<BenchTap> tap)>;
    [[nodiscard]] RunOrder begun(const RunOrder& order, StopMark asked);
    void runOnThread(const RunOrder& order, std::uint64_t number, const Prepare& prepare);
    /// `why`: said in the same turn of the window, so that neither is seen without the other.
    void become(Activity activity, std::shared_ptr<const OpenBench> open, std::shared_ptr<BenchTap> tap,
                const std::optional<Error>& why = std::nullopt);

    const MakeRegistry makeRegistry_;
    const std::shared_ptr<WindowHeartbeat> heartbeat_ = std::make_shared<WindowHeartbeat>();
    WindowOperator operator_;
    DeviceWatch watch_;
    DayNotes day_;

    // The window's:
    Activity activity_ = Activity::Closed;
    std::shared_ptr<const OpenBench> open_;
    std::shared_ptr<BenchTap> tap_;
    Profile profile_;
    DriveCommand lastDrive_, hand_;
    std::uint64_t lastRun_ = 0;             ///< the number of that run
    std::optional<LiveOrder> lastLive_;     ///< the order for the open bench
    std::optional<LiveOrder> closedByRun_;  ///< see closedByRun()
    ShippedLimits limits_;

    // One for this controller and all its benches.
    const std::shared_ptr<StopCounter> stops_ = std::make_shared<StopCounter>();
    PublishedBench published_;

    RunFeedCollector feed_;
    std::atomic<double> speed_{1};
    std::unique_ptr<DrivenBench> live_;  // the thread's
    TaskThread thread_;                  // last: starts when all else is ready
};

}  // namespace tacto::gui

Q_DECLARE_METATYPE(std::shared_ptr<const tacto::Capture>)
Q_DECLARE_METATYPE(std::shared_ptr<const tacto::gui::FinishedRun>)
