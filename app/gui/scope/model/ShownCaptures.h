// ShownCaptures.h - the newest capture on an oscilloscope's screen and those behind it: faded, or in roll mode one
// after the other.
//
// Thread-safety: one thread at a time.
#pragma once

#include <QString>
#include <deque>
#include <vector>

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

    /// Whether `next` would follow the newest: both come from the bench. Anything else starts over.
    [[nodiscard]] bool isFollowedBy(const ShownCapture& next) const;
    void show(ShownPtr next);
    /// Replaces it by the same capture with other calculations.
    void replaceNewest(ShownPtr same) { newest_ = std::move(same); }
    void clear();

private:
    void dropOldest();

    ShownPtr newest_;
    std::deque<ShownPtr> behind_;
    int persistence_ = 0;
    bool roll_ = false;
};

/// A moment that the operator marked, on the session's time base.
struct MomentMark {
    double at_s = 0;
    QString word;
};

class ScopeMarks {
public:
    static constexpr std::size_t kMaxKept = 1000;

    /// The newest kMaxKept stay.
    void add(MomentMark mark);
    void clear() { marks_.clear(); }
    /// The marks between `left_s` and `right_s` on an axis whose 0 is `zero_s`, with their time on it.
    [[nodiscard]] std::vector<MomentMark> between(double left_s, double right_s, double zero_s) const;
    /// The newest mark as a note on `shown`, where no capture holds it: it came between `before`, the previous capture
    /// (null: none), and this one, or after this one. Else empty.
    [[nodiscard]] QString beside(const ShownCapture& shown, const ShownCapture* before) const;

private:
    std::vector<MomentMark> marks_;
};

}  // namespace tacto::gui
