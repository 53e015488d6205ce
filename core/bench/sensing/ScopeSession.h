// ScopeSession.h - the only caller of an oscilloscope: arms it, and keeps its captures until they are taken.
//
// Thread-safety: serve() has one caller, the device's thread (on the virtual clock, the bench); the rest
// any thread. Captures are large: no more than kMaxCaptures may be asked for at once.
#pragma once

#include <functional>
#include <mutex>
#include <optional>
#include <vector>

#include "core/devices/Oscilloscope.h"

namespace tacto {

class ScopeSession {
public:
    static constexpr std::size_t kMaxCaptures = 64;

    /// `device` outlives the session. serve() passes every kept capture to `seen`, which may add to it; `seen` may be
    /// empty.
    explicit ScopeSession(Oscilloscope& device, std::function<void(Capture&)> seen = {})
        : device_(device), forced_(dynamic_cast<ForcedTrigger*>(&device)), seen_(std::move(seen)) {}

    /// Asks for `wanted` captures triggered from `now` on, with these settings; discards older ones. The device is
    /// disarmed after the last capture, so that it takes no further one. With `untriggeredAfter`, it takes a record
    /// without a trigger if none has come for that long since the request or the previous capture; only if canForce().
    void request(const ScopeSettings& settings, Instant now, std::size_t wanted,
                 std::optional<Instant> untriggeredAfter = {});
    /// True if the device can take a record without a trigger.
    [[nodiscard]] bool canForce() const noexcept { return forced_ != nullptr; }
    [[nodiscard]] const Oscilloscope& device() const noexcept { return device_; }
    /// Ends the present request.
    void cancel();
    [[nodiscard]] std::size_t ready() const;
    /// True if the device was configured and armed for the last request and will take the next trigger.
    [[nodiscard]] bool waiting() const;
    /// Takes all captures so far, oldest first. Errors: the device's, if it failed since request().
    [[nodiscard]] Result<std::vector<Capture>> take();
    /// True if the device failed since request().
    [[nodiscard]] bool failed() const;

    Instant serve(Instant now) noexcept;
    [[nodiscard]] bool active() const;

private:
    void serveDevice(Instant now);
    [[nodiscard]] Result<void> forceWhenDue(Instant now);
    /// True if the capture belongs to an earlier request.
    [[nodiscard]] bool stale(const Capture& capture) const;

    Oscilloscope& device_;
    ForcedTrigger* const forced_;  // the device's interface for this, or null
    const std::function<void(Capture&)> seen_;
    mutable std::mutex mutex_;
    std::optional<ScopeSettings> requested_;  // guarded by mutex_
    std::size_t wanted_ = 0;                  // guarded by mutex_
    bool active_ = false;                     // guarded by mutex_
    bool waiting_ = false;                    // guarded by mutex_
    bool cancelled_ = false;                  // guarded by mutex_
    std::vector<Capture> captures_;           // guarded by mutex_
    double notBefore_s_ = 0;                  // guarded: an earlier trigger belongs to an earlier request
    std::optional<Error> error_;              // guarded by mutex_
    std::optional<Instant> forceAfter_;       // guarded by mutex_
    // Used by serve() only:
    Instant quietSince_{0};
    bool forceAsked_ = false;  // true while a forced record was requested and has not come
};

}  // namespace tacto
