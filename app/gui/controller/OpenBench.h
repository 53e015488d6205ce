// OpenBench.h - what to open, and what is open then.
//
// Thread-safety: values; a DrivenBench one thread, the controller's, but for bench().stop() and telemetry(), see
// Bench.h.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <vector>

#include "app/run/OpenedBench.h"
#include "core/devices/Registry.h"

namespace tacto::gui {

/// What to open for looking, driving by hand and replaying.
struct LiveOrder {
    std::vector<DeviceUri> uris;
    /// What the bench must have; sim: fills the roles that no other device fills.
    std::set<Role> needed{Role::Sensor, Role::Stimulator, Role::Oscilloscope};
    Profile profile;
    double speed = 1;  ///< times real time; devices that can live on the virtual clock only
    std::uint64_t seed = 1;
    RunNotes notes = {};  ///< the session's; the controller fills them in from the day's
};

/// Constant while it is open.
struct OpenBench {
    SessionAbout about;
    std::filesystem::path session;
    std::vector<StreamInfo> streams;       ///< the sensor's; empty without one
    std::optional<DeviceIdentity> output;  ///< what arming arms: the stimulator, else the massager
    std::optional<SourceTraits> source;
    std::optional<ScopeTraits> scope;
    bool paced = false;        ///< runs on the virtual clock, where `speed` means something
    bool surfaces = false;     ///< the rig presents surfaces by itself
    bool untriggered = false;  ///< the oscilloscope can take a record without a trigger
    [[nodiscard]] bool simulated() const { return about.simulated; }
};

[[nodiscard]] std::shared_ptr<const OpenBench> describeBench(const OpenedBench& opened);

/// A bench that is open for looking and driving by hand: its devices, clock and session file, and the
/// captures that its oscilloscope takes.
class DrivenBench {
public:
    struct Conditions {
        const ShippedLimits& limits;
        std::shared_ptr<StopCounter> stops;
        StopMark asked;
        std::function<bool()> watched;
    };
    /// Opens the devices; a stop since `asked` ends the opening as soon as the driver at work returns. The session
    /// records from here on. Devices of simulation and recordings only run on the virtual clock.
    [[nodiscard]] static Result<std::unique_ptr<DrivenBench>> open(Registry& registry, const LiveOrder& order,
                                                                   const Conditions& conditions);

    [[nodiscard]] Bench& bench() noexcept { return *opened_->bench; }
    [[nodiscard]] const std::shared_ptr<const OpenBench>& about() const noexcept { return about_; }
    [[nodiscard]] const std::shared_ptr<BenchTap>& tap() const noexcept { return opened_->tap; }
    /// Warnings for the operator about these devices with this profile, a sentence each.
    [[nodiscard]] const std::vector<std::string>& warnings() const noexcept { return opened_->warnings; }

    /// Looks after the bench; on the virtual clock, lets `speed` times the real time pass.
    void serve(double speed);
    /// The session's error, once.
    [[nodiscard]] std::optional<Error> takeRecordingFailure();
    /// Ends the bench, then the session.
    [[nodiscard]] Result<void> close();

    [[nodiscard]] Result<void> runScope(const ScopeSettings& settings, bool single,
                                        std::optional<Seconds> untriggeredAfter);
    void stopScope();
    /// Asks again for what was asked for before: something else may have used the oscilloscope.
    [[nodiscard]] Result<void> repeatCapture();
    /// The newest; null where none has come. After an error no capture comes until runScope().
    [[nodiscard]] Result<std::shared_ptr<const Capture>> takeCapture();

private:
    using SteadyTime = std::chrono::steady_clock::time_point;
    explicit DrivenBench(std::shared_ptr<OpenedBench> opened)
        : opened_(std::move(opened)), about_(describeBench(*opened_)) {}

    std::shared_ptr<OpenedBench> opened_;
    std::shared_ptr<const OpenBench> about_;
    SteadyTime servedAt_ = std::chrono::steady_clock::now();
    std::optional<ScopeSettings> scope_;  ///< captures are wanted
    bool single_ = false;
    std::optional<Seconds> untriggeredAfter_;
    bool recordingFailed_ = false;
};

}  // namespace tacto::gui
