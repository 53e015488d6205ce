// PressedStops.h - the stops of a pilot session that were not handled yet: who pressed, or what went, and how long it
// took until the output was told.
//
// Thread-safety: all calls from any thread.
#pragma once

#include <atomic>
#include <chrono>
#include <optional>
#include <string_view>

#include "core/pilot/Participant.h"

namespace tacto {

[[nodiscard]] inline bool isParticipants(std::string_view by) noexcept { return by.starts_with("participant"); }

class PressedStops {
public:
    struct Press {
        bool participants = false;
        std::chrono::nanoseconds took{0};
    };

    /// `by` as in PilotParticipant::stop; the pointer is kept, the text not copied.
    void note(const char* by) noexcept {
        if (std::string_view(by).starts_with(kScreenGone))
            screenGone_ = true;
        else if (std::string_view(by) == kOperatorAborts)
            aborted_ = true;
        else if (std::string_view(by) == kOperatorPauses)
            paused_ = true;
        else
            by_.store(by);
    }
    /// How long the last one took, from the press until the output was told.
    void noteTook(std::chrono::nanoseconds took) noexcept { took_.store(took.count()); }

    [[nodiscard]] bool any() const noexcept { return by_.load() != nullptr || screenGone_ || aborted_ || paused_; }

    /// Someone pressed STOP, or let go; null: neither.
    [[nodiscard]] const char* by() const noexcept { return by_.load(); }
    [[nodiscard]] const char* takeBy() noexcept { return by_.exchange(nullptr); }
    /// The same, with how long it took.
    [[nodiscard]] std::optional<Press> takePress() noexcept {
        const char* by = takeBy();
        if (by == nullptr) return std::nullopt;
        return Press{isParticipants(by), std::chrono::nanoseconds(took_.load())};
    }
    [[nodiscard]] bool screenGone() const noexcept { return screenGone_; }
    [[nodiscard]] bool takeScreenGone() noexcept { return screenGone_.exchange(false); }
    [[nodiscard]] bool paused() const noexcept { return paused_; }
    [[nodiscard]] bool takePaused() noexcept { return paused_.exchange(false); }
    /// The session is interrupted for good: it stays so.
    [[nodiscard]] bool aborted() const noexcept { return aborted_; }

private:
    std::atomic<const char*> by_{nullptr};
    std::atomic<std::chrono::nanoseconds::rep> took_{0};
    std::atomic<bool> screenGone_{false};
    std::atomic<bool> aborted_{false};
    std::atomic<bool> paused_{false};
};

}  // namespace tacto
