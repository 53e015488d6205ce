// ScopeMarks.h - the moments that the operator marked in the bench's session, as an oscilloscope shows them.
//
// Thread-safety: one thread at a time.
#pragma once

#include <QString>
#include <vector>

#include "app/gui/scope/model/Trace.h"

namespace tacto::gui {

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
    /// Those between `left_s` and `right_s` on an axis whose 0 is `zero_s`, with their time on it.
    [[nodiscard]] std::vector<MomentMark> between(double left_s, double right_s, double zero_s) const;
    /// The newest mark as a note on `shown`, where no capture holds it: it came between `before`, the capture before
    /// (null: there is none), and this one, or after this one. Else empty.
    [[nodiscard]] QString beside(const ShownCapture& shown, const ShownCapture* before) const;

private:
    std::vector<MomentMark> marks_;
};

}  // namespace tacto::gui
