// PressedStops.h - the stops of a pilot session that were not handled yet: who pressed, or what was lost, and how long
// it took until the output was switched off.
//
// A press is atomic: a caller that takes a press while the output is being switched off waits until it is off. Each
// press is thus taken once, with its time.
//
// Thread-safety: all calls from any thread.
#pragma once

#include <atomic>
#include <chrono>
#include <optional>
#include <string_view>

#include "core/pilot/PilotParticipant.h"

namespace tacto {

[[nodiscard]] inline bool isParticipants(std::string_view by) noexcept { return by.starts_with("participant"); }

class PressedStops {
public:
    struct Press {
        bool participants = false;
        std::chrono::nanoseconds took{0};
    };

    /// `by` as in PilotParticipant::stop; only the pointer is kept, the text is not copied. `switchOff` must not call
    /// this object.
    template <class SwitchOff>
    void press(const char* by, SwitchOff switchOff) noexcept {
        const auto pressed = std::chrono::steady_clock::now();
        underWay_.fetch_add(1);
        const bool isPerson = keep(by);
        switchOff();
        if (isPerson) took_.store((std::chrono::steady_clock::now() - pressed).count());
        underWay_.fetch_sub(1);
        underWay_.notify_all();
    }

    [[nodiscard]] bool any() const noexcept {
        return settled(by_.load() != nullptr || screenGone_ || aborted_ || paused_);
    }

    /// Returns who pressed STOP or let go; null if nobody did.
    [[nodiscard]] const char* by() const noexcept { return settled(by_.load()); }
    [[nodiscard]] const char* takeBy() noexcept { return settled(by_.exchange(nullptr)); }
    /// Takes the press, with the time that it took until the output was off.
    [[nodiscard]] std::optional<Press> takePress() noexcept {
        const char* by = takeBy();
        if (by == nullptr) return std::nullopt;
        return Press{isParticipants(by), std::chrono::nanoseconds(took_.load())};
    }
    [[nodiscard]] bool screenGone() const noexcept { return settled(screenGone_.load()); }
    [[nodiscard]] bool takeScreenGone() noexcept { return settled(screenGone_.exchange(false)); }
    [[nodiscard]] bool paused() const noexcept { return settled(paused_.load()); }
    [[nodiscard]] bool takePaused() noexcept { return settled(paused_.exchange(false)); }
    /// Whether the session was interrupted for good; this never becomes false again.
    [[nodiscard]] bool aborted() const noexcept { return settled(aborted_.load()); }

private:
    /// Returns true if a person pressed STOP or let go.
    bool keep(const char* by) noexcept {
        const std::string_view text(by);
        std::atomic<bool>* const other = text.starts_with(kScreenGone) ? &screenGone_
                                         : text == kOperatorAborts     ? &aborted_
                                         : text == kOperatorPauses     ? &paused_
                                                                       : nullptr;
        other != nullptr ? other->store(true) : by_.store(by);
        return other == nullptr;
    }
    /// Returns `read` once the output is off: a press is counted in `underWay_` before it can be read.
    template <class T>
    T settled(T read) const noexcept {
        for (int pressing = underWay_.load(); pressing != 0; pressing = underWay_.load()) underWay_.wait(pressing);
        return read;
    }

    std::atomic<int> underWay_{0};
    std::atomic<const char*> by_{nullptr};
    std::atomic<std::chrono::nanoseconds::rep> took_{0};
    std::atomic<bool> screenGone_{false};
    std::atomic<bool> aborted_{false};
    std::atomic<bool> paused_{false};
};

}  // namespace tacto
