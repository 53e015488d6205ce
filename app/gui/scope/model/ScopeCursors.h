// ScopeCursors.h - the oscilloscope's cursors: two across time, two across the active lane's level, one of them with
// the focus.
//
// Thread-safety: one owner.
#pragma once

#include <QString>
#include <array>
#include <optional>
#include <vector>

#include "app/gui/scope/model/ScopeLanes.h"
#include "app/gui/scope/model/Viewport.h"

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

/// The readings of a lane at the two cursors across time, between samples by straight line.
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
/// "17.5 V": a level that a cursor reads, written the same in flags, on the clipboard and in a picture's caption.
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
    /// The levels, in the active lane's unit.
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

/// The trigger on the screen: its level and its moment, and a drag of either.
class ScopeTrigger {
public:
    /// Empty: no level is shown.
    [[nodiscard]] const QString& lane() const noexcept { return lane_; }
    /// The level, in the lane's unit.
    [[nodiscard]] double level() const noexcept { return level_; }
    /// The level follows the command and cannot be dragged.
    [[nodiscard]] bool held() const noexcept { return held_; }
    /// Where the moment was dragged to, in seconds on the axis.
    [[nodiscard]] const std::optional<double>& moment_s() const noexcept { return moment_s_; }
    /// The text shown while it is dragged.
    [[nodiscard]] const QString& text() const noexcept { return text_; }

    /// Returns whether anything is another. A level that is being dragged stays: the hand on it knows better.
    bool set(const QString& lane, double level, bool held);
    /// The share of the record before the trigger; nothing: the record cannot be set.
    void setFraction(std::optional<double> fraction) { fraction_ = fraction; }
    /// False where it cannot be dragged; this holds below, too.
    bool dragLevel(double height, const LaneScale& scale, const QString& unit);
    bool dragMoment(double time_s, double length_s);
    void forgetMoment() { moment_s_.reset(); }
    /// Ends a drag. Returns the fraction that was chosen by it.
    std::optional<double> drop(double length_s);

private:
    [[nodiscard]] double fractionAt(double time_s, double length_s) const;

    QString lane_;
    double level_ = 0;
    bool held_ = false;
    bool levelDragged_ = false;
    std::optional<double> fraction_;
    std::optional<double> moment_s_;
    QString text_;
};

}  // namespace tacto::gui
