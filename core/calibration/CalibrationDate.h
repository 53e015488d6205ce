// CalibrationDate.h - the days on which calibrations and certificates are made and fall due.
//
// Thread-safety: pure functions.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <string_view>

namespace tacto {

template <class T>
struct ValueKind;

/// A calendar date, UTC.
using CalibrationDate = std::chrono::year_month_day;
/// "2026-11-21". Nothing for another form or a day that does not exist.
[[nodiscard]] std::optional<CalibrationDate> parseDate(std::string_view text);
[[nodiscard]] std::string dateText(CalibrationDate date);
/// As the field of a record: its text.
[[nodiscard]] ValueKind<CalibrationDate> dateKind();
[[nodiscard]] constexpr int daysBetween(CalibrationDate from, CalibrationDate to) {
    return static_cast<int>((std::chrono::sys_days(to) - std::chrono::sys_days(from)).count());
}
/// Today, UTC.
[[nodiscard]] CalibrationDate utcToday();

}  // namespace tacto
