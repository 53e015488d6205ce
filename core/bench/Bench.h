// Bench.h - the running bench: reads the sensors, encodes, has every train judged, drives the stimulator,
// watches its answers, captures what came out, records all of it.
//
// On the virtual clock wait(), capture() and arm() run the control loop on the caller's thread and time
// moves only inside them. On the steady clock the loop and one session thread per device run by
// themselves and the same calls wait. The step code is the same.
//
// Every call that starts output is done for an order of the operator, which begin() names by the moment at which it was
// given. A stop ends that order for good; only an order from after the stop runs.
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
#include "core/measure/Capture.h"
#include "core/safety/Interlock.h"
#include "core/safety/StopCounter.h"
#include "core/safety/UnitRecord.h"

namespace tacto {

class SessionWriter;
class SystemTime;

struct BenchConfig {
    DeviceSet devices;
    std::shared_ptr<Clock> clock;  ///< a VirtualClock makes the bench step itself
    Profile profile;
    std::vector<LimitSet> limits;
    OutputMode mode = OutputMode::BenchLoad;
    std::optional<PersonSetup> person;  ///< required in person mode
    /// Whom `person` describes: a virtual participant, who is refused on any device that is not simulated, or a human
    /// being, who is refused on a simulated one outside a rehearsal.
    bool virtualParticipant = false;
    bool rehearsal = false;
    SessionWriter* session = nullptr;  ///< not owned; where null, nothing is recorded
    BenchTap* tap = nullptr;           ///< not owned; where null, nothing is shown
    /// The last known calibration of the stimulator. The gate judges by it in any case; a stimulator that is out of
    /// order by it is not armed.
    KnownLines calibration;
    bool calibrationHolds = true;  ///< applied to every train; without it commands go out as they are, and to no person
    std::string calibrationText;   ///< what the session says of the calibration, or of having none; empty: nothing
    /// The last day on which it holds: later nothing is armed for a person, however long the bench has been open.
    std::optional<std::chrono::sys_days> calibratedUntil;
    std::chrono::sys_days (*today)() = nullptr;  ///< UTC; null asks the system
    /// The counter of the stops that end the orders of this bench; null: its own. `asked` is when the operator asked
    /// for the bench, and its first order; without `stops` that is now.
    std::shared_ptr<StopCounter> stops;
    StopMark asked = {};
    /// Whether the operator can reach the stop now (the window runs); empty: always. While it says no, nothing counts
    /// as looking after the output: see Bench::attend(). Called from any thread; does not block.
    std::function<bool()> watched;
    /// Where the exposure and the faults of units are kept (UnitRecord.h): a stimulator continues from there, and other
    /// processes cannot use it meanwhile. Where empty, nothing is kept; a simulated stimulator never has one.
    UnitFolders units;
    const SystemTime* systemTime = nullptr;  ///< the record's clock; null: the system's own. Outlives the bench
};

/// The operator's statements when arming.
struct ArmRequest {
    std::string load = "1 kohm";         ///< declared load, as parseLoad() reads it (bench loads)
    bool declaredLoadConfirmed = false;  ///< the operator's word, where the device cannot read back
    bool operatorConfirmed = false;      ///< deliberate: not a default button, not a key that repeats
    /// The text that the operator was shown and confirmed: armingText() of the load. Where the output is real, nothing
    /// else confirms it; for a simulated one it may be empty.
    std::string confirmed{};
};

/// The highest level that is permitted at all.
struct PermittedLevel {
    Milliamps level{0};     ///< 0: none is
    std::string limitedBy;  ///< one phrase: "commanded voltage (paper)", "the study's cap", "the device's largest", ...
};

class Bench {
public:
    /// Errors: of the profile and the devices; Device when another process drives the stimulator; Io when its record
    /// cannot be kept or the session not be written.
    [[nodiscard]] static Result<std::unique_ptr<Bench>> create(BenchConfig config);
    ~Bench();  ///< outputs off, threads joined

    /// The order for which everything is done from now on; the operator gave it at `asked`, a mark of stops().
    /// Errors: Stopped when a stop has come since. Then the bench keeps its order from before.
    [[nodiscard]] Result<void> begin(StopMark asked);
    /// The counter that stop() raises.
    [[nodiscard]] StopCounter& stops() noexcept;

