// Bench.h - the running bench: reads the sensors, encodes, has the gate judge every train, drives the stimulator,
// watches its answers, captures the output and records everything.
//
// On the virtual clock, wait(), capture() and arm() run the control loop on the caller's thread, and time moves only
// inside these calls. On the steady clock, the loop and each device have a thread of their own, and the same calls
// wait. The step code is the same.
//
// Every call that starts output belongs to an order of the operator. begin() identifies the order by the moment at
// which it was given. A stop ends that order for good; only an order given after the stop runs.
//
// Thread-safety: stop(), pause(), resume(), markMoment(), stops(), telemetry() and deviceReport() from any thread;
// everything else has one caller (a script's thread, or the program).
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/bench/ControlLoop.h"
#include "core/bench/Profile.h"
#include "core/bench/Telemetry.h"
#include "core/bench/delivery/Presentation.h"
#include "core/devices/DeviceSet.h"
#include "core/devices/EncoderLoader.h"
#include "core/measure/Capture.h"
#include "core/safety/Interlock.h"
#include "core/safety/StopCounter.h"
#include "core/safety/UnitRecord.h"

namespace tacto {

class SessionWriter;
class SystemTime;

struct BenchConfig {
    DeviceSet devices;
    std::shared_ptr<Clock> clock;  ///< with a VirtualClock the bench steps itself
    Profile profile;
    std::vector<LimitSet> limits;
    OutputMode mode = OutputMode::BenchLoad;
    std::optional<PersonSetup> person;  ///< required in person mode
    /// True: `person` is a virtual participant, who is refused on any real device. False: a human being, who is refused
    /// on a simulated device outside a rehearsal.
    bool virtualParticipant = false;
    bool rehearsal = false;
    SessionWriter* session = nullptr;  ///< not owned; if null, nothing is recorded
    BenchTap* tap = nullptr;           ///< not owned; if null, nothing is shown
    /// The last known calibration of the stimulator. The gate always uses it; if it shows that the stimulator is out of
    /// order, the stimulator is not armed.
    KnownLines calibration;
    bool calibrationHolds = true;  ///< applied to every train; if false, commands go out uncorrected, and to no person
    std::string calibrationText;   ///< the session's note on the calibration, or on having none; empty: no note
    /// The calibration's last valid day: afterwards nothing is armed for a person, even on a bench that stays open.
    std::optional<std::chrono::sys_days> calibratedUntil;
    std::chrono::sys_days (*today)() = nullptr;  ///< UTC; null asks the system
    /// Counts the stops that end this bench's orders; null: the bench has its own counter. `asked` is when the operator
    /// asked for the bench and gave the first order; without `stops` that is now.
    std::shared_ptr<StopCounter> stops;
    StopMark asked = {};
    /// True if the operator can reach the stop now (the window runs); empty: always. While it returns false,
    /// Bench::attend() does nothing. Called from any thread; does not block.
    std::function<bool()> watched;
    /// Where the exposure and faults of units are kept (UnitRecord.h); empty: nowhere. A stimulator continues from its
    /// record, and no other process can use it meanwhile. A simulated stimulator never has a record.
    UnitFolders units;
    /// Returns the profile that the board of `devices.sensor` must have to encode (EncodingSensor.h): of this profile,
    /// stimulator and load. Empty: no board drives. Errors: what of them a board cannot do.
    std::function<Result<BoardProfile>(const TactileSensor&, const Profile&, const GateSetup&)> boardProfile;
    const SystemTime* systemTime = nullptr;  ///< the unit record's clock; null: the system's clock. Outlives the bench
};

/// The operator's statements when arming.
struct ArmRequest {
    std::string load = "1 kohm";         ///< the declared load, in the form that parseLoad() reads (bench loads)
    bool declaredLoadConfirmed = false;  ///< the operator's word, needed if the device cannot read back
    bool operatorConfirmed = false;      ///< a deliberate act: not a default button or a repeating key
    /// The text that the operator was shown and confirmed: armingText() of the load. Required for real output; may be
    /// empty for simulated output.
    std::string confirmed{};
};

/// The highest level that the limits permit.
struct PermittedLevel {
    Milliamps level{0};     ///< 0: no level is permitted
    std::string limitedBy;  ///< one phrase: "commanded voltage (paper)", "the study's cap", "the device's largest", ...
};

class Bench {
public:
    /// Errors: as the profile and the devices; Device if another process drives the stimulator; Io if the stimulator's
    /// record cannot be kept or the session cannot be written.
    [[nodiscard]] static Result<std::unique_ptr<Bench>> create(BenchConfig config);
    ~Bench();  ///< switches outputs off and ends the threads

