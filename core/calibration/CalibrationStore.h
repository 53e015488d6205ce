// CalibrationStore.h - the calibrations of a lab's stimulators: one file, a line per calibration, never overwritten.
//
// The lines are chained (ChainedLines.h). A newer calibration of the same serial supersedes the older one, which stays.
//
// A calibration counts for one serial and one kind of source, until a date at most a year later, and only with its
// provenance: the session that holds its readings, and the stated accuracy of the instrument that took them. What is
// missing, expired, damaged or without provenance is *not calibrated*, never "assumed good" (hazards H1 and H9).
//
// Thread-safety: none; one owner. add() locks the file against other processes.
#pragma once

#include <array>
#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/Result.h"
#include "core/calibration/ChainedLines.h"
#include "core/encoding/StimulatorCalibration.h"

namespace tacto {

// The days on which calibrations and certificates are made and fall due.

template <class T>
struct ValueKind;

/// A calendar date, UTC.
using CalibrationDate = std::chrono::year_month_day;
/// "2026-11-21". Nothing for another form or a day that does not exist.
[[nodiscard]] std::optional<CalibrationDate> parseDate(std::string_view text);
[[nodiscard]] std::string dateText(CalibrationDate date);
/// The kind of a date as the field of a record: its text.
[[nodiscard]] ValueKind<CalibrationDate> dateKind();
[[nodiscard]] constexpr int daysBetween(CalibrationDate from, CalibrationDate to) {
    return static_cast<int>((std::chrono::sys_days(to) - std::chrono::sys_days(from)).count());
}
/// Today, UTC.
[[nodiscard]] CalibrationDate utcToday();

/// An instrument that a calibration rests on.
struct CalibrationInstrument {
    std::string name;
    std::string serial;
    std::optional<CalibrationDate> due;     ///< when its own calibration is due; nothing: it was not stated
    std::optional<double> gainTolerance{};  ///< the gain's half-width, relative; nothing: not stated
    std::string statedBy{};                 ///< "the instrument" or "the operator"; empty where it was not stated
};

/// The calibrated values of one quantity, and how surely they are known.
struct StoredLine : CalibrationLine {
    double uncertainty_pct = 0;  ///< U (95 %) of what is delivered, largest over the levels, in % of the command
    /// The largest distance of a level's mean from the line, in the quantity's unit. Older files do not state it.
    std::optional<double> residual{};
};

struct StoredCalibration {
    std::string serial;  ///< the stimulator's; not empty
    std::string device;  ///< its name
    std::string unit;    ///< "V" or "mA": of the source that was calibrated, and of the amplitude's line
    StoredLine amplitude;
    std::optional<StoredLine> interval, phaseWidth, gap;  ///< s; one that lacks a line is read, and holds for nothing
    CalibrationDate made{};
    CalibrationDate validUntil{};  ///< the last day on which it counts
    bool simulated = false;        ///< whether the device, or what measured it, was simulated
    std::string session;           ///< file name of the session that holds the readings
    std::string sessionHead;       ///< head of its hash chain when this was kept: 64 hexadecimal digits
    std::size_t readings = 0;      ///< how many readings of that session the lines were computed from
    std::vector<CalibrationInstrument> instruments;
};

inline constexpr auto kStoredTimes = kTimeLines<StoredCalibration>;
/// The lines with their spread: U and the largest residual. Where the residual is not stated, U alone, or ± 5 % where
/// that is more.
[[nodiscard]] StimulatorCalibration linesOf(const StoredCalibration& stored);

inline constexpr std::chrono::days kLongestValidity{366};
/// Checks that the program itself computed it from readings that a session holds. Errors: InvalidArgument for a
/// calibration without session, readings or an instrument whose accuracy is stated, or one that claims to hold longer
/// than kLongestValidity.
[[nodiscard]] Result<void> checkProvenance(const StoredCalibration& calibration);

class CalibrationStore {
public:
    /// Reads the file; one that is not there is empty. Errors: Io; ParseError naming the line that does not check.
    [[nodiscard]] static Result<CalibrationStore> open(std::filesystem::path file);

    /// Appends and syncs. Errors: InvalidArgument for a calibration without serial, unit, one of the four lines,
    /// provenance or valid numbers and dates, or an instrument that was overdue on the day it was used; Io; ParseError
    /// when the file was damaged meanwhile.
    [[nodiscard]] Result<void> add(const StoredCalibration& calibration);

    /// The newest with that serial and unit, whatever its date.
    [[nodiscard]] const StoredCalibration* latest(std::string_view serial, std::string_view unit) const;
    /// The newest with a known provenance, whatever its date: the limits are judged by it. A simulated bench's
    /// calibration serves a simulated device only.
    [[nodiscard]] const StoredCalibration* proven(std::string_view serial, std::string_view unit, bool simulated) const;
    /// The calibration that counts on `day`. Errors: NotFound saying why there is none: never calibrated, expired (and
    /// when), without its times or its provenance, or made on a simulated bench for a real device.
    [[nodiscard]] Result<StoredCalibration> valid(std::string_view serial, std::string_view unit, CalibrationDate day,
                                                  bool simulated) const;

    [[nodiscard]] const std::vector<StoredCalibration>& all() const noexcept { return all_; }
    [[nodiscard]] bool lastLineCut() const noexcept { return lines_.lastLineCut(); }

private:
    explicit CalibrationStore(std::filesystem::path file) : lines_(std::move(file), "calibration") {}
    [[nodiscard]] Result<void> read();

    ChainedLines lines_;
    std::vector<StoredCalibration> all_;
};

/// $XDG_DATA_HOME/tactoscope/calibrations.jsonl, or ~/.local/share/tactoscope/calibrations.jsonl.
[[nodiscard]] std::filesystem::path calibrationFile();

// One calibration as the store writes it.

/// Errors of check(): InvalidArgument naming the value and what is accepted.
[[nodiscard]] Result<void> check(const StoredCalibration& calibration);
[[nodiscard]] nlohmann::json toJson(const StoredCalibration& calibration);
/// Errors: ParseError naming the key; as check().
[[nodiscard]] Result<StoredCalibration> storedCalibrationFrom(const nlohmann::json& json);

}  // namespace tacto
