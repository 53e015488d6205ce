#include "core/bench/ScopeSession.h"

#include <iterator>
#include <utility>

namespace tacto {

void ScopeSession::request(const ScopeSettings& settings, Instant now) {
    const std::scoped_lock lock(mutex_);
    notBefore_s_ = toSeconds(now);
    requested_ = settings;
    cancelled_ = false;
    captures_.clear();
    error_.reset();
}

void ScopeSession::cancel() {
    const std::scoped_lock lock(mutex_);
    requested_.reset();
    cancelled_ = true;
}

std::size_t ScopeSession::ready() const {
    const std::scoped_lock lock(mutex_);
    return captures_.size();
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
    std::vector<Capture> taken(std::make_move_iterator(captures_.begin()), std::make_move_iterator(captures_.end()));
    captures_.clear();
    return taken;
}

Instant ScopeSession::serve(Instant now) noexcept {
    constexpr Instant kPollEvery = std::chrono::milliseconds(5);
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
    }
    while (done && polling) {
        auto capture = device_.poll();
        if (!capture) {
            done = failure(capture);
        } else if (!*capture) {
            break;
        } else {
            const std::scoped_lock lock(mutex_);
            if ((*capture)->trigger_s < notBefore_s_) continue;
            if (captures_.size() == kMaxCaptures) captures_.pop_front();
            captures_.push_back(std::move(**capture));
        }
    }
    if (!done) {
        device_.disarm();
        const std::scoped_lock lock(mutex_);
        error_ = done.error();
        active_ = false;
    }
    return now + kPollEvery;
}

}  // namespace tacto