    /// Disarmed → Checking (one small pulse) → Armed. Where the stimulator does not read back and an oscilloscope is
    /// open, that has to show the pulse, within 20 %, and a load in the declared range; it replaces a request for
    /// captures. Errors: NotArmed with what is missing; LimitExceeded; Device; Stopped.
    [[nodiscard]] Result<void> arm(const ArmRequest& request);
    /// Checks the load in the same way, and always disarms the bench afterwards. Nothing but the check pulse is
    /// delivered. The value is |Z|, or nothing where the stimulator does not read back. Errors: as arm().
    [[nodiscard]] Result<std::optional<Ohms>> checkImpedance(const ArmRequest& request);
    /// The text that the operator confirms before this load is armed. See core/bench/arming/CommandPreview.h.
    [[nodiscard]] std::string armingText(const Load& load) const;
    /// Whether arming would arm a device and not a simulation: then arm() takes no request without its text.
    [[nodiscard]] bool outputIsReal() const noexcept;
    /// Ends output and goes to Disarmed (a fault stays). Never fails.
    void disarm() noexcept;
    /// Output off, every approval void, Disarmed, and every waiting call returns Stopped until begin() names an order
    /// from after it. Bypasses every queue.
    void stop(const char* by) noexcept;
    void pause() noexcept;
    void resume() noexcept;
    /// Notes in the session that the operator marked the moment `at` with a word. Touches no output, and waits for no
    /// disk. False where nothing is recorded.
    [[nodiscard]] bool markMoment(Instant at, std::string word);
    /// Leaves Faulted. A device that was unplugged is looked for again, by identity, which may take two seconds.
    /// Errors: NotArmed while the cause persists.
    [[nodiscard]] Result<void> resetFault();

    /// Whether `cause` is among those of the present fault.
    [[nodiscard]] bool faultPersists(FaultCause cause) const noexcept;
    /// The same as Interlock::faultCode(). Any thread.
    [[nodiscard]] ErrorCode faultCode() const noexcept;

    /// Lets `duration` pass without the control loop, as in a hang, on purpose: the dead-man check of a bench load
    /// needs that. The device threads continue, and end the output when they notice; the loop then finds a fault.
    /// Errors: Unsupported outside bench loads; InvalidArgument unless above 0 and at most 10 s; Stopped.
    [[nodiscard]] Result<void> withholdHeartbeat(Seconds duration);
    /// How long the loop had been silent when the stimulator was switched off for it; nothing if that never happened.
    [[nodiscard]] std::optional<Seconds> silencedAfter() const noexcept;
    /// Records of the session that were lost because the disk was too slow. Any thread.
    [[nodiscard]] std::uint64_t recordsLost() const noexcept;

    /// Tells the control loop that the script or window that ordered the output still runs. Without another call
    /// `within` that time the loop ends driven output as by a stop (hazard H2). begin(), drive() and every function
    /// that waits call it. Any thread.
    void attend(Seconds within = kAttended) noexcept;
    static constexpr Seconds kAttended{2};

    /// Sets what drives the encoder from the next train on. `roughness` and `pressure` (0..1) serve Manual only.
    /// Errors: InvalidArgument outside 0..1 or NaN; Unsupported for Sensor without a sensor; Stopped, unless Off.
    [[nodiscard]] Result<void> drive(DriveSource source, double roughness = 0, double pressure = 0);
    /// One presentation, in the kind of train that the profile describes: waits for its end. Every train
    /// is approved by the gate, delivered, read back and judged as any other. Where the last impedance reading would be
    /// more than 5 s old by the last onset, one check pulse comes first, also before an empty one.
    /// Nothing else may drive the output. A stop, a pause or a fault ends it (see Presented::end) and makes it void.
    /// `passing` is called repeatedly, on the caller's thread, with the time since it began and when that was, for a
    /// screen to show. It depends on nothing else, least of all on when a train comes. May be empty.
    /// Errors, with which nothing was begun: InvalidArgument as validate(), and for a current that is not on the
    /// device's grid; Unsupported where the output takes no such level; NotArmed unless armed; Stopped; Device; Io.
    [[nodiscard]] Result<Presented> present(const Presentation& presentation,
                                            const std::function<void(Seconds since, Instant began)>& passing = {});

    /// The participant accepted the level that was presented last: without it the next may not rise (hazard H6).
    /// Recorded as `level-accepted`. Errors: InvalidArgument unless the last presentation was complete, not empty and
    /// at this level; NotArmed outside person mode; LimitExceeded as SafetyGate::accept(); Io.
    [[nodiscard]] Result<void> accept(const StimulusLevel& level);
    /// The participant called this level too strong: from now on nothing exceeds it, also when the bench is armed
    /// again. Passed to the gate before it is recorded as `level-too-strong`; also after a stop. Errors:
    /// InvalidArgument unless finite and ≥ 0, and an intensity at most 1; Unsupported for a level that the output does
    /// not take; NotArmed outside person mode; Io, when it holds all the same.
    [[nodiscard]] Result<void> reportDiscomfort(const StimulusLevel& level);
    /// A series of ascending limits: its ceiling is its own last accepted level plus one step. Errors: NotArmed outside
    /// person mode.
    [[nodiscard]] Result<void> beginAscending();
    [[nodiscard]] Result<void> endAscending();
    /// The highest level that a presentation may have now: the ramp, what was too strong, the cap. Errors: NotArmed
    /// outside person mode, and before it was armed.
    [[nodiscard]] Result<StimulusLevel> levelCeiling();
    /// The highest level of the device's grid that the limits, the cap and the discomfort limit permit at `interval` on
    /// the last measured impedance, whatever was accepted; and what stands against the next one. Errors: NotArmed
    /// outside person mode, and where no impedance is known.
    [[nodiscard]] Result<PermittedLevel> levelLimit(Seconds interval) const;

