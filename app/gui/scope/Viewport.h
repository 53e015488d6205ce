// Viewport.h - which part of the record is on the screen, in divisions as on an oscilloscope: ten across, eight up,
// every scale a step of the 1-2-5 ladder; and the way back when a zoom was a mistake.
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

struct LaneScale {
    double perDivision = 1;  ///< in the lane's unit
    double position = 0;     ///< of its zero: divisions above the middle
    bool operator==(const LaneScale&) const = default;
};

struct Viewport {
    double left_s = -5e-3;  ///< on the plot's time axis
    double perDivision_s = 1e-3;
    std::map<QString, LaneScale> lanes;

    [[nodiscard]] double width_s() const noexcept { return perDivision_s * kDivisionsAcross; }
    [[nodiscard]] double right_s() const noexcept { return left_s + width_s(); }
    bool operator==(const Viewport&) const = default;
};

/// Rounded to a fiftieth of a division: no eye sees it, and axis labels stay short.
[[nodiscard]] double onGrid(double value, double perDivision);

/// `steps` along the ladder, what stands at `anchor_s` stays there. Steps above 0 show more time.
[[nodiscard]] Viewport zoomedInTime(Viewport view, int steps, double anchor_s);
/// The smallest time base that shows from..to, in the middle.
[[nodiscard]] Viewport showingTime(Viewport view, double from_s, double to_s);
/// Of one lane; the value at `anchor` divisions above the middle stays there.
[[nodiscard]] LaneScale zoomedInLevel(const LaneScale& lane, int steps, double anchor);
/// Shows the values that lie between two heights (divisions above the middle) on the whole screen.
[[nodiscard]] LaneScale showingHeights(const LaneScale& lane, double bottom, double top);
/// The smallest scale with which low..high fits into `height` divisions around `middle`.
[[nodiscard]] LaneScale fittingLevels(double low, double high, double middle, double height);

/// The same for a lane that is to be looked at: its zero on half a division, so that the axis has round numbers, and
/// all of it inside the screen, even if it has to leave the middle.
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

}  // namespace tacto::gui
