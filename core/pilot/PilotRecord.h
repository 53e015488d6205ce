// PilotRecord.h - what a pilot session has on disk, and what follows from it: state is the replay of rows.
//
// A session may have several parts, each a session file: a crashed one is never written again. The record is given the
// events of all earlier parts, in order, and appends to the present one. Whatever has a row is taken from it and is
// neither asked nor presented again; the first step without a row happens now.
//
// Promise (hazard H8): `trial-begin` is on disk before a presentation's first train is asked for, and `answer` before
// the next trial begins. A row that cannot be written is an error before the train.
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
#include "core/session/SessionTypes.h"

namespace tacto {

class SessionWriter;

/// Kinds of the events of a pilot session (resources/design/pilot.md, section 6).
namespace row {
inline constexpr const char* kPlan = "plan";
inline constexpr const char* kTrialBegin = "trial-begin";
inline constexpr const char* kPresentation = "presentation";  // it has begun; a recorder is told so
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
inline constexpr const char* kHold = "hold";  // the operator answered by name what held the session
inline constexpr const char* kAdverseEvent = "adverse-event";
inline constexpr const char* kSessionEnd = "session-end";
inline constexpr const char* kEnd = "end";    // name of its row
inline constexpr const char* kEnds = "ends";  // in the body of a gate that did not hold: `said` then ends the session
inline constexpr const char* kRamp = "ramp";  // in the body of a trial: its level had been accepted before
inline constexpr const char* kTooStrong = "too-strong";  // a response

// Ratings that compare the session's encoding with an earlier one are named by the first of these and one of the next
// two. What is said is an encoding, or the last.
inline constexpr const char* kEncodings = "encodings";
inline constexpr const char* kEasier = "easier";
inline constexpr const char* kMoreLikeTouch = "more-like-touch";
inline constexpr const char* kNoDifference = "no-difference";
}  // namespace row

/// The message to an EEG or EMG recorder about a row that is on disk (resources/design/pilot.md, section 5).
struct PilotMarker {
    Instant at{0};          ///< as the row says
    std::string_view name;  ///< the row's kind; nothing of what it says
};
/// Whether a row of that kind has a marker: it says where the session is, and neither how the participant answers, nor
/// what is found of them.
[[nodiscard]] bool hasMarker(std::string_view kind) noexcept;

class PilotRecord {
public:
    using Json = nlohmann::json;

    /// `writer` and `clock` outlive the record; `earlier` are the events of the session's earlier parts.
    PilotRecord(SessionWriter& writer, const Clock& clock, const std::vector<SessionRow>& earlier);

    /// The last row of `kind` named `name` (its member "name"), in any part; null without one. Valid until the next
    /// write().
    [[nodiscard]] const Json* find(std::string_view kind, const std::string& name) const;
    /// Appends a row. `body` is an object; its member "name" becomes `name`. Errors: Io.
    [[nodiscard]] Result<void> write(std::string_view kind, const std::string& name, Json body = Json::object());
    /// Writes what happened at `at`, a moment ago.
    [[nodiscard]] Result<void> writeAt(Instant at, std::string_view kind, const std::string& name,
                                       Json body = Json::object());
    /// What the row says; without a row, what `make` returns, written first. Errors: as `make` and write().
    [[nodiscard]] Result<Json> once(std::string_view kind, const std::string& name,
                                    const std::function<Result<Json>()>& make);
    /// The last row of each kind and name, of any part.
    void each(const std::function<void(std::string_view kind, const Json& body)>& visit) const;
    /// Rows of `kind`, of all parts.
    [[nodiscard]] std::size_t count(std::string_view kind) const;
    /// Times the trial named `name` was begun.
    [[nodiscard]] std::size_t begun(const std::string& name) const;
    /// Whether there were rows before this part, which are replayed.
    [[nodiscard]] bool isResumed() const noexcept { return resumed_; }
    /// Whether anything has happened in this part besides resuming: rows are not replayed any longer.
    [[nodiscard]] std::size_t written() const noexcept { return written_; }

