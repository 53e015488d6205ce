// LoadSafetyStore.h - the load-safety checks of a lab's stimulators: one file, never overwritten.
//
// A check has a line when it begins and another when it ends, with the program's own verdict. The last line of each
// serial number counts, whatever it says: a check that failed, was not decided, was stopped or never ended takes the
// place of an earlier pass. A check on a simulated bench counts for no stimulator.
//
// The lines are chained (ChainedLines.h). A file that was changed cannot be read, and then no check counts (hazard H9).
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
/// "begun", "pass", "fail", "indeterminate", "stopped"; "none" of a check that ended by an error.
[[nodiscard]] std::string_view nameOf(CheckVerdict verdict) noexcept;
/// `None` for another text.
[[nodiscard]] CheckVerdict checkVerdictFrom(std::string_view text) noexcept;

/// A limit set by what it holds.
struct LimitSetHash {
    std::string id;      ///< "paper"
    std::string sha256;  ///< digest of the limit file's bytes
    bool operator==(const LimitSetHash&) const = default;
};

/// How strong the trains of a check, or of a session, may get.
struct TrainReach {
    double amplitude_v = 0;  ///< the largest command
    double interval_s = 0;   ///< the shortest interval
    double phase_us = 0;     ///< width of a phase, times the pulses of a train
    // The loads for which the worst case is judged, and in which a person's |Z| lies; nothing: not known.
    std::optional<double> lowest_ohm{}, highest_ohm{};
    bool operator==(const TrainReach&) const = default;
};

/// What a check lets pass, per cent; nothing: not known.
struct CheckTolerances {
    std::optional<double> load_pct{};       ///< tolerance of a load's value
    std::optional<double> amplitude_pct{};  ///< delivered above the command
    bool operator==(const CheckTolerances&) const = default;
};
/// "allows 20 % for an amplitude over the command; at most 2 % is expected"; empty where `allowed` is known and at
/// most `widest`.
[[nodiscard]] std::string widerThan(const CheckTolerances& allowed, const CheckTolerances& widest);

struct LoadSafetyCheck {
    std::string serial;  ///< serial number of the stimulator's output, as calibratedOutput() names it; not empty
    std::string device;  ///< its name
    CalibrationDate made{};
    CheckVerdict verdict = CheckVerdict::Begun;
    bool simulated = false;                 ///< any of the devices was simulated, replayed or emulated
    std::optional<SquareCentimetres> area;  ///< smallest electrode that was judged; nothing: none was stated
    TrainReach reach;
    CheckTolerances tolerances;
    std::vector<LimitSetHash> limits;
    std::string scriptSha256;  ///< digest of the protocol's bytes
    std::string session;       ///< file name of the session that holds the evidence
    std::string sessionHead;   ///< head of its hash chain when it ended; empty before
    bool operator==(const LoadSafetyCheck&) const = default;
};

/// How long a pass counts (pilot.md section 3).
inline constexpr std::chrono::days kLoadSafetyHolds{30};

/// What a session asks of the check of its stimulator.
struct LoadSafetyNeed {
    std::string serial;
    CalibrationDate day{};
    std::string scriptSha256;  ///< digest of the protocol as it is today
    SquareCentimetres area{0};
    TrainReach reach;            ///< which trains it covers, and which loads
    CheckTolerances tolerances;  ///< the widest that count
    std::vector<LimitSetHash> limits;
};

class LoadSafetyStore {
public:
    /// Reads the file; one that is not there is empty. Errors: Io; ParseError naming the line that does not check.
    [[nodiscard]] static Result<LoadSafetyStore> open(std::filesystem::path file);

    /// Appends and syncs. Errors: InvalidArgument for a check without serial, date, protocol or session, or a pass
    /// without the session's chain head; Io; ParseError when the file was damaged meanwhile.
    [[nodiscard]] Result<void> add(const LoadSafetyCheck& check);

    /// The newest line of that serial from real devices; null without one.
    [[nodiscard]] const LoadSafetyCheck* latest(std::string_view serial) const;
    /// The check that counts. Errors: NotFound with one sentence that says why there is none and what is accepted.
    [[nodiscard]] Result<LoadSafetyCheck> passed(const LoadSafetyNeed& need) const;

    [[nodiscard]] const std::vector<LoadSafetyCheck>& all() const noexcept { return all_; }

private:
    explicit LoadSafetyStore(std::filesystem::path file) : lines_(std::move(file), "load-safety check") {}
    [[nodiscard]] Result<void> read();

    ChainedLines lines_;
    std::vector<LoadSafetyCheck> all_;
};

/// Beside calibrationFile(): $XDG_DATA_HOME/tactoscope/load-safety.jsonl.
[[nodiscard]] std::filesystem::path loadSafetyFile();

}  // namespace tacto
