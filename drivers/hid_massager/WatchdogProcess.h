// WatchdogProcess.h - a Watchdog in its own process: tactoscope-watchdog, which lies next to the running program.
//
// Thread-safety: as Watchdog. start() any thread.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <sys/types.h>

#include "drivers/hid_massager/StopWay.h"
#include "drivers/hid_massager/Watchdog.h"

namespace tacto::hid {

class WatchdogProcess final : public Watchdog {
public:
    /// Returns the path where the watchdog program is expected.
    [[nodiscard]] static std::filesystem::path programPath();

    /// Starts the watchdog; when this returns, within 1 s, it has the device's node open. Errors: NotFound (no such
    /// program), Io (it does not start or may not open the node), each saying that the massager is not driven.
    [[nodiscard]] static Result<std::unique_ptr<Watchdog>> start(const StopWay& way,
                                                                 const std::filesystem::path& program = programPath());
    /// Waits at most 1 s for the process to end; a watchdog that cannot deliver its stop keeps trying on its own.
    ~WatchdogProcess() override;
    WatchdogProcess(const WatchdogProcess&) = delete;
    WatchdogProcess& operator=(const WatchdogProcess&) = delete;

    [[nodiscard]] WatchdogState beat() noexcept override;
    void rest() noexcept override;

private:
    WatchdogProcess(pid_t process, int line) noexcept : process_(process), line_(line) {}

    const pid_t process_;
    const int line_;
    bool resting_ = true;
    std::optional<std::chrono::steady_clock::time_point> unanswered_;  // since when a beat is unanswered
};

}  // namespace tacto::hid
