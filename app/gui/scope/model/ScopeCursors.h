// ScopeCursors.h - the oscilloscope's cursors: two for time, and two for the level of the active lane. One cursor has
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
#include "core/measure/SampleTrigger.h"

namespace tacto::gui {

/// NaN stands for a missing cursor or a missing value.
struct CursorReadout {
    double x1_s = kNotMeasured, x2_s = kNotMeasured;
    double at1 = kNotMeasured, at2 = kNotMeasured;  ///< the active lane's values at x1_s and x2_s, as in CursorValue
    double y1 = kNotMeasured, y2 = kNotMeasured;
    QString unit;  ///< the active lane's unit
    [[nodiscard]] double dx_s() const noexcept { return x2_s - x1_s; }
    [[nodiscard]] double dy() const noexcept { return y2 - y1; }
};

/// The values of a lane at the two time cursors, with straight lines between samples.
struct CursorValue {
    struct At {
        double value = kNotMeasured;
        int slope = 0;  ///< 1 on a rising edge, -1 on a falling edge, else 0
    };
    QString lane;
    std::array<At, 2> at;
};

/// Rounds a time to what samples at `rate_hz` can resolve; 0: rate unknown, no rounding.
[[nodiscard]] double knownTime(double time_s, double rate_hz);
/// "17.5 V": the level of a cursor, written the same way in flags, on the clipboard and in the caption of a picture.
[[nodiscard]] QString levelText(double level, const QString& unit);
/// Returns the distance of the time cursors as text: "Δ 200.0 µs · 1/Δ 5.000 kHz".
[[nodiscard]] QString spanText(const CursorReadout& readout, double rate_hz);
/// All readings in one line, for the clipboard and screen readers: "t₁ 0 s   t₂ 4.000 ms   Δ 4.000 ms   1/Δ 250.0 Hz …"
[[nodiscard]] QString readoutText(CursorReadout readout, double rate_hz);

class ScopeCursors {
public:
    using Pair = std::array<double, 2>;
    static constexpr int kNone = -1;

    /// The time cursors, in seconds on the screen's axis.
    [[nodiscard]] const std::optional<Pair>& time_s() const noexcept { return time_s_; }
    /// The level cursors, in the active lane's unit.
    [[nodiscard]] const std::optional<Pair>& level() const noexcept { return level_; }
    /// The cursor with the focus: 0 or 1 for time, 2 or 3 for level, or kNone.
    [[nodiscard]] int focused() const noexcept { return focused_; }
    [[nodiscard]] bool timeFocused() const noexcept { return time_s_ && focused_ >= 0 && focused_ < 2; }
    [[nodiscard]] bool levelFocused() const noexcept { return level_ && focused_ >= 2; }

    /// Shows the time cursors at two times; without them, within the view.
    void showTime(const Viewport& view, const std::optional<std::pair<double, double>>& at_s);
    void hideTime();
    /// Shows the level cursors at two levels; without them, or where they are not on the screen, around the zero.
    void showLevel(const LaneScale& scale, const std::optional<std::pair<double, double>>& at);
    void hideLevel();
    /// Does nothing if that cursor is hidden.
    void focus(int cursor);

    void placeTime(int which, double time_s) { (*time_s_)[static_cast<std::size_t>(which)] = time_s; }
    void placeLevel(int which, double level) { (*level_)[static_cast<std::size_t>(which)] = level; }
    /// Keeps the level cursors at their height on the screen, but converts their levels to another lane.
    void changeLane(const LaneScale& before, const LaneScale& after);
    [[nodiscard]] CursorReadout readout(const ScopeLane& active) const;
    [[nodiscard]] std::vector<CursorValue> values(const std::vector<ScopeLane>& lanes) const;

private:
    std::optional<Pair> time_s_;
    std::optional<Pair> level_;
    int focused_ = kNone;
};

/// The trigger's level and moment on the screen, and the drag of either.
class ScopeTrigger {
public:
    /// The lane whose level is shown; empty: no level is shown.
    [[nodiscard]] const QString& lane() const noexcept { return lane_; }
    /// In the lane's unit.
    [[nodiscard]] const SampleTrigger& its() const noexcept { return its_; }
    [[nodiscard]] double level() const noexcept { return its_.level; }
    /// True if the level follows the commanded amplitude and cannot be dragged.
    [[nodiscard]] bool held() const noexcept { return held_; }
    /// The moment to which the user dragged the trigger, or where a search found it, in seconds on the axis.
    [[nodiscard]] const std::optional<double>& moment_s() const noexcept { return moment_s_; }
    /// The text shown during a drag.
    [[nodiscard]] const QString& text() const noexcept { return text_; }

    /// Returns true if anything changed. A level that the user is dragging is not changed.
    bool set(const QString& lane, const SampleTrigger& its, bool held);
    /// Sets the share of the record before the trigger; nothing: this share cannot be set.
    void setFraction(std::optional<double> fraction) { fraction_ = fraction; }
    /// Drags the level, or the other threshold of a runt. Returns false if it cannot be dragged; dragMoment() does the
    /// same.
    bool dragLevel(bool other, double height, const LaneScale& scale, const QString& unit);
    bool dragMoment(double time_s, double length_s);
    void forgetMoment() { moment_s_.reset(); }
    void setMoment(std::optional<double> time_s) { moment_s_ = time_s; }
    /// Ends a drag. Returns the fraction that the user chose.
    std::optional<double> drop(double length_s);

private:
    [[nodiscard]] double fractionAt(double time_s, double length_s) const;

    QString lane_;
    SampleTrigger its_;
    bool held_ = false;
    bool levelDragged_ = false;
    std::optional<double> fraction_;
    std::optional<double> moment_s_;
    QString text_;
};

}  // namespace tacto::gui
