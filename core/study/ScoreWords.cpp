#include "core/study/ScoreWords.h"

#include <algorithm>
#include <fmt/format.h>

namespace tacto {

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
