#include "core/analysis/calibration/CalibrationFile.h"

#include <cmath>
#include <limits>

#include "core/base/Csv.h"
#include "core/base/Statistics.h"
#include "core/base/Text.h"

namespace tacto {

namespace {

/// A finite number, or NaN where `mayLack` and the field is empty or says nan.
Result<double> numberIn(const NamedRows& rows, std::size_t index, std::string_view column, bool mayLack, double least) {
    const auto field = rows[index];
    if (field.empty() && mayLack) return kNaN;
    const auto number = parseNumber(field);
    if (number && ((std::isfinite(*number) && *number >= least) || (std::isnan(*number) && mayLack))) return *number;
    return rows.refuse("{} '{}'; a finite number{} was expected{}", column, field.substr(0, 40),
                       std::isfinite(least) ? " of 0 or more" : "", mayLack ? ", or nothing" : "");
}

Result<SweepDirection> directionIn(const NamedRows& rows, std::size_t index) {
    const auto field = rows[index];
    if (const auto known = valueFor(kSweepDirections, field)) return *known;
    return rows.refuse("direction '{}'; up, down or nothing was expected", field.substr(0, 40));
}

}  // namespace

Result<std::vector<CalibrationReading>> readCalibrationReadings(const std::filesystem::path& path) {
    const auto text = readTextFile(path);
    if (!text) return failure(text);
    return parseCalibrationReadings(*text, path.string());
}

Result<std::vector<CalibrationReading>> parseCalibrationReadings(std::string_view text, std::string_view name) {
    constexpr double kAny = -std::numeric_limits<double>::infinity();
    NamedRows rows(text, name, "columns commanded and measured, and perhaps direction and u, were expected",
                   "a row per reading");
    const auto commanded = rows.column({"commanded"});
    if (!commanded) return failure(commanded);
    const auto measured = rows.column({"measured"});
    if (!measured) return failure(measured);
    const auto direction = rows.find({"direction"});
    const auto uncertainty = rows.find({"u"});

    std::vector<CalibrationReading> readings;
    auto more = rows.next();
    for (; more && *more; more = rows.next()) {
        CalibrationReading reading;
        const auto command = numberIn(rows, *commanded, "commanded", false, kAny);
        if (!command) return failure(command);
        reading.commanded = *command;
        const auto value = numberIn(rows, *measured, "measured", true, kAny);
        if (!value) return failure(value);
        reading.measured = *value;
        if (direction) {
            const auto turned = directionIn(rows, *direction);
            if (!turned) return failure(turned);
            reading.direction = *turned;
        }
        if (uncertainty) {
            const auto u = numberIn(rows, *uncertainty, "u", true, 0);
            if (!u) return failure(u);
            reading.uncertainty = *u;
        }
        readings.push_back(reading);
    }
    if (!more) return failure(more);
    return readings;
}

}  // namespace tacto
