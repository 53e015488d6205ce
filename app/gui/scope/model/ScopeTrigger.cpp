#include "app/gui/scope/model/ScopeTrigger.h"

#include <QObject>
#include <algorithm>
#include <cmath>

#include "app/report/NumberText.h"

namespace tacto::gui {

bool ScopeTrigger::set(const QString& lane, double level, bool held) {
    if (lane_ == lane && level_ == level && held_ == held) return false;
    if (levelDragged_ && !held) return false;
    lane_ = lane;
    level_ = level;
    held_ = held;
    return true;
}

bool ScopeTrigger::dragLevel(double height, const LaneScale& scale, const QString& unit) {
    if (held_) return false;
    // Whole hundredths of a division: a level is chosen with the eye, not to the last digit.
    const double grain = scale.perDivision / 100;
    levelDragged_ = true;
    level_ = std::round(scale.levelAt(height) / grain) * grain;
    text_ = QObject::tr("Trigger at %1").arg(quantityText(level_, unit, 3));
    return true;
}

double ScopeTrigger::fractionAt(double time_s, double length_s) const {
    return std::clamp(*fraction_ + time_s / length_s, 0.0, 1.0);
}

bool ScopeTrigger::dragMoment(double time_s, double length_s) {
    if (!fraction_) return false;
    const double chosen = fractionAt(time_s, length_s);
    moment_s_ = (chosen - *fraction_) * length_s;
    text_ = QObject::tr("%1 of the record before the trigger").arg(quantityText(100 * chosen, "%", 2));
    return true;
}

std::optional<double> ScopeTrigger::drop(double length_s) {
    levelDragged_ = false;
    text_.clear();
    const auto moment_s = std::exchange(moment_s_, std::nullopt);
    if (!moment_s || !fraction_) return {};
    fraction_ = fractionAt(*moment_s, length_s);
    return fraction_;
}

}  // namespace tacto::gui
