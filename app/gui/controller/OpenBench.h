// OpenBench.h - the order to open a bench, and the bench that is then open.
//
// Thread-safety: values; a DrivenBench is used by the controller's thread only, except bench().stop() and telemetry(),
// see Bench.h.
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

/// The order to open a bench for viewing, driving by hand and replaying.
struct LiveOrder {
    std::vector<DeviceUri> uris;
    /// Roles that the bench must have; sim: fills the roles that no other device fills.
    std::set<Role> needed{Role::Sensor, Role::Stimulator, Role::Oscilloscope};
    Profile profile;
    double speed = 1;  ///< factor to real time; only for devices that can use the virtual clock
    std::uint64_t seed = 1;
    RunNotes notes = {};  ///< notes for the session; the controller copies them from the day's notes
};

/// Facts about an open bench, constant while it is open.
struct OpenBench {
    SessionAbout about;
    std::filesystem::path session;
    std::vector<StreamInfo> streams;       ///< the sensor's streams; empty without a sensor
    std::optional<DeviceIdentity> output;  ///< the device that arming arms: the stimulator, or else the massager
    std::optional<SourceTraits> source;
    std::optional<ScopeTraits> scope;
    bool paced = false;        ///< runs on the virtual clock, so that `speed` has effect
    bool surfaces = false;     ///< the rig can present surfaces by itself
    bool untriggered = false;  ///< the oscilloscope can capture without a trigger
    [[nodiscard]] bool simulated() const { return about.simulated; }
};

[[nodiscard]] std::shared_ptr<const OpenBench> describeBench(const OpenedBench& opened);

/// A bench that is open for viewing and driving by hand: its devices, clock and session file, and the captures of its
/// oscilloscope.
class DrivenBench {
public:
    struct Conditions {
        const ShippedLimits& limits;
        std::shared_ptr<StopCounter> stops;
        StopMark asked;
        std::function<bool()> watched;
    };
    /// Opens the devices; a stop since `asked` ends the opening as soon as the present driver call returns. The session
    /// records from here on. Only simulated devices and recordings use the virtual clock.
    [[nodiscard]] static Result<std::unique_ptr<DrivenBench>> open(Registry& registry, const LiveOrder& order,
                                                                   const Conditions& conditions);

    [[nodiscard]] Bench& bench() noexcept { return *opened_->bench; }
    [[nodiscard]] const std::shared_ptr<const OpenBench>& about() const noexcept { return about_; }
    [[nodiscard]] const std::shared_ptr<BenchTap>& tap() const noexcept { return opened_->tap; }
    /// Returns warnings for the operator about these devices with this profile, one sentence each.
    [[nodiscard]] const std::vector<std::string>& warnings() const noexcept { return opened_->warnings; }

    /// Serves the bench; on the virtual clock, lets `speed` times the elapsed real time pass.
    void serve(double speed);
    /// Returns the session's error, once.
    [[nodiscard]] std::optional<Error> takeRecordingFailure();
    /// Closes the bench, then the session.
    [[nodiscard]] Result<void> close();

    [[nodiscard]] Result<void> runScope(const ScopeSettings& settings, bool single,
                                        std::optional<Seconds> untriggeredAfter);
    void stopScope();
    /// Repeats the last capture request, since something else may have used the oscilloscope.
    [[nodiscard]] Result<void> repeatCapture();
    /// Returns the newest capture; null if there is none. After an error no capture comes until runScope().
    [[nodiscard]] Result<std::shared_ptr<const Capture>> takeCapture();

private:
    using SteadyTime = std::chrono::steady_clock::time_point;
    explicit DrivenBench(std::shared_ptr<OpenedBench> opened)
        : opened_(std::move(opened)), about_(describeBench(*opened_)) {}

    std::shared_ptr<OpenedBench> opened_;
    std::shared_ptr<const OpenBench> about_;
    SteadyTime servedAt_ = std::chrono::steady_clock::now();
    std::optional<ScopeSettings> scope_;  ///< set while captures are wanted
    bool single_ = false;
    std::optional<Seconds> untriggeredAfter_;
    bool recordingFailed_ = false;
};

}  // namespace tacto::gui
