// ScopeCursors.h - the oscilloscope's cursors: two across time, two across the active lane's level, one of them with
// the focus.
//
// Thread-safety: one owner.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "app/gui/scope/model/ScopeLanes.h"

namespace tacto::gui {

/// NaN where there is no cursor or no value.
struct CursorReadout {
    double x1_s = kNotMeasured, x2_s = kNotMeasured;
    double at1 = kNotMeasured, at2 = kNotMeasured;  ///< the active lane there, as CursorValue has it
    double y1 = kNotMeasured, y2 = kNotMeasured;
    QString unit;  ///< the active lane's unit
    [[nodiscard]] double dx_s() const noexcept { return x2_s - x1_s; }
    [[nodiscard]] double dy() const noexcept { return y2 - y1; }
};

/// What a lane reads at the two cursors across time, between samples by straight line.
struct CursorValue {
    struct At {
        double value = kNotMeasured;
        int slope = 0;  ///< 1 or -1 on an edge, as it rises or falls; else 0
    };
    QString lane;
    std::array<At, 2> at;
};

/// Times as exact as samples of `rate_hz` know them; 0: not known.
[[nodiscard]] double knownTime(double time_s, double rate_hz);
/// "17.5 V": a level that a cursor reads, alike in flags, on the clipboard and in a picture's caption.
[[nodiscard]] QString levelText(double level, const QString& unit);
/// "Δ 200.0 µs · 1/Δ 5.000 kHz".
[[nodiscard]] QString spanText(const CursorReadout& readout, double rate_hz);
/// "t₁ 0 s   t₂ 4.000 ms   Δ 4.000 ms   1/Δ 250.0 Hz …", for the clipboard and for those who do not see the flags.
[[nodiscard]] QString readoutText(CursorReadout readout, double rate_hz);

class ScopeCursors {
public:
    using Pair = std::array<double, 2>;
    static constexpr int kNone = -1;

    /// Seconds on the axis.
    [[nodiscard]] const std::optional<Pair>& time_s() const noexcept { return time_s_; }
    /// In the active lane's unit.
    [[nodiscard]] const std::optional<Pair>& level() const noexcept { return level_; }
    /// 0 and 1: time; 2 and 3: level; kNone.
    [[nodiscard]] int focused() const noexcept { return focused_; }
    [[nodiscard]] bool timeFocused() const noexcept { return time_s_ && focused_ >= 0 && focused_ < 2; }
    [[nodiscard]] bool levelFocused() const noexcept { return level_ && focused_ >= 2; }

    void showTime(const Viewport& view);
    void hideTime();
    void showLevel(const LaneScale& scale);
    void hideLevel();
    /// Does nothing where that cursor is not shown.
    void focus(int cursor);

    void placeTime(int which, double time_s) { (*time_s_)[static_cast<std::size_t>(which)] = time_s; }
    void placeLevel(int which, double level) { (*level_)[static_cast<std::size_t>(which)] = level; }
    /// Level cursors stay where they are on the screen and read another lane.
    void changeLane(const LaneScale& before, const LaneScale& after);
    [[nodiscard]] CursorReadout readout(const ScopeLane& active) const;
    [[nodiscard]] std::vector<CursorValue> values(const std::vector<ScopeLane>& lanes) const;

private:
    std::optional<Pair> time_s_;
    std::optional<Pair> level_;
    int focused_ = kNone;
};

}  // namespace tacto::gui
