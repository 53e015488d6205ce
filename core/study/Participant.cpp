#include "core/study/Participant.h"

#include <algorithm>
#include <fmt/ranges.h>
#include <span>
#include <vector>

#include "core/base/JsonText.h"
#include "core/base/LocaleFreeText.h"
#include "core/seal/SealedText.h"

namespace tacto {

namespace {

constexpr std::string_view kCodeAlphabet = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZ";
/// Leaves out characters that look alike when written by hand.
constexpr std::string_view kDrawn = "23456789ABCDEFGHJKLMNPQRSTUVWXYZ";
constexpr std::size_t kShortestCode = 3;
constexpr std::size_t kLongestCode = 16;
constexpr int kOldest = 120;

bool isAge(std::string_view text) {
    const auto years = parseNumber(text);
    return years && *years >= 1 && *years <= kOldest && text == fmt::format("{:.0f}", *years);
}

/// The text must be empty or one of `words`.
Result<void> oneOf(std::string_view what, std::string_view given, std::span<const std::string_view> words) {
    if (given.empty() || std::ranges::find(words, given) != words.end()) return {};
    return invalid("{} is \"{}\"; one of {} is accepted, or nothing", what, given.substr(0, 40),
                   fmt::join(words, ", "));
}

}  // namespace

std::string virtualName(std::uint64_t seed) { return fmt::format("{}{}", kVirtualPrefix, seed); }

std::optional<char> checkCharacter(std::string_view lettersAndDigits) noexcept {
    // ISO 7064, MOD 37,36: a hybrid system with modulus 36.
    unsigned p = 36;
    for (const char c : lettersAndDigits) {
        const auto value = kCodeAlphabet.find(c);
        if (value == std::string_view::npos) return std::nullopt;
        p = (p + static_cast<unsigned>(value)) % 36;
        if (p == 0) p = 36;
        p = p * 2 % 37;
    }
    return kCodeAlphabet[(37 - p) % 36];
}

Result<void> checkAbout(const Participant& participant) {
    if (!participant.age.empty() && !isAge(participant.age)) {
        return invalid("age is \"{}\"; whole years from 1 to {} are accepted, or nothing",
                       participant.age.substr(0, 40), kOldest);
    }
    if (auto known = oneOf("sex", participant.sex, kSexes); !known) return known;
    return oneOf("handedness", participant.handedness, kHandednesses);
}

Result<std::string> checkedCode(std::string_view text) {
    std::string stored;
    std::string checked;
    for (const char c : text) {
        const char upper = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
        stored += upper;
        if (upper != '-') checked += upper;
    }
    const auto refused = [&](std::string_view what) {
        return fail(
            ErrorCode::NotFound,
            "\"{}\" is not a participant's code: {}; a code as P-7K3D is expected, whose last character checks the "
            "others",
            text.substr(0, 40), what);
    };
    if (checked.size() < kShortestCode || checked.size() > kLongestCode || stored.size() > 2 * kLongestCode)
        return refused(
            fmt::format("it has {} letters and digits, not {} to {}", checked.size(), kShortestCode, kLongestCode));
    const auto check = checkCharacter(std::string_view(checked).substr(0, checked.size() - 1));
    if (!check || kCodeAlphabet.find(checked.back()) == std::string_view::npos)
        return refused("it holds something else than letters, digits and hyphens");
    if (*check != checked.back()) return refused("its check character is wrong");
    return stored;
}

std::string newCode() {
    std::string drawn = "P";
    for (int i = 0; i < 3; ++i) drawn += kDrawn[randomBelow(static_cast<std::uint32_t>(kDrawn.size()))];
    return fmt::format("P-{}{}", drawn.substr(1), checkCharacter(drawn).value_or('?'));
}

std::string namedWith(SessionBasis basis, std::string_view name) {
    constexpr std::string_view kAfter[] = {"", " (simulated devices)", " (virtual)"};
    return fmt::format("{}{}", name, kAfter[static_cast<std::size_t>(basis)]);
}

std::string_view peopleOf(SessionBasis basis, std::size_t n) noexcept {
    switch (basis) {
        case SessionBasis::Person:
            return n == 1 ? "person" : "people";
        case SessionBasis::PersonSimulated:
            return n == 1 ? "person on simulated devices" : "people on simulated devices";
        case SessionBasis::Virtual:
            break;
    }
    return n == 1 ? "virtual participant" : "virtual participants";
}

std::string countsText(const std::map<SessionBasis, std::size_t>& counts) {
    std::vector<std::string> all;
    for (const auto& [basis, n] : counts) {
        if (n > 0) all.push_back(fmt::format("{} {}", n, peopleOf(basis, n)));
    }
    return all.empty() ? "0 people" : fmt::format("{}", fmt::join(all, " and "));
}

SessionBasis basisIn(const nlohmann::json& results) {
    const auto participant = valueOr(results, "participant");
    if (const auto said = valueFor(kSessionBases, textOr(participant, "basis"))) return *said;
    return flagOr(participant, "virtual") ? SessionBasis::Virtual : SessionBasis::Person;
}

}  // namespace tacto
