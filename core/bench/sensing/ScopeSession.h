// ScopeSession.h - the only caller of an oscilloscope: arms it, and keeps the captures its triggers make
// until they are taken.
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

    /// `device` outlives the session. `seen`, unless empty, is shown every capture that is kept, from serve(), and may
    /// add to it.
    explicit ScopeSession(Oscilloscope& device, std::function<void(Capture&)> seen = {})
        : device_(device), forced_(dynamic_cast<ForcedTrigger*>(&device)), seen_(std::move(seen)) {}

    /// Asks for `wanted` captures triggered from `now` on, with these settings; throws away older ones. The device
    /// is disarmed with the last of them, so that none is taken that was not asked for.
    /// With `untriggeredAfter`, a record is taken without a trigger when none has come for that long since the request
    /// or the capture before; only where canForce().
    void request(const ScopeSettings& settings, Instant now, std::size_t wanted,
                 std::optional<Instant> untriggeredAfter = {});
    /// Whether the device can take a record without a trigger.
    [[nodiscard]] bool canForce() const noexcept { return forced_ != nullptr; }
    [[nodiscard]] const Oscilloscope& device() const noexcept { return device_; }
    /// Takes no more captures.
    void cancel();
    [[nodiscard]] std::size_t ready() const;
    /// The device takes the next trigger: it was configured and armed for the last request.
    [[nodiscard]] bool waiting() const;
    /// Everything captured so far, oldest first. The error of the device when it failed since request().
    [[nodiscard]] Result<std::vector<Capture>> take();
    /// Whether the device failed since request().
    [[nodiscard]] bool failed() const;

    Instant serve(Instant now) noexcept;
    [[nodiscard]] bool active() const;

private:
    void serveDevice(Instant now);
    [[nodiscard]] Result<void> forceWhenDue(Instant now);
    /// Belongs to an earlier request.
    [[nodiscard]] bool stale(const Capture& capture) const;

    Oscilloscope& device_;
    ForcedTrigger* const forced_;  // the device's, or null
    const std::function<void(Capture&)> seen_;
    mutable std::mutex mutex_;
    std::optional<ScopeSettings> requested_;  // guarded
    std::size_t wanted_ = 0;                  // guarded
    bool active_ = false;                     // guarded
    bool waiting_ = false;                    // guarded
    bool cancelled_ = false;                  // guarded
    std::vector<Capture> captures_;           // guarded
    double notBefore_s_ = 0;                  // guarded: a trigger before it belongs to an earlier request
    std::optional<Error> error_;              // guarded
    std::optional<Instant> forceAfter_;       // guarded
    // serve()'s:
    Instant quietSince_{0};
    bool forceAsked_ = false;  // a record was asked for with force, and has not come
};

}  // namespace tacto
