// NextDay.h - what a participant says and their skin shows on a day after a session (pilot.md section 4): side effects
// from a closed list, redness and swelling. And that list, which is asked for before and after a session too.
//
// Thread-safety: values; pure functions.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/Result.h"
#include "core/study/ScoreWords.h"

namespace tacto {

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

/// Redness or swelling from which the skin is an adverse event.
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
/// "redness:2:4": item, severity, relation. Errors: InvalidArgument naming the text and what is expected.
[[nodiscard]] Result<SideEffect> sideEffectFrom(std::string_view text);

[[nodiscard]] nlohmann::json toJson(const NextDay& said);
/// Errors: ParseError, as checkNextDay().
[[nodiscard]] Result<NextDay> nextDayFrom(const nlohmann::json& json);

}  // namespace tacto
