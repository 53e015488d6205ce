// LedgerRows.h - what the ledger of a study says: its rows, written by their names in one place, and the state that
// their replay gives. What a row says of a person is sealed under that person's key.
//
//   study, amendment      {settings, sha256, reference}      enrolled  {participant, sealed}
//   consent               {participant, sealed}              left, withdrawn  {participant, sessions}; withdrawn:
//   virtual session-begun         {session, file, participant, number, protocol, basis, script_sha256, sealed}
//   session-part          {session, file, participant, after, head}
//   session-ended         {session, participant, state, file, head}, "opened": false where its bench could not be
//   excluded              {participant, sealed}              of that day
//   next-day              {participant, session, sealed}
//   went-back             {row, head, at, lost, rows, files, unsealed}   of what was given up; `rows` is empty where
//                         not known; `unsealed` names rows that were taken over without a "mac"
//   adverse-event, exported   {session, sealed under the study's key}
//
// Each row has a "mac" over itself and the hash of the row before it, under a subkey of the study's: it vouches for all
// rows up to it. Older rows have none, and neither have rows that were appended without the key.
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
inline constexpr const char* kExported = "exported";
inline constexpr const char* kWentBack = "went-back";
}  // namespace ledger

struct LedgerState {
    std::string settingsSha256;              ///< hash of study.json, as last written
    nlohmann::json settings;                 ///< study.json as JSON
    std::vector<std::string> references;     ///< the approval's reference, and that of each amendment
    int firstPlaces = 0;                     ///< participants that the first approval allowed
    std::vector<StudyAmendment> amendments;  ///< in order
    std::size_t adverseEventRows = 0;        ///< counted also without the key
    std::vector<Participant> participants;
    std::map<std::string, std::string> promised;  ///< participant to the data_on_request that they consented to last
    std::map<std::string, std::chrono::sys_seconds> excluded;         ///< participant to their last yes
    std::vector<StudySession> sessions;                               ///< without `answered`
    std::map<std::string, std::string> heads;                         ///< chain head of each file that has ended
    std::vector<std::pair<std::string, AdverseEvent>> adverseEvents;  ///< known with the key only
    std::map<std::string, NextDay> nextDays;           ///< session to what was said last; with the key only
    std::vector<StudyExport> exports;                  ///< known with the key only
    std::map<std::string, CalibrationDate> formSince;  ///< version of the consent form to the first day that it counts
    std::vector<StudyGoingBack> wentBack;              ///< in order
    std::vector<std::string> rows;                     ///< the name of each, from row 2 on
    std::int64_t vouched = 0;                          ///< the last row with a "mac"; 0: none, or without the key
    std::chrono::sys_seconds last{};                   ///< when the newest row was written
    std::string head;

    [[nodiscard]] Participant* participant(std::string_view id) noexcept;
    [[nodiscard]] StudySession* session(std::string_view id) noexcept;
    [[nodiscard]] const StudySession* sessionOfFile(std::string_view file) const noexcept;
};

/// A sealed part of a ledger's row.
[[nodiscard]] std::string sealedInLedger(const std::string& study, const Secret& key, std::int64_t seq,
                                         std::string_view name, const nlohmann::json& content);
[[nodiscard]] Result<nlohmann::json> openedInLedger(const std::string& study, const Secret& key, std::int64_t seq,
                                                    std::string_view name, const nlohmann::json& body);

/// The "mac" of a row with this body, behind a row of that hash.
[[nodiscard]] std::string macInLedger(const std::string& study, const Secret& key, std::int64_t seq,
                                      std::chrono::sys_seconds at, std::string_view name, const nlohmann::json& body,
                                      std::string_view before);

/// The sealed part of a participant's row in the ledger.
[[nodiscard]] nlohmann::json toJson(const Participant& participant);
[[nodiscard]] nlohmann::json toJson(const Consent& consent);
[[nodiscard]] nlohmann::json toJson(const AdverseEvent& event);

/// Refuses values with which a row could not be read back. Errors: InvalidArgument naming the field, its value and what
/// is accepted.
[[nodiscard]] Result<void> checkForLedger(const Participant& participant);
[[nodiscard]] Result<void> checkForLedger(const Consent& consent);
[[nodiscard]] Result<void> checkForLedger(const AdverseEvent& event);

/// `keys` may be null. Errors: ParseError naming a row that does not fit the ones before it or does not open.
[[nodiscard]] Result<LedgerState> replay(const SessionReader& ledger, const std::string& study, const StudyKeys* keys);

}  // namespace tacto
