// CalibrationStore.h - the calibrations of a lab's stimulators: one file, a line per calibration, never overwritten.
//
// The lines are chained (ChainedLines.h). A newer calibration of a serial supersedes the older one, which is kept.
//
// A calibration holds for one serial and one kind of source, until a date at most a year later, and only with its
// provenance: the session with its readings, and the stated accuracy of their instrument. If this is missing, expired
// or damaged, the stimulator is *not calibrated*, never "assumed good" (hazards H1 and H9).
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

// The dates on which calibrations and certificates are made and become due.

template <class T>
struct ValueKind;

/// A calendar date, UTC.
using CalibrationDate = std::chrono::year_month_day;
/// "2026-11-21". Returns nothing for another form or a day that does not exist.
[[nodiscard]] std::optional<CalibrationDate> parseDate(std::string_view text);
[[nodiscard]] std::string dateText(CalibrationDate date);
/// The value kind for a date in a record: the date as text.
[[nodiscard]] ValueKind<CalibrationDate> dateKind();
[[nodiscard]] constexpr int daysBetween(CalibrationDate from, CalibrationDate to) {
    return static_cast<int>((std::chrono::sys_days(to) - std::chrono::sys_days(from)).count());
}
/// Today, UTC.
[[nodiscard]] CalibrationDate utcToday();

/// An instrument used for a calibration.
struct CalibrationInstrument {
    std::string name;
    std::string serial;
    std::optional<CalibrationDate> due;     ///< when the instrument's own calibration is due; nothing: not stated
    std::optional<double> gainTolerance{};  ///< half-width of its gain, relative; nothing: not stated
    std::string statedBy{};                 ///< "the instrument" or "the operator"; empty if not stated
};

/// The calibrated values of one quantity, and their uncertainty.
struct StoredLine : CalibrationLine {
    double uncertainty_pct = 0;  ///< U (95 %) of the delivered value, largest over the levels, in % of the command
    /// The largest distance of a level's mean from the line, in the quantity's unit. Older files do not contain it.
    std::optional<double> residual{};
};

struct StoredCalibration {
    std::string serial;  ///< the stimulator's serial number; not empty
    std::string device;  ///< the stimulator's name
    std::string unit;    ///< "V" or "mA", depending on the source; also the unit of the amplitude's line
    StoredLine amplitude;
    std::optional<StoredLine> interval, phaseWidth, gap;  ///< s; if one is missing, the calibration never holds
    CalibrationDate made{};
    CalibrationDate validUntil{};  ///< the last day on which the calibration holds
    bool simulated = false;        ///< true if the device, or an instrument that measured it, was simulated
    std::string session;           ///< file name of the session with the readings
    std::string sessionHead;       ///< head of the session's hash chain when this was stored: 64 hexadecimal digits
    std::size_t readings = 0;      ///< number of readings in that session from which the lines were computed
    std::vector<CalibrationInstrument> instruments;
};

inline constexpr auto kStoredTimes = kTimeLines<StoredCalibration>;
/// Returns the lines with their spread: U and the largest residual. If the residual is not stated: U alone, or ± 5 %
/// if that is more.
[[nodiscard]] StimulatorCalibration linesOf(const StoredCalibration& stored);

inline constexpr std::chrono::days kLongestValidity{366};
/// Checks that the program computed the calibration from readings in a session. Errors: InvalidArgument for a
/// calibration without a session, readings or an instrument of stated accuracy, or one that claims to hold longer than
/// kLongestValidity.
[[nodiscard]] Result<void> checkProvenance(const StoredCalibration& calibration);

class CalibrationStore {
public:
    /// Reads the file; a missing file is an empty store. Errors: Io; ParseError naming the line that is not valid.
    [[nodiscard]] static Result<CalibrationStore> open(std::filesystem::path file);

    /// Appends and syncs. Errors: InvalidArgument for a calibration without serial, unit, one of the four lines,
    /// provenance or valid numbers and dates, or with an instrument that was overdue when it was used; Io; ParseError
    /// if the file was damaged meanwhile.
    [[nodiscard]] Result<void> add(const StoredCalibration& calibration);

    /// Returns the newest calibration with that serial and unit, whatever its date.
    [[nodiscard]] const StoredCalibration* latest(std::string_view serial, std::string_view unit) const;
    /// Returns the newest calibration of known provenance, whatever its date; the limits use it. A calibration from a
    /// simulated bench is used for simulated devices only.
    [[nodiscard]] const StoredCalibration* proven(std::string_view serial, std::string_view unit, bool simulated) const;
    /// Returns the calibration that holds on `day`. Errors: NotFound saying why there is none: never calibrated,
    /// expired (and when), no times, no provenance, or made on a simulated bench for a real device.
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

// One calibration as the store writes it to the file.

/// Errors: InvalidArgument naming the value and what is accepted.
[[nodiscard]] Result<void> check(const StoredCalibration& calibration);
[[nodiscard]] nlohmann::json toJson(const StoredCalibration& calibration);
/// Errors: ParseError naming the key; as check().
[[nodiscard]] Result<StoredCalibration> storedCalibrationFrom(const nlohmann::json& json);

}  // namespace tacto