    /// Starts the order to which all later calls belong; the operator gave it at `asked`, a mark of stops().
    /// Errors: Stopped if a stop has come since `asked`; the bench then keeps its earlier order.
    [[nodiscard]] Result<void> begin(StopMark asked);
    /// The counter that stop() raises.
    [[nodiscard]] StopCounter& stops() noexcept;

    /// Disarmed → Checking (one small pulse) → Armed. If the stimulator does not read back and an oscilloscope is
    /// open, the capture must show the pulse, within 20 %, and a load in the declared range; it replaces a request
    /// for captures. A board whose encoder takes a profile (EncoderLoader.h) is first given this bench's, for this
    /// load. Errors: NotArmed with what is missing, and if the fingertip drives and its board encodes by another
    /// profile; LimitExceeded; Device; Stopped.
    [[nodiscard]] Result<void> arm(const ArmRequest& request);
    /// Checks the load as arm() does, and always disarms afterwards. Only the check pulse is delivered. Returns |Z|,
    /// or nothing if the stimulator does not read back. Errors: as arm().
    [[nodiscard]] Result<std::optional<Ohms>> checkImpedance(const ArmRequest& request);
    /// Returns the text that the operator confirms before this load is armed. See core/bench/arming/CommandPreview.h.
    [[nodiscard]] std::string armingText(const Load& load) const;
    /// True if arm() would arm a real device; arm() then refuses a request without the confirmed text.
    [[nodiscard]] bool outputIsReal() const noexcept;
    /// Ends output and goes to Disarmed; a fault stays. Never fails.
    void disarm() noexcept;
    /// Switches output off, voids every approval and disarms. Waiting calls return Stopped until begin() names an
    /// order given after this stop. Bypasses every queue.
    void stop(const char* by) noexcept;
    void pause() noexcept;
    void resume() noexcept;
    /// Notes in the session that the operator marked the moment `at` with a word. Does not affect output or wait for
    /// the disk. False if nothing is recorded.
    [[nodiscard]] bool markMoment(Instant at, std::string word);
    /// Leaves Faulted. Searches again, by identity, for a device that was unplugged, which may take two seconds.
    /// `known`: Telemetry::causesCame as the operator saw it; without it, all causes until this call are known.
    /// Errors: NotArmed while the cause of the fault persists, if a cause came that is not known, and for an operator
    /// after a grave cause. What a safety check resets stays in the unit's record until that is cleared.
    [[nodiscard]] Result<void> resetFault(std::optional<std::uint64_t> known = {}, ResetBy by = ResetBy::Operator);
    /// See Interlock::unitFault(). Any thread.
    [[nodiscard]] std::optional<UnitFault> unitFault() const noexcept;

    /// True if `cause` is one of the causes of the present fault.
    [[nodiscard]] bool faultPersists(FaultCause cause) const noexcept;
    /// See Interlock::faultCode(). Any thread.
    [[nodiscard]] ErrorCode faultCode() const noexcept;

