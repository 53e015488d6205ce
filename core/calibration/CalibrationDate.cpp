#include "core/calibration/CalibrationDate.h"

#include <fmt/format.h>

#include "core/base/RecordFields.h"
#include "core/base/WholeNumber.h"

namespace tacto {

std::optional<CalibrationDate> parseDate(std::string_view text) {
    if (text.size() != 10 || text[4] != '-' || text[7] != '-') return std::nullopt;
    const auto number = [&](std::size_t from, std::size_t length) -> std::optional<int> {
        const auto value = parseWhole<int>(text.substr(from, length));
        return value && *value >= 0 ? value : std::nullopt;
    };
    const auto year = number(0, 4), month = number(5, 2), day = number(8, 2);
    if (!year || !month || !day) return std::nullopt;
    const CalibrationDate date{std::chrono::year(*year), std::chrono::month(static_cast<unsigned>(*month)),
                               std::chrono::day(static_cast<unsigned>(*day))};
    return date.ok() ? std::optional(date) : std::nullopt;
}

std::string dateText(CalibrationDate date) {
    return fmt::format("{:04}-{:02}-{:02}", static_cast<int>(date.year()), static_cast<unsigned>(date.month()),
                       static_cast<unsigned>(date.day()));
}

ValueKind<CalibrationDate> dateKind() {
    return codedKind<CalibrationDate>(
        "a date as \"2026-11-21\"",
        [](const nlohmann::json& value) {
            return value.is_string() ? parseDate(value.get<std::string>()) : std::nullopt;
        },
        [](const CalibrationDate& date) { return nlohmann::json(dateText(date)); });
}

CalibrationDate utcToday() { return std::chrono::floor<std::chrono::days>(std::chrono::system_clock::now()); }

}  // namespace tacto
