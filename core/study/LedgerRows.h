// LedgerRows.h - the rows of a study's ledger and the state that results from replaying them. The names of rows are
// defined only here. What a row says about a person is sealed under that person's key.
//
//   study, amendment         {settings, sha256, reference}
//   enrolled, consent        {participant, sealed}; excluded: the same, for that day
//   left                     {participant, sessions, sealed}; older rows have nothing sealed
//   withdrawn                {participant, sessions, virtual}
//   session-begun            {session, file, participant, number, protocol, basis, script_sha256, sealed}
//   session-part             {session, file, participant, after, head}
//   session-ended            {session, participant, state, file, head}; "opened" is false if the bench did not open
//   next-day                 {participant, session, sealed}
//   went-back                {row, head, at, lost, rows, files, unsealed} about the ledger that was given up; `rows` is
//                            empty if not known; `unsealed`: names of rows taken over without a "mac"
//   adverse-event, exported  {session, sealed}, under the study's key; `session` is empty for an event outside sessions
//   released                 {event, sealed}, under the study's key; `event` counts the adverse events from 1
//   note                     {kind, sealed}, under the study's key (StudyLog.h)
//
// Each row has a "mac" over itself and the hash of the row before, made with a subkey of the study's key. The "mac"
// vouches for all rows up to its own. Older rows, and rows appended without the key, have none.
//
// Thread-safety: values.
#pragma once

#include <chrono>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/base/Result.h"
#include "core/session/SessionReader.h"
#include "core/study/Study.h"
#include "core/study/StudyKeys.h"

namespace tacto {

namespace ledger {
inline constexpr const char* kStudy = "study";
inline constexpr const char* kAmendment = "amendment";
inline constexpr const char* kEnrolled = "enrolled";
inline constexpr const char* kConsent = "consent";
inline constexpr const char* kExcluded = "excluded";
inline constexpr const char* kLeft = "left";
inline constexpr const char* kWithdrawn = "withdrawn";
inline constexpr const char* kSessionBegun = "session-begun";
inline constexpr const char* kSessionPart = "session-part";
inline constexpr const char* kSessionEnded = "session-ended";
inline constexpr const char* kNextDay = "next-day";
inline constexpr const char* kAdverseEvent = "adverse-event";
inline constexpr const char* kReleased = "released";
inline constexpr const char* kNote = "note";
inline constexpr const char* kExported = "exported";
inline constexpr const char* kWentBack = "went-back";
}  // namespace ledger

struct LedgerState {
    std::string settingsSha256;              ///< hash of study.json as last written
    nlohmann::json settings;                 ///< study.json as JSON
    std::vector<std::string> references;     ///< the references of the approval and of each amendment
    int firstPlaces = 0;                     ///< number of participants in the first approval
    std::vector<StudyAmendment> amendments;  ///< in order
    std::size_t adverseEventRows = 0;        ///< counted also without the key
    std::vector<Participant> participants;
    std::map<std::string, std::string> promised;  ///< for each participant: data_on_request at their last consent
    std::map<std::string, std::chrono::sys_seconds> excluded;         ///< for each participant: their last "yes"
    std::vector<StudySession> sessions;                               ///< without `answered`
    std::map<std::string, std::string> heads;                         ///< for each ended file: its chain head
    std::vector<std::pair<std::string, AdverseEvent>> adverseEvents;  ///< only with the key
    std::vector<StudyNote> notes;                                     ///< only with the key
    std::map<std::string, NextDay> nextDays;           ///< for each session: its last record; only with the key
    std::vector<StudyExport> exports;                  ///< only with the key
    std::map<std::string, CalibrationDate> formSince;  ///< for each version of the consent form: its first valid day
    std::vector<StudyGoingBack> wentBack;              ///< in order
    std::vector<std::string> rows;                     ///< the name of each row, from row 2
    std::int64_t vouched = 0;                          ///< number of the last row with a "mac"; 0: none, or no key
    std::chrono::sys_seconds last{};                   ///< when the newest row was written
    std::string head;

    [[nodiscard]] Participant* participant(std::string_view id) noexcept;
    [[nodiscard]] StudySession* session(std::string_view id) noexcept;
    [[nodiscard]] const StudySession* sessionOfFile(std::string_view file) const noexcept;
};

/// Seals or opens the sealed part of a row.
[[nodiscard]] std::string sealedInLedger(const std::string& study, const Secret& key, std::int64_t seq,
                                         std::string_view name, const nlohmann::json& content);
[[nodiscard]] Result<nlohmann::json> openedInLedger(const std::string& study, const Secret& key, std::int64_t seq,
                                                    std::string_view name, const nlohmann::json& body);

/// Returns the "mac" of a row with this body; `before` is the hash of the row before it.
[[nodiscard]] std::string macInLedger(const std::string& study, const Secret& key, std::int64_t seq,
                                      std::chrono::sys_seconds at, std::string_view name, const nlohmann::json& body,
                                      std::string_view before);

/// Returns the sealed part of a participant's row.
[[nodiscard]] nlohmann::json toJson(const Participant& participant);
[[nodiscard]] nlohmann::json toJson(const Consent& consent);
[[nodiscard]] nlohmann::json toJson(const AdverseEvent& event);

/// Refuses values that could not be read back from a row. Errors: InvalidArgument naming the field, its value and what
/// is accepted.
[[nodiscard]] Result<void> checkForLedger(const Participant& participant);
[[nodiscard]] Result<void> checkForLedger(const Consent& consent);
[[nodiscard]] Result<void> checkForLedger(const AdverseEvent& event);

/// `keys` may be null. Errors: ParseError naming a row that contradicts earlier rows or cannot be opened.
[[nodiscard]] Result<LedgerState> replay(const SessionReader& ledger, const std::string& study, const StudyKeys* keys);

}  // namespace tacto
