// ProfileFields.h - the fields of a profile as people read them: where each stands in the form, its label, what it
// does.
//
// Units, ranges and choices are those of the core's table (profileFields() of core/bench/Profile.h), which alone
// judges.
//
// Thread-safety: constants.
#pragma once

#include <QString>
#include <vector>

#include "core/base/RecordFields.h"

namespace tacto::gui {

enum class ProfileTab { Encoding, Pulse, Touch, Load };
inline constexpr int kProfileTabs = 4;
[[nodiscard]] QString titleOf(ProfileTab tab);

struct ProfileField {
    ProfileTab tab;
    const char* key;
    const char* label;
    const char* tip;
    struct Form {
        std::vector<const char*> words{};  ///< for the words of the file, in their order; empty for a number
        const char* accepts = nullptr;     ///< shown in place of the range
        const char* needs = nullptr;       ///< key of the choice that gives it meaning...
        const char* needsValue = nullptr;  ///< ...when it is this, or with '!' in front when it is not
    } form{};
    const FieldInfo* stored = nullptr;  ///< the field of the core

    [[nodiscard]] const char* section() const noexcept;  ///< its section in the profile's file
    [[nodiscard]] bool isChoice() const noexcept { return !stored->words.empty(); }
    /// "0.01 to 500 V".
    [[nodiscard]] QString range() const;
};

[[nodiscard]] const std::vector<ProfileField>& profileForm();
/// The field that a refusal is about: the one that it names first. Null when it names none.
[[nodiscard]] const ProfileField* fieldIn(const QString& refusal);
/// A refusal of the core with the form's names in place of the file's keys: "“Smallest amplitude” 45 V is not below …".
[[nodiscard]] QString inFormWords(QString refusal);
/// Translated.
[[nodiscard]] QString profileWords(const char* text);

}  // namespace tacto::gui
