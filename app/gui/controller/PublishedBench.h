// PublishedBench.h - the bench and the script now active on the bench's thread, which other threads can view, pause and
// stop without waiting in that thread's queue.
//
// Thread-safety: any thread may call anything; bench and script must outlive their publication. Each call holds the
// lock as long as the bench's or script's own call takes.
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
    /// Disconnected if there is no bench.
    [[nodiscard]] Telemetry telemetry() const;
    [[nodiscard]] std::optional<DeviceReport> deviceReport(Role role) const;
    /// Ends the script or, without a script, switches off the bench.
    void stop(const char* by) noexcept;
    void pause();
    void resume();
    [[nodiscard]] bool paused() const;
    /// Returns false if nothing is recorded.
    [[nodiscard]] bool markMoment(Instant at, const std::string& word);

    /// From here on a stop reaches this bench; null: there is no bench.
    void publish(Bench* bench);
    /// From here on a stop reaches the script. Returns the last stop since forgetStops() that reached no script.
    [[nodiscard]] std::optional<std::string> publish(Bench& bench, ScriptRun& script);
    void forgetStops();
    /// Called before a script is stopped; returns true if the session handled the stop itself. May be empty.
    void setTakesStop(std::function<bool(const char* by)> takes);

private:
    mutable std::mutex mutex_;                    // held briefly: to swap pointers, to read, to stop
    Bench* bench_ = nullptr;                      // guarded
    ScriptRun* script_ = nullptr;                 // guarded
    std::optional<std::string> unheardStop_;      // guarded: the last stop that reached no script
    std::function<bool(const char*)> takesStop_;  // guarded: belongs to the running session
};

}  // namespace tacto::gui
