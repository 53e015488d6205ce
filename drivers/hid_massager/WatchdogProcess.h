// WatchdogProcess.h - a Watchdog in a process of its own: tactoscope-watchdog, which lies beside the running program.
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
    /// Where the program is expected.
    [[nodiscard]] static std::filesystem::path programPath();

    /// Starts it; it has the device's node open when this returns, which takes 1 s at most. Errors: NotFound (no such
    /// program), Io (it does not start, or may not open the node), each saying that the massager is not driven.
    [[nodiscard]] static Result<std::unique_ptr<Watchdog>> start(const StopWay& way,
                                                                 const std::filesystem::path& program = programPath());
    /// Waits until the process has ended, 1 s at most: one that cannot deliver its stop keeps trying by itself.
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
    std::optional<std::chrono::steady_clock::time_point> unanswered_;  // since then
};

}  // namespace tacto::hid
