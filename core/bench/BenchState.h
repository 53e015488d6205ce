// BenchState.h - what a bench is made of. Private to core/bench: Bench.cpp runs it, BenchArming.cpp takes it through
// arming, faults and their end.
//
// Thread-safety: as Bench.h says of the calls that use it.
#pragma once

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <mutex>

#include "core/bench/Bench.h"
#include "core/bench/DeviceThread.h"
#include "core/bench/MassagerSession.h"
#include "core/bench/ReportRecord.h"
#include "core/bench/ScopeSession.h"
#include "core/safety/Heartbeat.h"
#include "core/safety/SafetyGate.h"
#include "core/safety/UnitRecord.h"
#include "core/session/SessionWriter.h"

namespace tacto {

/// What it encodes for: without a stimulator for display alone.
[[nodiscard]] SourceTraits traitsOf(const DeviceSet& devices);

struct Bench::State {
    BenchConfig config;
    VirtualClock* virtualClock = nullptr;  // null on the steady clock
    SourceTraits source;
    KnownLines applied;                  // config.calibration, or nothing while it is left aside
    std::unique_ptr<UnitRecord> record;  // of the stimulator, where one is kept; outlives those that write into it
    SafetyGate gate;
    Interlock interlock;
    Heartbeat heartbeat;
    std::unique_ptr<SessionRecorder> recorder;
    std::unique_ptr<StimulatorSession> stimulator;
    std::unique_ptr<MassagerSession> massager;  // only without a stimulator: one output at a time
    std::unique_ptr<SensorSession> sensor;
    std::unique_ptr<ScopeSession> scope;
    std::unique_ptr<ControlLoop> loop;

    std::shared_ptr<StopCounter> stops;
    std::atomic<StopMark> order;  // the operator's, for which everything is done: see begin()
    std::atomic<bool> paused{false};
    std::mutex waitMutex;
    std::condition_variable waitChanged;  // a stop, a pause or its end
    void (*progress)(void*) = nullptr;
    void* progressContext = nullptr;
    std::atomic<DriveSource> driving{DriveSource::Off};
    std::atomic<bool> heartbeatWithheld{false};  // steady clock: the loop's thread does nothing
    std::uint64_t refusalsSeen = 0;              // by the caller of drive(), wait() and capture()

    // Virtual clock only:
    Instant nextTick{0};
    Instant outputDue{0};

    // Steady clock only. Last: they end first.
    std::unique_ptr<DeviceThread> outputThread, sensorThread, scopeThread, loopThread;

    explicit State(BenchConfig given)
        : config(std::move(given)),
          virtualClock(dynamic_cast<VirtualClock*>(config.clock.get())),
          source(traitsOf(config.devices)),
          applied(config.calibrationHolds ? config.calibration : std::nullopt),
          gate(*config.clock),
          stops(config.stops ? config.stops : std::make_shared<StopCounter>()),
          order(config.stops ? config.asked : stops->mark()) {}

    ~State() {
        off("the bench closes");
        loopThread.reset();
        heartbeat.end();
        off("the bench closes");  // whatever the loop's last step may have handed over
        scopeThread.reset();
        sensorThread.reset();
        outputThread.reset();
        outputsOff();
        if (loop) loop->noteState(config.clock->now());
        if (recorder && stimulator && stimulator->longestKeepAliveGap() > Instant(0)) {
            recorder->event(config.clock->now(), "keep-alive",
                            {{"longest_gap_s", toSeconds(stimulator->longestKeepAliveGap())}},
                            "the longest time between two keep-alives of the stimulator's dead-man switch");
        }
        if (const auto* reporting = recorder ? reportingDevice(Role::Sensor) : nullptr) {
            recordReport(*recorder, config.clock->now(), reporting->deviceReport(),
                         "what the fingertip sensor and its line were like, when the bench closed");
        }
        const bool recorded = recorder != nullptr;
        recorder.reset();
        if (recorded && loop) noteMarks();
    }

    /// A stop has come since the operator gave the order that is carried out now.
    [[nodiscard]] bool stopped() const noexcept { return stops->movedSince(order.load(std::memory_order_acquire)); }
    [[nodiscard]] const ReportingDevice* reportingDevice(Role role) const noexcept {
        const auto& devices = config.devices;
        const Device* device = role == Role::Sensor         ? static_cast<const Device*>(devices.sensor.get())
                               : role == Role::Stimulator   ? static_cast<const Device*>(devices.stimulator.get())
                               : role == Role::Oscilloscope ? static_cast<const Device*>(devices.oscilloscope.get())
                                                            : static_cast<const Device*>(devices.massager.get());
        return dynamic_cast<const ReportingDevice*>(device);
    }

