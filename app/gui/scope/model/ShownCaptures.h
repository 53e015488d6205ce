// ShownCaptures.h - the newest capture on an oscilloscope's screen and those behind it: faded, or in roll mode one
// after the other.
//
// Thread-safety: one thread at a time.
#pragma once

#include <deque>

#include "app/gui/scope/model/Trace.h"

namespace tacto::gui {

class ShownCaptures {
public:
    static constexpr int kMaxBehind = 32;

    /// Null before the first.
    [[nodiscard]] const ShownPtr& newest() const noexcept { return newest_; }
    /// Newest first, without the newest of all.
    [[nodiscard]] const std::deque<ShownPtr>& behind() const noexcept { return behind_; }
    /// How many of these are drawn faded, at most kMaxBehind.
    [[nodiscard]] int persistence() const noexcept { return persistence_; }
    void setPersistence(int captures);
    [[nodiscard]] bool roll() const noexcept { return roll_; }
    /// Leaving roll mode, and entering it with nothing shown, drops what is too old.
    void setRoll(bool roll);

    /// Whether `next` would follow the newest: both are the bench's. Anything else begins anew.
    [[nodiscard]] bool isFollowedBy(const ShownCapture& next) const;
    void show(ShownPtr next);
    /// The same capture with other calculations.
    void replaceNewest(ShownPtr same) { newest_ = std::move(same); }
    void clear();

private:
    void dropOldest();

    ShownPtr newest_;
    std::deque<ShownPtr> behind_;
    int persistence_ = 0;
    bool roll_ = false;
};

}  // namespace tacto::gui
