// PressedStops.h - the stops of a pilot session that were not handled yet: who pressed, or what went, and how long it
// took until the output was told.
//
// A press is one thing: a question that comes while the output is being told waits until it was. What is taken has
// taken effect, so that it counts once, and has been timed.
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

    /// `by` as in PilotParticipant::stop; the pointer is kept, the text not copied. `tellOutput` asks nothing here.
    template <class TellOutput>
    void press(const char* by, TellOutput tellOutput) noexcept {
        const auto pressed = std::chrono::steady_clock::now();
        underWay_.fetch_add(1);
        keep(by);
        tellOutput();
        took_.store((std::chrono::steady_clock::now() - pressed).count());
        underWay_.fetch_sub(1);
        underWay_.notify_all();
    }

    [[nodiscard]] bool any() const noexcept {
        settle();
        return by_.load() != nullptr || screenGone_ || aborted_ || paused_;
    }

    /// Someone pressed STOP, or let go; null: neither.
    [[nodiscard]] const char* by() const noexcept {
        settle();
        return by_.load();
    }
    [[nodiscard]] const char* takeBy() noexcept {
        settle();
        return by_.exchange(nullptr);
    }
    /// The same, with how long it took from the press until the output was told.
    [[nodiscard]] std::optional<Press> takePress() noexcept {
        const char* by = takeBy();
        if (by == nullptr) return std::nullopt;
        return Press{isParticipants(by), std::chrono::nanoseconds(took_.load())};
    }
    [[nodiscard]] bool screenGone() const noexcept {
        settle();
        return screenGone_;
    }
    [[nodiscard]] bool takeScreenGone() noexcept {
        settle();
        return screenGone_.exchange(false);
    }
    [[nodiscard]] bool paused() const noexcept {
        settle();
        return paused_;
    }
    [[nodiscard]] bool takePaused() noexcept {
        settle();
        return paused_.exchange(false);
    }
    /// The session is interrupted for good: it stays so.
    [[nodiscard]] bool aborted() const noexcept {
        settle();
        return aborted_;
    }

private:
    void keep(const char* by) noexcept {
        if (std::string_view(by).starts_with(kScreenGone))
            screenGone_ = true;
        else if (std::string_view(by) == kOperatorAborts)
            aborted_ = true;
        else if (std::string_view(by) == kOperatorPauses)
            paused_ = true;
        else
            by_.store(by);
    }
    void settle() const noexcept {
        for (int pressing = underWay_.load(); pressing != 0; pressing = underWay_.load()) underWay_.wait(pressing);
    }

    std::atomic<int> underWay_{0};
    std::atomic<const char*> by_{nullptr};
    std::atomic<std::chrono::nanoseconds::rep> took_{0};
    std::atomic<bool> screenGone_{false};
    std::atomic<bool> aborted_{false};
    std::atomic<bool> paused_{false};
};

}  // namespace tacto
