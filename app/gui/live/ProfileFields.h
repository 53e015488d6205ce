// ProfileFields.h - the fields of a profile as people read them: label, unit, what is accepted, what it does.
//
// What is accepted is told here and judged by the core alone (parseProfile()); a test holds the two together.
//
// Thread-safety: constants.
#pragma once

#include <QString>
#include <span>
#include <utility>
#include <vector>

namespace tacto::gui {

enum class ProfileTab { Encoding, Pulse, Touch, Load };
inline constexpr int kProfileTabs = 4;
[[nodiscard]] QString titleOf(ProfileTab tab);

struct ProfileField {
    ProfileTab tab;
    const char* section;  ///< of the profile's file
    const char* key;
    const char* label;
    const char* unit;
    const char* tip;
    double low = 0;  ///< accepted from, to; choices have none
    double high = 0;
    bool openLow = false;  ///< `low` itself is not accepted
    bool openHigh = false;
    bool mayBeEmpty = false;                                     ///< null in the file
    const char* accepts = nullptr;                               ///< instead of low and high
    std::vector<std::pair<const char*, const char*>> choices{};  ///< value in the file, text; empty for a number
    const char* needs = nullptr;                                 ///< key of the choice that gives it meaning...
    const char* needsValue = nullptr;  ///< ...when it is this, or with '!' in front when it is not
    const char* alsoCalled = nullptr;  ///< in the core's sentences, where not by key

    [[nodiscard]] bool isChoice() const noexcept { return !choices.empty(); }
    /// "0.01 to 500 V".
    [[nodiscard]] QString range() const;
};

[[nodiscard]] std::span<const ProfileField> profileFields();
/// The field that a refusal is about: the one that it names first. Null when it names none.
[[nodiscard]] const ProfileField* fieldIn(const QString& refusal);
/// Translated.
[[nodiscard]] QString profileWords(const char* text);

}  // namespace tacto::gui
