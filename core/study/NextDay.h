// NextDay.h - what a participant reports on a day after a session, and what their skin shows (pilot.md section 4): side
// effects from a closed list, redness and swelling. The same list is used before and after a session.
//
// Thread-safety: values; pure functions.
#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/Result.h"

namespace tacto {

// The words for the scores of adverse events, side effects and skin, as windows, reports, exports and the command line
// show them. The ledger keeps the numbers.
//
// Sources: severities of events are grades 1 to 4 of CTCAE 5.0 (ISO 14155 has mild, moderate and severe); severities of
// side effects, and all relations, are from Brunoni 2011; skin scores from OECD 404 (pilot.md section 12).

inline constexpr const char* kEventSeverities[] = {"mild", "moderate", "severe", "life-threatening"};  ///< from 1
inline constexpr const char* kSideEffectSeverities[] = {"absent", "mild", "moderate", "severe"};       ///< from 1
/// How an event relates to the stimulation, from 1.
inline constexpr const char* kRelations[] = {"none", "remote", "possible", "probable", "definite"};
/// Redness and swelling, from 0.
inline constexpr const char* kSkinScores[] = {"none", "very slight", "well defined", "moderate", "severe"};

/// Returns text such as "3 severe", or the number alone if it has no word.
[[nodiscard]] std::string scoreText(std::span<const char* const> words, int score, int from = 1);
/// Returns text such as "1 mild, 2 moderate, 3 severe, 4 life-threatening".
[[nodiscard]] std::string scaleText(std::span<const char* const> words, int from = 1);
/// Returns the severity of the adverse event for a skin score of kSkinIsAdverse or more: the worst that is possible,
/// until the investigator judges it. No skin score is life-threatening.
[[nodiscard]] int severityOfSkin(int score) noexcept;

struct SideEffectName {
    const char* key;
    const char* text;  ///< for people
};
inline constexpr SideEffectName kSideEffects[] = {{"tingling", "Tingling"},
                                                  {"itching", "Itching"},
                                                  {"burning", "Burning"},
                                                  {"pain", "Pain"},
                                                  {"redness", "Redness"},
                                                  {"twitching", "Twitching"},
                                                  {"numbness", "Numbness"},
                                                  {"phantom-pain", "Phantom pain"},
                                                  {"headache", "Headache"},
                                                  {"tiredness", "Tiredness"},
                                                  {"concentration", "Poor attention"},
                                                  {"mood", "Changed mood"}};

/// The lowest score of redness or swelling that is an adverse event.
inline constexpr int kSkinIsAdverse = 2;

struct SideEffect {
    std::string item;  ///< a key of kSideEffects
    int severity = 1;  ///< one of kSideEffectSeverities
    int relation = 1;  ///< one of kRelations
    bool operator==(const SideEffect&) const = default;
};

struct NextDay {
    int erythema = 0, oedema = 0;  ///< 0 to 4
    std::vector<SideEffect> sideEffects;
    /// The worse of the two scores.
    [[nodiscard]] int skin() const noexcept { return erythema > oedema ? erythema : oedema; }
    bool operator==(const NextDay&) const = default;
};

/// Errors: InvalidArgument naming the field, its value and what is accepted; also for an item that is given twice.
[[nodiscard]] Result<void> checkNextDay(const NextDay& said);
/// Parses "redness:2:4" (item, severity, relation). Errors: InvalidArgument naming the text and what is expected.
[[nodiscard]] Result<SideEffect> sideEffectFrom(std::string_view text);

[[nodiscard]] nlohmann::json toJson(const NextDay& said);
/// Errors: ParseError; as checkNextDay().
[[nodiscard]] Result<NextDay> nextDayFrom(const nlohmann::json& json);

}  // namespace tacto
