// What the calibration of a stimulator begins and ends with.
#include <algorithm>
#include <cmath>

#include "app/scripting/host/calibration/CalibrationObject.h"
#include "app/scripting/host/report/Cells.h"
#include "core/base/QuantityText.h"

namespace tacto::host::calibration {

namespace {

constexpr double kClock_pct = 0.5;  // how far intervals may be from the computer's clock (choice)

using report::numberIn;

struct RangeKeys {
    const char* quantity;
    const char* low;
    const char* high;
    double perUnit;  // of the range, to one of the stored line
};
constexpr RangeKeys kRanges[] = {{"amplitude", "amplitude_min_v", "amplitude_max_v", 1},
                                 {"interval", "interval_min_s", "interval_max_s", 1},
                                 {"width", "width_min_us", "width_max_us", 1e6},
                                 {"gap", "gap_min_us", "gap_max_us", 1e6}};

}  // namespace

Result<Json> knownRanges(ScriptSession&, const Arguments& arguments) {
    const Json& stored = arguments.object("stored");
    Json ranges = arguments.object("ranges");
    for (const auto& [quantity, low, high, perUnit] : kRanges) {
        const Json line = stored.value(quantity, Json::object());
        const double lowest = perUnit * numberIn(line, "lowest"), highest = perUnit * numberIn(line, "highest");
        const double from = numberIn(ranges, low), to = numberIn(ranges, high);
        if (std::isnan(lowest) || std::isnan(highest))
            return arguments.wrong("stored", stored, "what bench.calibration holds");
        if (std::isnan(from) || std::isnan(to)) {
            return arguments.wrong("ranges", arguments.object("ranges"),
                                   fmt::format("an object with {} and {}", low, high));
        }
        if (line.value("unit", Json()) == "mA") continue;
        ranges[low] = std::max(lowest, from);
        ranges[high] = std::min(highest, to);
    }
    return ranges;
}

Result<Json> timeBase(ScriptSession&, const Arguments& arguments) {
    const Json& found = arguments.any("interval");
    if (found.is_null()) return Json("");
    if (!found.is_object()) return arguments.wrong("interval", found, "what analysis.calibration() returned");
    const double off_pct = 100 * std::abs(numberIn(found, "gain") - 1);
    const double expanded_pct = 100 * numberIn(found, "gain_expanded_uncertainty");
    if (off_pct + expanded_pct <= kClock_pct) return Json("");
    return Json(fmt::format(
        "the time base is not sure: intervals by the computer's clock are read {} off, at most {} % is allowed "
        "(choice)",
        measuredText(off_pct, expanded_pct, "%"), kClock_pct));
}

}  // namespace tacto::host::calibration
