// ScopeTrigger.h - the trigger on the oscilloscope's screen: its level and its moment, and a drag of either.
//
// Thread-safety: one owner.
#pragma once

#include <QString>
#include <optional>

#include "app/gui/scope/model/Viewport.h"

namespace tacto::gui {

class ScopeTrigger {
public:
    /// Empty: no level is shown.
    [[nodiscard]] const QString& lane() const noexcept { return lane_; }
    /// In the lane's unit.
    [[nodiscard]] double level() const noexcept { return level_; }
    /// The level follows the command and cannot be dragged.
    [[nodiscard]] bool held() const noexcept { return held_; }
    /// Where the moment was dragged to, in seconds on the axis.
    [[nodiscard]] const std::optional<double>& moment_s() const noexcept { return moment_s_; }
    /// What is said while it is dragged.
    [[nodiscard]] const QString& text() const noexcept { return text_; }

    /// Returns whether anything is another. A level that is being dragged stays: the hand on it knows better.
    bool set(const QString& lane, double level, bool held);
    /// The share of the record before the trigger; nothing: the record cannot be set.
    void setFraction(std::optional<double> fraction) { fraction_ = fraction; }
    /// False where it cannot be dragged; so below.
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
