// PilotRecord.h - what a pilot session has on disk, and the state that follows from the rows when they are replayed.
//
// A session may have several parts, each in its own session file; nothing is appended to the file of a part that
// crashed. The record is given the events of all earlier parts, in order, and appends to the present part. A step that
// has a row is read from its row and is neither asked nor presented again; the first step without a row happens now.
//
// Promise (hazard H8): `trial-begin` is on disk before a presentation's first train is asked for, and `answer` before
// the next trial begins. If a row cannot be written, the error comes before the train.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/analysis/identification/Identification.h"
#include "core/analysis/psychophysics/LevelGrid.h"
#include "core/analysis/statistics/Estimate.h"
#include "core/base/Clock.h"
#include "core/base/Result.h"
#include "core/base/Statistics.h"
#include "core/base/Units.h"
#include "core/results/ResultTable.h"
#include "core/session/SessionTypes.h"

namespace tacto {

class SessionWriter;

/// Kinds of the events of a pilot session (resources/design/pilot.md, section 6).
namespace row {
inline constexpr const char* kPlan = "plan";
inline constexpr const char* kTrialBegin = "trial-begin";
inline constexpr const char* kPresentation = "presentation";  // a presentation has begun; a recorder gets a marker
inline constexpr const char* kAnswer = "answer";
inline constexpr const char* kNoAnswer = "no-answer";
inline constexpr const char* kAnswerEarly = "answer-early";
inline constexpr const char* kGate = "gate";
inline constexpr const char* kStopTest = "stop-test";
inline constexpr const char* kSkin = "skin";
inline constexpr const char* kImpedance = "impedance";
inline constexpr const char* kPhase = "phase";
inline constexpr const char* kEstimate = "estimate";
inline constexpr const char* kRange = "range";
inline constexpr const char* kDrift = "drift";
inline constexpr const char* kBreakBegin = "break-begin";
inline constexpr const char* kBreakEnd = "break-end";
inline constexpr const char* kParticipantStop = "participant-stop";
inline constexpr const char* kOperatorStop = "operator-stop";
inline constexpr const char* kFault = "fault";
inline constexpr const char* kPause = "pause";
inline constexpr const char* kFocusLost = "focus-lost";
inline constexpr const char* kNote = "note";
inline constexpr const char* kContinue = "continue";
inline constexpr const char* kResumed = "resumed";
inline constexpr const char* kRating = "rating";
inline constexpr const char* kSideEffect = "side-effect";
inline constexpr const char* kHold = "hold";  // the operator answered by name an event that held the session
inline constexpr const char* kAdverseEvent = "adverse-event";
inline constexpr const char* kSessionEnd = "session-end";
inline constexpr const char* kEnd = "end";    // the name in the row kSessionEnd
inline constexpr const char* kEnds = "ends";  // in a gate that did not hold: whether this ends the session
inline constexpr const char* kRamp = "ramp";  // in the body of a trial: its level was already accepted before
inline constexpr const char* kTooStrong = "too-strong";  // a response
/// The name of the row `phase` with the answer whether the participant meant the "too strong" about `trial`.
[[nodiscard]] inline std::string meantName(const std::string& trial) { return trial + " meant"; }

// Ratings that compare the session's encoding with an earlier encoding are named by kEncodings and one of the next two
// words. The answer is an encoding or kNoDifference.
inline constexpr const char* kEncodings = "encodings";
inline constexpr const char* kEasier = "easier";
inline constexpr const char* kMoreLikeTouch = "more-like-touch";
inline constexpr const char* kNoDifference = "no-difference";
}  // namespace row

/// The marker for an EEG or EMG recorder about a row that is on disk (resources/design/pilot.md, section 5).
struct PilotMarker {
    Instant at{0};          ///< the time in the row
    std::string_view name;  ///< the row's kind; the content of the row is not sent
};
/// Whether rows of that kind get a marker. Rows that show only the progress of the session do; rows with the
/// participant's answers or findings do not.
[[nodiscard]] bool hasMarker(std::string_view kind) noexcept;

class PilotRecord {
public:
    using Json = nlohmann::json;

    /// `writer` and `clock` must outlive the record; `earlier` are the events of the session's earlier parts.
    PilotRecord(SessionWriter& writer, const Clock& clock, const std::vector<SessionRow>& earlier);

    /// Returns the last row of `kind` in any part whose member "name" is `name`; null if there is none. The pointer is
    /// valid until the next write().
    [[nodiscard]] const Json* find(std::string_view kind, const std::string& name) const;
    /// Appends a row. `body` must be an object; its member "name" is set to `name`. Errors: Io.
    [[nodiscard]] Result<void> write(std::string_view kind, const std::string& name, Json body = Json::object());
    /// Appends a row about something that happened a moment ago, at `at`.
    [[nodiscard]] Result<void> writeAt(Instant at, std::string_view kind, const std::string& name,
                                       Json body = Json::object());
    /// Returns the stored row; if there is none, writes and returns what `make` returns. Errors: as `make` and write().
    [[nodiscard]] Result<Json> once(std::string_view kind, const std::string& name,
                                    const std::function<Result<Json>()>& make);
    /// Visits the last row of each kind and name, in any part.
    void each(const std::function<void(std::string_view kind, const Json& body)>& visit) const;
    /// Number of rows of `kind` in all parts.
    [[nodiscard]] std::size_t count(std::string_view kind) const;
    /// How often the trial named `name` was begun.
    [[nodiscard]] std::size_t begun(const std::string& name) const;
    /// Number of answers to presentations, in all parts; presentations without a question have none.
    [[nodiscard]] std::size_t answers() const noexcept { return answers_; }
    /// Number of presentations that were begun and have no row of their end.
    [[nodiscard]] std::size_t voided() const;
    /// Whether earlier parts have rows, which are replayed.
    [[nodiscard]] bool isResumed() const noexcept { return resumed_; }
    /// Number of rows that this part has written. If it is not 0, rows are no longer replayed.
    [[nodiscard]] std::size_t written() const noexcept { return written_; }

