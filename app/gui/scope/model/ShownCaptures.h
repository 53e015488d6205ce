// ShownCaptures.h - the newest capture on the oscilloscope's screen and the older ones behind it: faded, or one after
// the other in roll mode.
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

    /// Null before the first capture.
    [[nodiscard]] const ShownPtr& newest() const noexcept { return newest_; }
    /// The older captures, newest first; excludes newest().
    [[nodiscard]] const std::deque<ShownPtr>& behind() const noexcept { return behind_; }
    /// Number of older captures that are drawn faded, at most kMaxBehind.
    [[nodiscard]] int persistence() const noexcept { return persistence_; }
    void setPersistence(int captures);
    [[nodiscard]] bool roll() const noexcept { return roll_; }
    /// Leaving roll mode, or entering it with nothing shown, drops captures that are too old.
    void setRoll(bool roll);

    /// True if both `next` and the newest capture come from the bench. Otherwise `next` starts over.
    [[nodiscard]] bool isFollowedBy(const ShownCapture& next) const;
    void show(ShownPtr next);
    /// Replaces the newest capture by the same capture with other calculations.
    void replaceNewest(ShownPtr same) { newest_ = std::move(same); }
    void clear();

private:
    void dropOldest();

    ShownPtr newest_;
    std::deque<ShownPtr> behind_;
    int persistence_ = 0;
    bool roll_ = false;
};

/// A moment marked by the operator, on the session's time base.
struct MomentMark {
    double at_s = 0;
    QString word;
};

class ScopeMarks {
public:
    static constexpr std::size_t kMaxKept = 1000;

    /// Adds a mark; only the newest kMaxKept marks stay.
    void add(MomentMark mark);
    void clear() { marks_.clear(); }
    /// The marks between `left_s` and `right_s` on an axis with its 0 at `zero_s`, with their times on that axis.
    [[nodiscard]] std::vector<MomentMark> between(double left_s, double right_s, double zero_s) const;
    /// Returns a note about the newest mark if no capture contains it: the mark came between `before` (the previous
    /// capture, null: none) and `shown`, or after `shown`. Otherwise empty.
    [[nodiscard]] QString beside(const ShownCapture& shown, const ShownCapture* before) const;

private:
    std::vector<MomentMark> marks_;
};

}  // namespace tacto::gui
