#include "core/analysis/CalibrationFile.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/Csv.h"
#include "core/base/NaN.h"
#include "core/base/Text.h"

namespace tacto {

namespace {

constexpr std::string_view kExpected = "columns commanded and measured, and perhaps direction and u, were expected";

struct Columns {
    std::size_t commanded = 0;
    std::size_t measured = 0;
    std::optional<std::size_t> direction;
    std::optional<std::size_t> uncertainty;
    std::size_t needed = 0;  ///< fields of a row
};

/// A place in the file, for messages.
struct Place {
    std::string_view name;
    std::size_t line;
};

Result<Columns> findColumns(const std::vector<std::string_view>& header, Place at) {
    const auto called = [&header](std::string_view name) -> std::optional<std::size_t> {
        const auto found = std::find(header.begin(), header.end(), name);
        if (found == header.end()) return std::nullopt;
        return static_cast<std::size_t>(found - header.begin());
    };
    const auto commanded = called("commanded");
    const auto measured = called("measured");
    if (!commanded || !measured) {
        return fail(ErrorCode::ParseError, "{}:{}: no column '{}'; {}", at.name, at.line,
                    commanded ? "measured" : "commanded", kExpected);
    }
    Columns columns{*commanded, *measured, called("direction"), called("u"), 0};
    columns.needed =
        std::max({*commanded, *measured, columns.direction.value_or(0), columns.uncertainty.value_or(0)}) + 1;
    return columns;
}

/// A finite number, or NaN where `mayLack` and the field is empty or says nan.
Result<double> numberIn(std::string_view field, std::string_view column, bool mayLack, double least, Place at) {
    if (field.empty() && mayLack) return kNaN;
    const auto number = parseNumber(field);
    if (number && ((std::isfinite(*number) && *number >= least) || (std::isnan(*number) && mayLack))) return *number;
    return fail(ErrorCode::ParseError, "{}:{}: {} '{}'; a finite number{} was expected{}", at.name, at.line, column,
                field.substr(0, 40), std::isfinite(least) ? " of 0 or more" : "", mayLack ? ", or nothing" : "");
}

Result<SweepDirection> directionIn(std::string_view field, Place at) {
    for (const auto direction : {SweepDirection::None, SweepDirection::Up, SweepDirection::Down}) {
        if (field == nameOf(direction)) return direction;
    }
    return fail(ErrorCode::ParseError, "{}:{}: direction '{}'; up, down or nothing was expected", at.name, at.line,
                field.substr(0, 40));
}

Result<CalibrationReading> readingIn(const std::vector<std::string_view>& fields, const Columns& columns, Place at) {
    constexpr double kAny = -std::numeric_limits<double>::infinity();
    CalibrationReading reading;
    auto commanded = numberIn(fields[columns.commanded], "commanded", false, kAny, at);
    if (!commanded) return failure(commanded);
    reading.commanded = *commanded;
    auto measured = numberIn(fields[columns.measured], "measured", true, kAny, at);
    if (!measured) return failure(measured);
    reading.measured = *measured;
    if (columns.direction) {
        auto direction = directionIn(fields[*columns.direction], at);
        if (!direction) return failure(direction);
        reading.direction = *direction;
    }
    if (columns.uncertainty) {
        auto uncertainty = numberIn(fields[*columns.uncertainty], "u", true, 0, at);
        if (!uncertainty) return failure(uncertainty);
        reading.uncertainty = *uncertainty;
    }
    return reading;
}

}  // namespace

Result<std::vector<CalibrationReading>> readCalibrationReadings(const std::filesystem::path& path) {
    const auto text = readTextFile(path);
    if (!text) return failure(text);
    return parseCalibrationReadings(*text, path.string());
}

Result<std::vector<CalibrationReading>> parseCalibrationReadings(std::string_view text, std::string_view name) {
    CsvReader reader(text);
    if (!reader.next()) return fail(ErrorCode::ParseError, "{}: the file is empty; {}", name, kExpected);
    const auto columns = findColumns(reader.fields(), {name, reader.line()});
    if (!columns) return failure(columns);
    std::vector<CalibrationReading> readings;
    while (reader.next()) {
        const Place at{name, reader.line()};
        if (reader.fields().size() < columns->needed) {
            return fail(ErrorCode::ParseError, "{}:{}: {} fields; at least {} were expected, as in the header", name,
                        at.line, reader.fields().size(), columns->needed);
        }
        auto reading = readingIn(reader.fields(), *columns, at);
        if (!reading) return failure(reading);
        readings.push_back(*reading);
    }
    if (readings.empty()) {
        return fail(ErrorCode::ParseError, "{}: nothing after the header line; a row per reading was expected", name);
    }
    return readings;
}

}  // namespace tacto