    /// Deliberately lets `duration` pass without the control loop, as in a hang: the dead-man check of a bench load
    /// needs this. The device threads notice the silence and end the output; the loop then finds a fault.
    /// Errors: Unsupported outside bench loads; InvalidArgument unless above 0 and at most 10 s; Stopped.
    [[nodiscard]] Result<void> withholdHeartbeat(Seconds duration);
    /// Returns how long the loop had been silent when that switched the stimulator off; nothing if it never did.
    [[nodiscard]] std::optional<Seconds> silencedAfter() const noexcept;
    /// Number of session records lost because the disk was too slow. Any thread.
    [[nodiscard]] std::uint64_t recordsLost() const noexcept;

    /// Tells the control loop that the script or window that ordered the output still runs. Without a further call
    /// `within` that time, the loop ends driven output as a stop does (hazard H2). begin(), drive() and every function
    /// that waits call attend(). Any thread.
    void attend(Seconds within = kAttended) noexcept;
    static constexpr Seconds kAttended{2};

    /// Sets the source that drives the encoder from the next train on. `roughness`, `pressure` (0..1): Manual only.
    /// Errors: InvalidArgument outside 0..1 or NaN; Unsupported for Sensor without a sensor; NotArmed for Sensor while
    /// armed if its board encodes by another profile than this bench's; Stopped, unless Off.
    [[nodiscard]] Result<void> drive(DriveSource source, double roughness = 0, double pressure = 0);
    /// Makes one presentation with the profile's kind of train and waits for its end. Every train is approved by the
    /// gate, delivered, read back and judged as usual. If the last impedance reading would be more than 5 s old by the
    /// last onset, one check pulse comes first, even before an empty presentation. Nothing else may drive the output.
    /// A stop, pause or fault ends the presentation (see Presented::end) and makes it void. `passing` may be empty; for
    /// a screen, it is called repeatedly on the caller's thread with the time since the beginning and the moment of the
    /// beginning. Its calls do not depend on when trains come. Errors (nothing was begun): InvalidArgument as
    /// validate(), and for a current off the device's grid; Unsupported if the output takes no such level; NotArmed
    /// unless armed; Stopped; Device; Io.
    [[nodiscard]] Result<Presented> present(const Presentation& presentation,
                                            const std::function<void(Seconds since, Instant began)>& passing = {});

    /// Notes that the participant accepted the last level presented; otherwise the next may not rise (hazard H6).
    /// Recorded as `level-accepted`. Errors: InvalidArgument unless the last presentation was complete, not empty and
    /// at this level; NotArmed outside person mode; LimitExceeded as SafetyGate::accept(); Io.
    [[nodiscard]] Result<void> accept(const StimulusLevel& level);
    /// Notes that the participant called this level too strong: no level exceeds it from now on, even after arming
    /// again. Tells the gate before recording `level-too-strong`; also works after a stop. Errors: InvalidArgument
    /// unless finite and ≥ 0, and an intensity at most 1; Unsupported for a level that the output does not take;
    /// NotArmed outside person mode; Io, in which case the new limit still applies.
    [[nodiscard]] Result<void> reportDiscomfort(const StimulusLevel& level);
    /// Begins a series of ascending limits: its ceiling is one step above the last level accepted in the series.
    /// Errors: NotArmed outside person mode.
    [[nodiscard]] Result<void> beginAscending();
    [[nodiscard]] Result<void> endAscending();
    /// Returns the highest level that a presentation may have now, as limited by the ramp, the levels that were too
    /// strong and the cap. Errors: NotArmed outside person mode, and before the first arming.
    [[nodiscard]] Result<StimulusLevel> levelCeiling();
    /// Returns the highest level on the device's grid that the limits, the cap and the discomfort limit permit at
    /// `interval` and the last measured impedance, regardless of accepted levels, and what forbids the next level.
    /// Errors: NotArmed outside person mode, and if no impedance is known.
    [[nodiscard]] Result<PermittedLevel> levelLimit(Seconds interval) const;

