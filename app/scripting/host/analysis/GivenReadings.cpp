#include "app/scripting/host/analysis/GivenReadings.h"

#include "app/scripting/engine/Arguments.h"
#include "core/base/JsonFields.h"

namespace tacto::host::analysis {

tl::unexpected<Error> otherThanExpected(std::string_view function, std::string_view name, const nlohmann::json& value,
                                        std::string_view accepted) {
    return fail(ErrorCode::InvalidArgument, "{}: {} is {}, {} is expected", function, name, shown(value), accepted);
}

Result<SweepDirection> directionGiven(std::string_view function, const nlohmann::json& row) {
    const auto given = row.value("direction", nlohmann::json(""));
    const auto known =
        given.is_string() ? valueFor(kSweepDirections, given.get_ref<const std::string&>()) : std::nullopt;
    if (!known) return otherThanExpected(function, "direction", given, "\"up\", \"down\" or \"\"");
    return *known;
}

Result<std::vector<CalibrationReading>> readingsGiven(std::string_view function, const nlohmann::json& rows) {
    std::vector<CalibrationReading> readings;
    for (const auto& row : rows) {
        CalibrationReading reading;
        reading.commanded = numberOr(row, "commanded");
        if (!std::isfinite(reading.commanded))
            return otherThanExpected(function, "a reading", row, "an object with commanded, measured and direction");
        reading.measured = numberOr(row, "measured");
        const auto direction = directionGiven(function, row);
        if (!direction) return failure(direction);
        reading.direction = *direction;
        readings.push_back(reading);
    }
    return readings;
}

}  // namespace tacto::host::analysis
