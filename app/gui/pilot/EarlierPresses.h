// EarlierPresses.h - keys and buttons that went down while no target was there: while still held they do not answer.
//
// Thread-safety: none of its own.
#pragma once

#include <chrono>
#include <map>

#include "app/gui/theme/ConfirmButton.h"

namespace tacto::gui {

class EarlierPresses {
public:
    /// Whether a press is one that went down before: marked as `repeated`, or too soon after the last for another.
    [[nodiscard]] bool isHeld(int code, SteadyTime at, bool repeated) {
        const auto before = last_.find(code);
        const bool held = repeated || (before != last_.end() && at - before->second < kRepeats);
        if (before != last_.end() && held) before->second = at;
        return held;
    }
    void note(int code, SteadyTime at) { last_[code] = at; }
    void forget(int code) { last_.erase(code); }
    void clear() { last_.clear(); }

private:
    static constexpr std::chrono::milliseconds kRepeats{150};  // X does not mark every press of a held key as repeated
    std::map<int, SteadyTime> last_;
};

}  // namespace tacto::gui