    /// Called after each row is on disk with the number of rows written by this part. Tests end the program there.
    std::function<void(std::size_t)> onWritten;
    /// Called after a row with a marker is on disk; may be empty, and must not block.
    std::function<void(const PilotMarker&)> onMarker;

private:
    void keep(std::string_view kind, const Json& body);

    SessionWriter& writer_;
    const Clock& clock_;
    std::map<std::pair<std::string, std::string>, Json, std::less<>> last_;
    std::map<std::string, std::size_t, std::less<>> counts_;
    std::map<std::string, std::size_t, std::less<>> begun_;
    std::size_t answers_ = 0;
    bool resumed_ = false;
    std::size_t written_ = 0;
};

/// A trial that was begun and has no answer.
struct OpenTrial {
    std::size_t number = 0;
    std::size_t attempt = 1;
    bool operator==(const OpenTrial&) const = default;
};

/// The numbered trials, which are the trials of the plan, as recorded in the rows of all parts of a session.
struct PilotTrials {
    nlohmann::json plan;                      ///< [{number, phase, block, condition}]; null if no plan is stored
    std::vector<IdentificationTrial> trials;  ///< answered, or twice without an answer; in the order of the answers
    std::vector<OpenTrial> open;
};
[[nodiscard]] PilotTrials pilotTrials(const std::vector<SessionRow>& rows);

// How a pilot session ends, and which of its rows end it for good.

/// The state of a session when its script has ended.
enum class PilotEnd {
    Unfinished,  ///< interrupted; may be resumed
    Complete,
    Stopped,  ///< ended early, for good
};
[[nodiscard]] std::string_view nameOf(PilotEnd end) noexcept;  // "unfinished", "complete", "stopped"
/// Returns nothing for any other word.
[[nodiscard]] std::optional<PilotEnd> pilotEndFrom(std::string_view word) noexcept;

inline constexpr std::size_t kMaxParticipantStops = 3;  ///< the third ends the session (pilot.md section 5)
inline constexpr std::size_t kMaxFaults = 2;            ///< the second ends the session

inline constexpr const char* kThirdStop = "the participant stopped for the third time, which ends the session";
inline constexpr const char* kSecondFault = "a second fault ends the session";
/// `level`: for example "1.5 mA".
[[nodiscard]] std::string tooStrongNow(std::string_view level);

/// Returns the sentence that says why a session has ended for good: the third stop, the second fault, a gate that did
/// not hold, or a ramp level that is too strong now. Returns an empty text if the session may continue. A session that
/// ended but was killed before it recorded its end is not tried again.
[[nodiscard]] std::string endedBy(const PilotRecord& record);

// Rows of a pilot session that hold its plan and its findings. Each is described once, for writing, for reading after a
// crash, and for sharing. Absent numbers are NaN here and null in the row.
//
// Levels are in mA, or intensities with a massager; the keys name the unit ("min_ma", "min_intensity").

/// Row "plan", without its trials.
struct PlanRow {
    std::uint64_t seed = 0;
    std::string encoding;
    std::uint64_t blocks = 0;
    std::string runSha256;
    std::string answers;  ///< the conditions in the order of the answer places, with commas; empty: kAnswerPlaces
    // What the participant reads; empty in sessions of before words were files, which were in English.
    std::string language = {}, wordsVersion = {}, wordsSha256 = {};
};
[[nodiscard]] nlohmann::json toJson(const PlanRow& row);
/// Members that cannot be read keep their defaults, here and in the two functions below.
[[nodiscard]] PlanRow planRowFrom(const nlohmann::json& body);

/// Row "range".
struct RangeRow {
    LevelUnit unit = LevelUnit::Current;
    bool usable = false;
    std::string reason = {};  ///< one sentence that says why the range is not usable
    double min = kNaN, max = kNaN;
    double jnd = kNaN;  ///< number of just noticeable differences from min to max
    LevelLimit limitedBy = LevelLimit::TooStrong;
    // Only for a range of currents:
    Volts minVoltage{kNaN}, maxVoltage{kNaN};  ///< at `impedance`
    Ohms impedance{kNaN};
};
[[nodiscard]] nlohmann::json toJson(const RangeRow& row);
[[nodiscard]] RangeRow rangeRowFrom(const nlohmann::json& body);
/// Returns the columns of the row in tables of results.
[[nodiscard]] std::vector<ResultColumn> rangeColumns(LevelUnit unit);

/// Row "drift": the check before a block.
struct DriftRow {
    LevelUnit unit = LevelUnit::Current;
    std::uint64_t block = 0;
    Estimate detection = {};
    double probability = kNaN;  ///< probability that the weakest condition is felt too little
    std::uint64_t rests = 0;
    bool adapted = false;
};
[[nodiscard]] nlohmann::json toJson(const DriftRow& row);
[[nodiscard]] DriftRow driftRowFrom(const nlohmann::json& body);

/// Converts as StatisticsJson.h does; returns null for an estimate without a value.
[[nodiscard]] nlohmann::json estimateOrNull(const Estimate& estimate);
[[nodiscard]] Estimate estimateFrom(const nlohmann::json& value);

}  // namespace tacto