    /// Called after each row is on disk with the number of rows written by this part; tests end the program there.
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
    bool resumed_ = false;
    std::size_t written_ = 0;
};

/// A trial that was begun and has no answer.
struct OpenTrial {
    std::size_t number = 0;
    std::size_t attempt = 1;
    bool operator==(const OpenTrial&) const = default;
};

/// The numbered trials, which are those of the plan, as the rows of all parts of a session tell them.
struct PilotTrials {
    nlohmann::json plan;                      ///< [{number, phase, block, condition}]; null where none is stored
    std::vector<IdentificationTrial> trials;  ///< answered, or twice without an answer; in the order answered
    std::vector<OpenTrial> open;
};
[[nodiscard]] PilotTrials pilotTrials(const std::vector<SessionRow>& rows);

// How a pilot session ends, and which of its rows end it for good.

/// The state of a session when its script has ended.
enum class PilotEnd {
    Unfinished,  ///< interrupted; may be resumed
    Complete,
    Stopped,  ///< ended before its end, for good
};
[[nodiscard]] std::string_view nameOf(PilotEnd end) noexcept;  // "unfinished", "complete", "stopped"
/// Nothing for any other word.
[[nodiscard]] std::optional<PilotEnd> pilotEndFrom(std::string_view word) noexcept;

inline constexpr std::size_t kMaxParticipantStops = 3;  ///< the third ends the session (pilot.md section 5)
inline constexpr std::size_t kMaxFaults = 2;            ///< the second ends it

inline constexpr const char* kThirdStop = "the participant stopped for the third time, which ends the session";
inline constexpr const char* kSecondFault = "a second fault ends the session";
/// `level`: "1.5 mA".
[[nodiscard]] std::string tooStrongNow(std::string_view level);

/// The reason why a session has ended for good: the third stop, the second fault, a gate that did not hold, a level of
/// the ramp that is too strong now. A sentence; empty while nothing has ended it. A session that was killed before it
/// ended is not tried again.
[[nodiscard]] std::string endedBy(const PilotRecord& record);

// Rows of a pilot session that say what was planned and found, each described once: as they are written, read again
// after a crash, and shared. Absent numbers are NaN here and null in the row.
//
// Levels are in mA or, of a massager, intensities; their keys say which ("min_ma", "min_intensity").

/// Row "plan", beside the trials in their order.
struct PlanRow {
    std::uint64_t seed = 0;
    std::string encoding;
    std::uint64_t blocks = 0;
    std::string runSha256;
    std::string answers;  ///< conditions by their place and key, with commas between; empty: kAnswerPlaces
};
[[nodiscard]] nlohmann::json toJson(const PlanRow& row);
/// Unreadable members stay as they are in a new one; so for the others.
[[nodiscard]] PlanRow planRowFrom(const nlohmann::json& body);

/// Row "range".
struct RangeRow {
    LevelUnit unit = LevelUnit::Current;
    bool usable = false;
    std::string reason = {};  ///< one sentence that says why it is not usable
    double min = kNaN, max = kNaN;
    double jnd = kNaN;  ///< from one to the other
    LevelLimit limitedBy = LevelLimit::TooStrong;
    // If they are currents:
    Volts minVoltage{kNaN}, maxVoltage{kNaN};  ///< at `impedance`
    Ohms impedance{kNaN};
};
[[nodiscard]] nlohmann::json toJson(const RangeRow& row);
[[nodiscard]] RangeRow rangeRowFrom(const nlohmann::json& body);

/// Row "drift": the check before a block.
struct DriftRow {
    LevelUnit unit = LevelUnit::Current;
    std::uint64_t block = 0;
    Estimate detection = {};
    double probability = kNaN;  ///< how likely the weakest condition is felt too little
    std::uint64_t rests = 0;
    bool adapted = false;
};
[[nodiscard]] nlohmann::json toJson(const DriftRow& row);
[[nodiscard]] DriftRow driftRowFrom(const nlohmann::json& body);

/// The estimate as StatisticsJson.h writes it; null without a value.
[[nodiscard]] nlohmann::json estimateOrNull(const Estimate& estimate);
[[nodiscard]] Estimate estimateFrom(const nlohmann::json& value);

}  // namespace tacto
