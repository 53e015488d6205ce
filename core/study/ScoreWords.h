// ScoreWords.h - what the scores of adverse events, side effects and skin mean: the words that windows, reports,
// exports and the command line show. The ledger keeps the numbers.
//
// Sources: severities of events are the grades 1 to 4 of CTCAE 5.0 (ISO 14155 has mild, moderate and severe); those of
// side effects and every relation are of Brunoni 2011; skin is of OECD 404 (pilot.md section 12).
//
// Thread-safety: constants; pure functions.
#pragma once

#include <span>
#include <string>

namespace tacto {

inline constexpr const char* kEventSeverities[] = {"mild", "moderate", "severe", "life-threatening"};  ///< from 1
inline constexpr const char* kSideEffectSeverities[] = {"absent", "mild", "moderate", "severe"};       ///< from 1
/// To the stimulation, from 1.
inline constexpr const char* kRelations[] = {"none", "remote", "possible", "probable", "definite"};
/// Redness and swelling, from 0.
inline constexpr const char* kSkinScores[] = {"none", "very slight", "well defined", "moderate", "severe"};

/// "3 severe"; the number alone where it has no word.
[[nodiscard]] std::string scoreText(std::span<const char* const> words, int score, int from = 1);
/// "1 mild, 2 moderate, 3 severe, 4 life-threatening".
[[nodiscard]] std::string scaleText(std::span<const char* const> words, int from = 1);
/// How severe the event is that skin of a score of kSkinIsAdverse or more is noted as: the worst that it may be until
/// the investigator judges it. No skin score is life-threatening.
[[nodiscard]] int severityOfSkin(int score) noexcept;

}  // namespace tacto
