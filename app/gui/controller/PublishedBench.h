// PublishedBench.h - the bench and the script that are at work on the bench's thread, as the others reach them past its
// queue: to look, to pause and to stop.
//
// Thread-safety: any thread may call anything; the bench and the script outlive what is published of them. Each call
// holds the lock for as long as the bench's or the script's own call takes.
#pragma once

#include <functional>
#include <mutex>
#include <optional>
#include <string>

#include "app/scripting/engine/ScriptRun.h"
#include "core/bench/Bench.h"

namespace tacto::gui {

class PublishedBench {
public:
    /// Disconnected without a bench.
    [[nodiscard]] Telemetry telemetry() const;
    [[nodiscard]] std::optional<DeviceReport> deviceReport(Role role) const;
    /// Ends the script, or switches off the bench where there is none.
    void stop(const char* by) noexcept;
    void pause();
    void resume();
    [[nodiscard]] bool paused() const;
    /// False where nothing is recorded.
    [[nodiscard]] bool markMoment(Instant at, const std::string& word);

    /// From here on a stop reaches this bench; null: there is none.
    void publish(Bench* bench);
    /// From here on a stop reaches the script. Returns the last one since forgetStops() that reached none.
    [[nodiscard]] std::optional<std::string> publish(Bench& bench, ScriptRun& script);
    void forgetStops();
    /// Asked before a script is stopped: whether the stop was taken as its own. May be empty.
    void setTakesStop(std::function<bool(const char* by)> takes);

private:
    mutable std::mutex mutex_;                    // held for moments: to swap the pointers, to look, to stop
    Bench* bench_ = nullptr;                      // guarded
    ScriptRun* script_ = nullptr;                 // guarded
    std::optional<std::string> unheardStop_;      // guarded: the last stop that no script heard
    std::function<bool(const char*)> takesStop_;  // guarded: the running session's
};

}  // namespace tacto::gui
