// Words.h - the word for each value of an enumeration, in files, messages and scripts.
//
//   constexpr Word<Hold> kHolds[] = {{"voltage", Hold::Voltage}, {"charge", Hold::Charge}};
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <type_traits>

namespace tacto {

template <class Value>
struct Word {
    std::string_view text;
    Value value;
};
template <class Value>
using Words = std::span<const Word<Value>>;

constexpr std::string_view kNoWord = "unknown";

/// Returns the word for `value`, or `otherwise` if there is none.
template <class Value>
[[nodiscard]] constexpr std::string_view wordFor(std::type_identity_t<Words<Value>> words, Value value,
                                                 std::string_view otherwise = kNoWord) noexcept {
    for (const auto& word : words) {
        if (word.value == value) return word.text;
    }
    return otherwise;
}

/// Returns the value for a word; nothing if `text` is not one of the words.
template <class Value, std::size_t count>
[[nodiscard]] constexpr std::optional<Value> valueFor(const Word<Value> (&words)[count],
                                                      std::string_view text) noexcept {
    for (const auto& word : words) {
        if (word.text == text) return word.value;
    }
    return std::nullopt;
}

// How certain a figure from a standard or a data sheet is.

enum class Confidence { High, Medium, MediumLow, Low };

inline constexpr Word<Confidence> kConfidences[] = {{"high", Confidence::High},
                                                    {"medium", Confidence::Medium},
                                                    {"medium-low", Confidence::MediumLow},
                                                    {"low", Confidence::Low}};
[[nodiscard]] constexpr std::string_view nameOf(Confidence confidence) noexcept {
    return wordFor(kConfidences, confidence);
}

// The role of a device on the bench, with its word in addresses, files and results.

enum class Role { Sensor, Stimulator, Oscilloscope, Massager };
inline constexpr Word<Role> kRoles[] = {{"sensor", Role::Sensor},
                                        {"stimulator", Role::Stimulator},
                                        {"oscilloscope", Role::Oscilloscope},
                                        {"massager", Role::Massager}};
[[nodiscard]] constexpr std::string_view nameOf(Role role) noexcept { return wordFor(kRoles, role, "device"); }

}  // namespace tacto