    /// Replaces the profile at the next step of the loop. While armed, only its `roughness` section may change, and
    /// nothing where the fingertip's board encodes. Errors: NotArmed for any other change while armed; InvalidArgument
    /// for a profile that is not valid. `before`: the purpose for which R was shown until now (see RBefore).
    [[nodiscard]] Result<void> setProfile(const Profile& profile, RBefore before = RBefore::Shown);
    /// The calibration that is applied now.
    [[nodiscard]] const KnownLines& calibration() const noexcept;
    /// Stops or resumes applying the stimulator's calibration: a new one must measure the uncorrected stimulator.
    /// Errors: NotArmed unless disarmed.
    [[nodiscard]] Result<void> useCalibration(bool use);
    [[nodiscard]] const Profile& profile() const noexcept;
    [[nodiscard]] const std::vector<LimitSet>& limits() const noexcept;
    /// The setup that the gate would receive if this load were armed; for previews.
    [[nodiscard]] GateSetup setupFor(const Load& load) const;

    /// Lets `duration` pass on the bench's clock. Errors: Stopped; Device after a fault, Timeout if lateness caused the
    /// fault; Device if the driving sensor failed; LimitExceeded if a manually driven train was refused (a refused
    /// sensor-driven train is only skipped and counted).
    [[nodiscard]] Result<void> wait(Seconds duration);
    /// Lets time pass as wait() does, but also after a stop or fault, so that a display continues without output.
    /// Never fails. For a bench on a virtual clock that nothing else moves.
    void idle(Seconds duration) noexcept;
    /// Arms the oscilloscope and returns the captures of the next `trains` trains. Errors: Unsupported without an
    /// oscilloscope; Timeout if fewer captures came; as wait().
    [[nodiscard]] Result<std::vector<Capture>> capture(int trains, const ScopeSettings& settings);
    /// Like capture(), but returns at once; takeCaptures() then fetches the records of the next `trains` triggers. A
    /// new request replaces a pending one. With `untriggeredAfter`, a record is taken untriggered (and marked so)
    /// whenever no trigger has come for that long; capture() never takes such a record.
    /// Errors: Unsupported, also if the oscilloscope takes no untriggered record; InvalidArgument for the number or the
    /// wait.
    [[nodiscard]] Result<void> requestCaptures(int trains, const ScopeSettings& settings,
                                               std::optional<Seconds> untriggeredAfter = {});
    /// True if requestCaptures() accepts `untriggeredAfter`.
    [[nodiscard]] bool canCaptureUntriggered() const noexcept;
    /// Takes out the captures made so far for a request, or returns why the oscilloscope failed.
    [[nodiscard]] Result<std::vector<Capture>> takeCaptures();
    void cancelCaptures() noexcept;
    /// Also pushes the sensor's samples into `tap` (not owned) until null is passed; for a caller that takes them
    /// between waits. On return nothing is pushed into the earlier tap.
    void listen(BenchTap* tap);
    /// True if a replayed sensor has no more samples.
    [[nodiscard]] bool sensorFinished() const noexcept;

    /// The largest exposure since begin(), row by row. Any thread.
    [[nodiscard]] WorstExposure worstExposure() const noexcept;
    [[nodiscard]] Telemetry telemetry() const;
    /// Number of faults since the bench was made. Any thread.
    [[nodiscard]] std::uint64_t faults() const noexcept;
    /// Returns that device's own report; nothing if there is no such device or it reports nothing. Any thread.
    [[nodiscard]] std::optional<DeviceReport> deviceReport(Role role) const noexcept;
    [[nodiscard]] DeviceSet& devices() noexcept;
    [[nodiscard]] OutputMode mode() const noexcept;
    [[nodiscard]] const Clock& clock() const noexcept;
    /// Sets a callback that waiting calls make repeatedly, so that a script host can report progress. May be null.
    void onProgress(void (*callback)(void* context), void* context) noexcept;

private:
    struct State;
    explicit Bench(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace tacto
