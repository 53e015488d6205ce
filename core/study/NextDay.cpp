#include "core/study/NextDay.h"

#include <algorithm>
#include <fmt/format.h>

#include "core/base/LocaleFreeText.h"
#include "core/base/RecordFields.h"

namespace tacto {

namespace {

std::string sideEffectKeys() {
    std::string keys;
    for (const auto& each : kSideEffects) keys += (keys.empty() ? "" : ", ") + std::string(each.key);
    return keys;
}

RecordFields<SideEffect> sideEffectFields() {
    using S = SideEffect;
    RecordFields<S> all;
    all.text("item", &S::item, {.mayBeEmpty = false, .mostBytes = 40});
    all.number("severity", &S::severity, {.low = 1, .high = 4});
    all.number("relation", &S::relation, {.low = 1, .high = 5});
    all.rule([](const S& effect) -> Result<void> {
        const auto known = [&](const SideEffectName& each) { return each.key == effect.item; };
        if (std::ranges::any_of(kSideEffects, known)) return {};
        return invalid("\"item\" is \"{}\"; one of {} is expected", effect.item, sideEffectKeys());
    });
    return all;
}

RecordFields<NextDay> nextDayFields() {
    using N = NextDay;
    RecordFields<N> all;
    all.number("erythema", &N::erythema, {.low = 0, .high = 4});
    all.number("oedema", &N::oedema, {.low = 0, .high = 4});
    all.list("side_effects", &N::sideEffects, builtOnce<sideEffectFields>().kind(), 0, std::size(kSideEffects));
    all.rule([](const N& said) -> Result<void> {
        if (const auto* second = secondIn(said.sideEffects, &SideEffect::item))
            return invalid("{}", givenTwice("the side effect {}", second->item));
        return {};
    });
    return all;
}

}  // namespace

Result<void> checkNextDay(const NextDay& said) { return builtOnce<nextDayFields>().check(said, RecordPlace{}); }

Result<SideEffect> sideEffectFrom(std::string_view text) {
    const auto parts = split(text, ':');
    const auto score = [&](std::size_t at, int most) {
        const auto number = parts.size() == 3 ? parseNumber(parts[at]) : std::nullopt;
        for (int value = 1; number && value <= most; ++value) {
            if (*number == value) return value;
        }
        return 0;
    };
    SideEffect effect{parts.empty() ? std::string() : std::string(parts[0]), score(1, 4), score(2, 5)};
    if (effect.severity > 0 && effect.relation > 0 && builtOnce<sideEffectFields>().check(effect, RecordPlace{}))
        return effect;
    return invalid(
        "\"{}\" is not a side effect; ITEM:SEVERITY:RELATION as redness:2:4 is expected, a severity from 1 to 4, "
        "a relation from 1 to 5, and of the items {}",
        text, sideEffectKeys());
}

nlohmann::json toJson(const NextDay& said) { return builtOnce<nextDayFields>().write(said); }

Result<NextDay> nextDayFrom(const nlohmann::json& json) { return builtOnce<nextDayFields>().read(json, RecordPlace{}); }

std::string scoreText(std::span<const char* const> words, int score, int from) {
    const auto at = static_cast<std::size_t>(score - from);
    return score >= from && at < words.size() ? fmt::format("{} {}", score, words[at]) : fmt::format("{}", score);
}

std::string scaleText(std::span<const char* const> words, int from) {
    std::string all;
    for (int score = from; score < from + static_cast<int>(words.size()); ++score)
        all += (all.empty() ? "" : ", ") + scoreText(words, score, from);
    return all;
}

int severityOfSkin(int score) noexcept {
    constexpr int kSevere = 3;
    return std::min(score, kSevere);
}

}  // namespace tacto
