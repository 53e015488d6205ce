#include "core/bench/sensing/ScopeSession.h"

#include <new>
#include <utility>

namespace tacto {

void ScopeSession::request(const ScopeSettings& settings, Instant now, std::size_t wanted,
                           std::optional<Instant> untriggeredAfter) {
    const std::scoped_lock lock(mutex_);
    notBefore_s_ = toSeconds(now);
    requested_ = settings;
    waiting_ = false;
    wanted_ = wanted;
    forceAfter_ = untriggeredAfter;
    cancelled_ = false;
    captures_.clear();
    error_.reset();
}

void ScopeSession::cancel() {
    const std::scoped_lock lock(mutex_);
    requested_.reset();
    cancelled_ = true;
    waiting_ = false;
}

std::size_t ScopeSession::ready() const {
    const std::scoped_lock lock(mutex_);
    return captures_.size();
}

bool ScopeSession::waiting() const {
    const std::scoped_lock lock(mutex_);
    return waiting_;
}

bool ScopeSession::failed() const {
    const std::scoped_lock lock(mutex_);
    return error_.has_value();
}

bool ScopeSession::active() const {
    const std::scoped_lock lock(mutex_);
    return active_ || requested_ || cancelled_;
}

Result<std::vector<Capture>> ScopeSession::take() {
    const std::scoped_lock lock(mutex_);
    if (error_) return tl::unexpected<Error>(*error_);
    return std::exchange(captures_, {});
}

Result<void> ScopeSession::forceWhenDue(Instant now) {
    {
        const std::scoped_lock lock(mutex_);
        if (!active_ || !forceAfter_ || forced_ == nullptr || forceAsked_ || now - quietSince_ < *forceAfter_)
            return {};
    }
    forceAsked_ = true;
    return forced_->forceTrigger();
}

bool ScopeSession::stale(const Capture& capture) const {
    const std::scoped_lock lock(mutex_);
    return capture.trigger_s < notBefore_s_;
}

Instant ScopeSession::serve(Instant now) noexcept {
    constexpr Instant kPollEvery = std::chrono::milliseconds(5);
    try {
        serveDevice(now);
    } catch (const std::bad_alloc&) {
        // A record may be the program's largest object. Free its memory and report the error to the run.
        device_.disarm();
        const std::scoped_lock lock(mutex_);
        error_ = Error{ErrorCode::Device, "no memory left"};  // too short to need an allocation
        active_ = waiting_ = false;
    }
    return now + kPollEvery;
}

void ScopeSession::serveDevice(Instant now) {
    std::optional<ScopeSettings> settings;
    bool cancel = false;
    bool polling = false;
    {
        const std::scoped_lock lock(mutex_);
        settings = std::exchange(requested_, std::nullopt);
        cancel = std::exchange(cancelled_, false);
        if (settings) active_ = true;
        if (cancel) active_ = false;
        polling = active_;
    }
    if (cancel) device_.disarm();
    Result<void> done;
    if (settings) {
        device_.disarm();
        done = device_.configure(*settings);
        if (done) done = device_.arm();
        {
            const std::scoped_lock lock(mutex_);
            waiting_ = done && !requested_ && !cancelled_;
        }
        quietSince_ = now;
        forceAsked_ = false;
    }
    while (done && polling) {
        auto capture = device_.poll();
        if (!capture) {
            done = failure(capture);
        } else if (!*capture) {
            break;
        } else {
            quietSince_ = now;
            forceAsked_ = false;
            if (seen_ && !stale(**capture)) seen_(**capture);
            const std::scoped_lock lock(mutex_);
            if ((*capture)->trigger_s < notBefore_s_) continue;
            captures_.push_back(std::move(**capture));
            if (captures_.size() < wanted_) continue;
            active_ = waiting_ = false;
            device_.disarm();
            break;
        }
    }
    if (done && polling) done = forceWhenDue(now);
    if (!done) {
        device_.disarm();
        const std::scoped_lock lock(mutex_);
        error_ = done.error();
        active_ = waiting_ = false;
    }
}

}  // namespace tacto
