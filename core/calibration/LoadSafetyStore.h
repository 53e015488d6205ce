// LoadSafetyStore.h - the load-safety checks of a lab's stimulators: one file; no line is overwritten.
//
// A check writes one line when it begins and another, with the program's verdict, when it ends. Only the last line of
// each serial number is used, whatever its verdict: a check that failed, was undecided, was stopped or never ended
// replaces an earlier pass. A check on a simulated bench is used for no stimulator.
//
// The lines are chained (ChainedLines.h). If the file was changed, it cannot be read, and no check is used (hazard H9).
//
// Thread-safety: none; one owner. add() locks the file against other processes.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/Units.h"
#include "core/calibration/CalibrationStore.h"
#include "core/calibration/ChainedLines.h"

namespace tacto {

enum class CheckVerdict { Begun, Pass, Fail, Indeterminate, Stopped, None };
/// "begun", "pass", "fail", "indeterminate", "stopped"; "none" for a check that ended with an error.
[[nodiscard]] std::string_view nameOf(CheckVerdict verdict) noexcept;
/// Returns `None` for any other text.
[[nodiscard]] CheckVerdict checkVerdictFrom(std::string_view text) noexcept;

/// A limit set, identified by its content.
struct LimitSetHash {
    std::string id;      ///< id of the limit set: "paper"
    std::string sha256;  ///< digest of the limit file
    bool operator==(const LimitSetHash&) const = default;
};

/// How strong the trains of a check or of a session may become.
struct TrainReach {
    double amplitude_v = 0;  ///< the largest command
    double interval_s = 0;   ///< the shortest interval
    double phase_us = 0;     ///< width of a phase, times the number of pulses in a train
    // The range of loads for the worst case and for a person's |Z|; nothing: not known.
    std::optional<double> lowest_ohm{}, highest_ohm{};
    bool operator==(const TrainReach&) const = default;
};

/// The deviations that a check permits, in per cent; nothing: not known.
struct CheckTolerances {
    std::optional<double> load_pct{};       ///< tolerance of a load's value
    std::optional<double> amplitude_pct{};  ///< excess of the delivered over the commanded amplitude
    bool operator==(const CheckTolerances&) const = default;
};
/// Example: "allows 20 % for an amplitude over the command; at most 2 % is expected". Empty if `allowed` is known and
/// at most `widest`.
[[nodiscard]] std::string widerThan(const CheckTolerances& allowed, const CheckTolerances& widest);

struct LoadSafetyCheck {
    std::string serial;  ///< serial number of the stimulator's output, as from calibratedOutput(); not empty
    std::string device;  ///< the stimulator's name
    CalibrationDate made{};
    CheckVerdict verdict = CheckVerdict::Begun;
    bool simulated = false;                 ///< true if any device was simulated, replayed or emulated
    std::optional<SquareCentimetres> area;  ///< smallest electrode judged; nothing: not stated
    TrainReach reach;
    CheckTolerances tolerances;
    std::vector<LimitSetHash> limits;
    std::string scriptSha256;  ///< digest of the protocol file
    std::string session;       ///< file name of the session with the evidence
    std::string sessionHead;   ///< head of the session's hash chain at the end; empty before
    bool operator==(const LoadSafetyCheck&) const = default;
};

/// How long a pass stays valid (pilot.md section 3).
inline constexpr std::chrono::days kLoadSafetyHolds{30};

/// What a session requires of the check of its stimulator.
struct LoadSafetyNeed {
    std::string serial;
    CalibrationDate day{};
    std::string scriptSha256;  ///< digest of today's protocol
    SquareCentimetres area{0};
    TrainReach reach;            ///< the trains and loads that the check must cover
    CheckTolerances tolerances;  ///< the widest tolerances accepted
    std::vector<LimitSetHash> limits;
};

class LoadSafetyStore {
public:
    /// Reads the file; a missing file is an empty store. Errors: Io; ParseError naming the line that is not valid.
    [[nodiscard]] static Result<LoadSafetyStore> open(std::filesystem::path file);

    /// Appends and syncs. Errors: InvalidArgument for a check without serial, date, protocol or session, or a pass
    /// without the head of the session's hash chain; Io; ParseError if the file was damaged meanwhile.
    [[nodiscard]] Result<void> add(const LoadSafetyCheck& check);

    /// Returns the newest line of that serial from real devices; null if there is none.
    [[nodiscard]] const LoadSafetyCheck* latest(std::string_view serial) const;
    /// Returns the check that meets `need`. Errors: NotFound with one sentence: why there is none, what is accepted.
    [[nodiscard]] Result<LoadSafetyCheck> passed(const LoadSafetyNeed& need) const;

    [[nodiscard]] const std::vector<LoadSafetyCheck>& all() const noexcept { return all_; }

private:
    explicit LoadSafetyStore(std::filesystem::path file) : lines_(std::move(file), "load-safety check") {}
    [[nodiscard]] Result<void> read();

    ChainedLines lines_;
    std::vector<LoadSafetyCheck> all_;
};

/// In the folder of calibrationFile(): $XDG_DATA_HOME/tactoscope/load-safety.jsonl.
[[nodiscard]] std::filesystem::path loadSafetyFile();

}  // namespace tacto
