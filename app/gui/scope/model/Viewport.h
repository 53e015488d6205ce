// Viewport.h - which part of the record is on the screen, in divisions as on an oscilloscope: ten across, eight up;
// and the way back when a zoom was a mistake. Scales that are chosen are steps of the 1-2-5 ladder; a box and a fit to
// the pulse show exactly what they are named after, at any time per division.
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
    double position = 0;     ///< where its zero lies: divisions above the middle
    [[nodiscard]] double heightOf(double level) const noexcept { return level / perDivision + position; }
    [[nodiscard]] double levelAt(double height) const noexcept { return (height - position) * perDivision; }
    bool operator==(const LaneScale&) const = default;
};

struct Viewport {
    double left_s = -5e-3;  ///< on the plot's time axis
    double perDivision_s = 1e-3;
    std::map<QString, LaneScale> lanes;

    /// 1 a division, zero in the middle, for a lane that has none.
    [[nodiscard]] LaneScale scale(const QString& lane) const {
        const auto found = lanes.find(lane);
        return found == lanes.end() ? LaneScale{} : found->second;
    }
    [[nodiscard]] double width_s() const noexcept { return perDivision_s * kDivisionsAcross; }
    [[nodiscard]] double right_s() const noexcept { return left_s + width_s(); }
    bool operator==(const Viewport&) const = default;
};

/// Rounded to a fiftieth of a division: no eye sees it, and axis labels stay short.
[[nodiscard]] double onGrid(double value, double perDivision);

/// The smallest time base of the ladder on which samples of `rate_hz` still show a shape: four of them across.
[[nodiscard]] double leastPerDivision(double rate_hz);
/// `steps` along the ladder, not below `least_s` a division; what stands at `anchor_s` stays there. Steps above 0 show
/// more time.
[[nodiscard]] Viewport zoomedInTime(const Viewport& view, int steps, double anchor_s, double least_s = 0);
/// Sets another time base; what stands at `anchor_s` stays there.
[[nodiscard]] Viewport withTimeBase(Viewport view, double perDivision_s, double anchor_s);
/// Shows from..to and nothing else, from edge to edge; more around its middle where that is below `least_s` a division.
[[nodiscard]] Viewport spanningTime(Viewport view, double from_s, double to_s, double least_s = 0);
/// A pulse in the middle third, the time base in two digits.
[[nodiscard]] Viewport framingPulse(Viewport view, double from_s, double to_s);
/// The smallest time base of the ladder that shows from..to, in the middle.
[[nodiscard]] Viewport showingTime(Viewport view, double from_s, double to_s);
/// Zooms one lane; the value at `anchor` divisions above the middle stays there.
[[nodiscard]] LaneScale zoomedInLevel(const LaneScale& lane, int steps, double anchor);
/// The values between two heights (divisions above the middle) and nothing else, from edge to edge.
[[nodiscard]] LaneScale showingHeights(const LaneScale& lane, double bottom, double top);
/// The smallest scale with which low..high fits into `height` divisions around `middle`.
[[nodiscard]] LaneScale fittingLevels(double low, double high, double middle, double height);

/// One of two lanes that reach to both sides of zero: all of it in 2.5 divisions either way. With zeros three divisions
/// apart two lanes of the same course never cross.
[[nodiscard]] LaneScale aroundZero(double low, double high, double position);

/// Like fittingLevels(), for a lane that is to be looked at: its zero on half a division, so that the axis has round
/// numbers, and all of it inside the screen, even if it has to leave the middle.
[[nodiscard]] LaneScale restingLevels(double low, double high, double middle, double height);

/// Views to go back to. Turns of the same kind that follow within moments are one: a turn of the wheel is undone whole.
/// An empty kind is never joined to another.
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

/// The smallest step of the 1-2-5 ladder (1, 2, 5, 10, 20, 50, ... in every decade) not below `value`, which is above
/// 0.
[[nodiscard]] double stepNotBelow(double value);
/// `steps` further on the ladder; a value between two steps is one away from either.
[[nodiscard]] double stepAlong(double value, int steps);
/// All steps from low to high, both included where they are steps.
[[nodiscard]] std::vector<double> stepsBetween(double low, double high);

}  // namespace tacto::gui
