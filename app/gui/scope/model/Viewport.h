// Viewport.h - the visible part of the record in divisions, as on an oscilloscope (ten across, eight up), and the views
// to return to after a zoom. The user chooses scales from the 1-2-5 ladder. A box zoom or a fit to the pulse shows
// exactly its range, at any time per division.
//
// Thread-safety: values; ViewHistory has one owner.
#pragma once

#include <QElapsedTimer>
#include <QString>
#include <map>
#include <optional>
#include <vector>

namespace tacto::gui {

inline constexpr int kDivisionsAcross = 10;
inline constexpr int kDivisionsUp = 8;
inline constexpr double kHalfUp = kDivisionsUp / 2.0;  ///< from the middle to the top

struct LaneScale {
    double perDivision = 1;  ///< in the lane's unit
    double position = 0;     ///< height of the lane's zero, in divisions above the middle
    [[nodiscard]] double heightOf(double level) const noexcept { return level / perDivision + position; }
    [[nodiscard]] double levelAt(double height) const noexcept { return (height - position) * perDivision; }
    bool operator==(const LaneScale&) const = default;
};

struct Viewport {
    double left_s = -5e-3;  ///< on the plot's time axis
    double perDivision_s = 1e-3;
    std::map<QString, LaneScale> lanes;

    /// Returns the lane's scale. Default: 1 per division with zero in the middle.
    [[nodiscard]] LaneScale scale(const QString& lane) const {
        const auto found = lanes.find(lane);
        return found == lanes.end() ? LaneScale{} : found->second;
    }
    [[nodiscard]] double width_s() const noexcept { return perDivision_s * kDivisionsAcross; }
    [[nodiscard]] double right_s() const noexcept { return left_s + width_s(); }
    bool operator==(const Viewport&) const = default;
};

/// Rounds to a fiftieth of a division: too small to see, and axis labels stay short.
[[nodiscard]] double onGrid(double value, double perDivision);

/// Returns the smallest time base of the ladder at which samples at `rate_hz` still show a shape: four on the screen.
[[nodiscard]] double leastPerDivision(double rate_hz);
/// Zooms `steps` along the ladder, not below `least_s` per division; the point at `anchor_s` does not move. Steps above
/// 0 show more time.
[[nodiscard]] Viewport zoomedInTime(const Viewport& view, int steps, double anchor_s, double least_s = 0);
/// Sets another time base; the point at `anchor_s` does not move.
[[nodiscard]] Viewport withTimeBase(Viewport view, double perDivision_s, double anchor_s);
/// Shows exactly from_s to to_s across the screen, or more around the middle if it were below `least_s` per division.
[[nodiscard]] Viewport spanningTime(Viewport view, double from_s, double to_s, double least_s = 0);
/// Shows a pulse in the middle third, with a time base of two digits.
[[nodiscard]] Viewport framingPulse(Viewport view, double from_s, double to_s);
/// Shows from_s to to_s in the middle with the smallest sufficient time base of the ladder.
[[nodiscard]] Viewport showingTime(Viewport view, double from_s, double to_s);
/// Zooms one lane; the value at `anchor` divisions above the middle does not move.
[[nodiscard]] LaneScale zoomedInLevel(const LaneScale& lane, int steps, double anchor);
/// Shows exactly the values between two heights (divisions above the middle) from bottom to top of the screen.
[[nodiscard]] LaneScale showingHeights(const LaneScale& lane, double bottom, double top);
/// Returns the smallest scale at which low..high fits into `height` divisions around `middle`.
[[nodiscard]] LaneScale fittingLevels(double low, double high, double middle, double height);

/// Returns the scale of one of two lanes with values on both sides of zero: all values fit within 2.5 divisions on each
/// side. If the zeros are three divisions apart, two lanes of the same course never cross.
[[nodiscard]] LaneScale aroundZero(double low, double high, double position);

/// Like fittingLevels(), for easy reading: the zero lies on half a division, so the axis has round numbers, and all
/// values are on the screen, even if the lane must move away from `middle`.
[[nodiscard]] LaneScale restingLevels(double low, double high, double middle, double height);

/// Views to return to. Changes of the same kind in quick succession are one entry, so that a turn of the wheel is
/// undone as a whole. Changes with an empty kind are never joined.
class ViewHistory {
public:
    void remember(const Viewport& view, const QString& kind);
    [[nodiscard]] std::optional<Viewport> undo();
    [[nodiscard]] bool empty() const noexcept { return views_.empty(); }

private:
    std::vector<Viewport> views_;
    QString lastKind_;
    QElapsedTimer since_;
};

/// Returns the smallest step of the 1-2-5 ladder (1, 2, 5, 10, 20, 50, ... in every decade) that is at least `value`,
/// which must be above 0.
[[nodiscard]] double stepNotBelow(double value);
/// Moves `steps` along the ladder; from a value between two steps, the nearest step on either side is one away.
[[nodiscard]] double stepAlong(double value, int steps);
/// Returns all steps from low to high, inclusive.
[[nodiscard]] std::vector<double> stepsBetween(double low, double high);

}  // namespace tacto::gui