    void outputsOff() noexcept {
        if (stimulator) stimulator->forceOff();
        if (massager)
            massager->forceOff();
        else if (config.devices.massager)
            config.devices.massager->forceOff();
    }
    /// Virtual clock: whichever output there is.
    Instant serveOutput(Instant now) noexcept { return stimulator ? stimulator->serve(now) : massager->serve(now); }
    [[nodiscard]] bool hasOutput() const noexcept { return stimulator || massager; }
    [[nodiscard]] bool outputBusy() const noexcept {
        return (stimulator && !stimulator->idle()) || (massager && !massager->idle());
    }

    /// Disarmed first: see ControlLoop::mayPost().
    void off(const char* why) noexcept {
        interlock.disarm(why);
        gate.latchStop();
        outputsOff();
        if (loop) loop->drive({});
        driving.store(DriveSource::Off, std::memory_order_release);
    }

    [[nodiscard]] Result<std::unique_ptr<FingerInput>> makeFinger(const Profile& profile) {
        if (!sensor) return std::unique_ptr<FingerInput>();
        return FingerInput::create(*sensor, profile.roughness);
    }
    [[nodiscard]] std::unique_ptr<TrainPlanner> makePlanner(const Profile& profile) {
        return std::make_unique<TrainPlanner>(profile.encoding, source, gate, applied);
    }

    [[nodiscard]] Result<void> open();
    void startThreads();
    void turn(Instant until) noexcept;
    [[nodiscard]] Result<void> letReportsBeJudged();
    template <class Done>
    [[nodiscard]] Result<bool> advance(Instant until, Done done);
    [[nodiscard]] Result<void> rest();
    void attend(Seconds within) noexcept {
        if (!config.watched || config.watched()) loop->attend(config.clock->now() + toInstant(within));
    }
    [[nodiscard]] Result<void> health() const;
    template <class Session>
    [[nodiscard]] Result<void> askAgain(Session& session, DeviceThread* thread, Instant within, const char* who);
    /// A train driven by hand was refused since the caller last heard of one.
    [[nodiscard]] bool refusedByHand() const noexcept {
        return driving.load(std::memory_order_acquire) == DriveSource::Manual && loop->refusals() != refusalsSeen;
    }
    [[nodiscard]] Result<void> refusal() {
        refusalsSeen = loop->refusals();
        return fail(ErrorCode::LimitExceeded, "{}", loop->telemetry().lastRefusal.view());
    }
    [[nodiscard]] Result<void> takeUpRecord();
    void noteCalibration();
    void noteMarks() const noexcept;
    [[nodiscard]] bool hasCalibration() const noexcept { return config.calibration && config.calibrationHolds; }
    [[nodiscard]] Result<void> noteProfile(const Profile& next) const;
    [[nodiscard]] Result<void> noteArming(const ArmRequest& request, const GateSetup& setup) const;
    Result<void> calibrationToday() const;
    [[nodiscard]] GateSetup setupFor(const Load& load) const;
    [[nodiscard]] const Device* outputDevice() const noexcept {
        if (config.devices.stimulator) return config.devices.stimulator.get();
        return config.devices.massager.get();
    }
    [[nodiscard]] std::string armingText(const Load& load) const;
    [[nodiscard]] Result<void> confirmedAsShown(const ArmRequest& request, const Load& load) const;
    [[nodiscard]] Result<void> lookAtCheck(const ArmCommand& command);
    /// Hands over what the oscilloscope showed of the check pulse; true when it was handed over.
    [[nodiscard]] bool passOnCheck(const PulseTrain& check);
    [[nodiscard]] ArmCommand armCommandFor(const ArmRequest& request, const Load& load) const;
};

/// Lets time pass until `done()` or `until`; the value says whether it was done. Errors: as health().
template <class Done>
Result<bool> Bench::State::advance(Instant until, Done done) {
    constexpr Instant kLook = std::chrono::milliseconds(2);
    for (std::uint64_t turns = 0;; ++turns) {
        if (const auto well = health(); !well) return failure(well);
        attend(kAttended);
        if (done()) return true;
        if (config.clock->now() >= until) return false;
        if (progress != nullptr && turns % 64 == 0) progress(progressContext);
        if (virtualClock != nullptr) {
            std::unique_lock lock(waitMutex);
            waitChanged.wait(lock, [this] { return !paused || stopped(); });
            lock.unlock();
            turn(until);
        } else {
            std::unique_lock lock(waitMutex);
            waitChanged.wait_for(lock, std::min(kLook, until - config.clock->now()), [this] { return stopped(); });
        }
    }
}

}  // namespace tacto