    /// Replaces the profile at the next step of the loop. While armed only its `roughness` section may change.
    /// Errors: NotArmed for another change while armed; InvalidArgument for a profile that is not valid.
    /// `before`: what R was shown for until now; see the session's marks.
    [[nodiscard]] Result<void> setProfile(const Profile& profile, RBefore before = RBefore::Shown);
    /// The calibration that is applied now.
    [[nodiscard]] const KnownLines& calibration() const noexcept;
    /// Leaves the stimulator's calibration aside, or takes it up again: a new one must see the stimulator as it is.
    /// Errors: NotArmed unless disarmed.
    [[nodiscard]] Result<void> useCalibration(bool use);
    [[nodiscard]] const Profile& profile() const noexcept;
    [[nodiscard]] const std::vector<LimitSet>& limits() const noexcept;
    /// The setup that the gate receives when this load is armed: for previews.
    [[nodiscard]] GateSetup setupFor(const Load& load) const;

    /// Lets `duration` pass on the bench's clock. Errors: Stopped; Device after a fault, Timeout where lateness caused
    /// it; Device when the sensor that drives failed; LimitExceeded when a manually driven train was refused (driven by
    /// a sensor it is skipped and counted).
    [[nodiscard]] Result<void> wait(Seconds duration);
    /// Lets time pass as wait() does, but also after a stop or a fault: a display continues when output does not. Never
    /// fails. For a bench whose virtual clock has no other mover.
    void idle(Seconds duration) noexcept;
    /// Arms the oscilloscope and returns the captures of the next `trains` trains. Errors: Unsupported without an
    /// oscilloscope; Timeout when fewer came; as wait().
    [[nodiscard]] Result<std::vector<Capture>> capture(int trains, const ScopeSettings& settings);
    /// capture() in two halves, for a caller that goes on meanwhile: the next `trains` triggers, whenever they come.
    /// A new request replaces one that is under way. With `untriggeredAfter` a record comes untriggered (and is marked
    /// so) whenever no trigger has come for that long; capture() never takes one.
    /// Errors: Unsupported, also where the oscilloscope takes no record without a trigger; InvalidArgument for the
    /// number or the wait.
    [[nodiscard]] Result<void> requestCaptures(int trains, const ScopeSettings& settings,
                                               std::optional<Seconds> untriggeredAfter = {});
    /// Whether requestCaptures() may be asked for untriggered records.
    [[nodiscard]] bool canCaptureUntriggered() const noexcept;
    /// The captures of a request so far, or why the oscilloscope failed. Empties it.
    [[nodiscard]] Result<std::vector<Capture>> takeCaptures();
    void cancelCaptures() noexcept;
    /// Also pushes the sensor's samples into `tap`, not owned, until null is passed; for a caller that wants them
    /// itself and takes them between waits. On return nothing is pushed into the earlier tap.
    void listen(BenchTap* tap);
    /// True when a replayed sensor has no more samples.
    [[nodiscard]] bool sensorFinished() const noexcept;

    /// The largest exposure since begin(), row by row. Any thread.
    [[nodiscard]] WorstExposure worstExposure() const noexcept;
    [[nodiscard]] Telemetry telemetry() const;
    /// Faults since the bench was made. Any thread.
    [[nodiscard]] std::uint64_t faults() const noexcept;
    /// The device's own report in that role; nothing where there is no device, or it reports nothing. Any thread.
    [[nodiscard]] std::optional<DeviceReport> deviceReport(Role role) const noexcept;
    [[nodiscard]] DeviceSet& devices() noexcept;
    [[nodiscard]] OutputMode mode() const noexcept;
    [[nodiscard]] const Clock& clock() const noexcept;
    /// Asked in loops of waiting calls; lets a script host report progress. May be null.
    void onProgress(void (*callback)(void* context), void* context) noexcept;

private:
    struct State;
    explicit Bench(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace tacto
