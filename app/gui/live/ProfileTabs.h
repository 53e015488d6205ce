// ProfileTabs.h - the fields of a profile on tabs, each with its range and, beside it, why it is refused.
#pragma once

#include <QString>
#include <QTabWidget>
#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "app/gui/theme/FieldForm.h"
#include "core/base/RecordFields.h"

namespace tacto::gui {

enum class ProfileTab { Encoding, Pulse, Touch, Load };
inline constexpr int kProfileTabs = 4;
[[nodiscard]] QString titleOf(ProfileTab tab);

/// A field as people read it: its place in the form, its label, and what it does. Units, ranges and choices come from
/// the core's table (profileFields() of core/bench/Profile.h), which alone judges.
struct ProfileField {
    ProfileTab tab;
    const char* key;
    const char* label;
    const char* tip;
    std::vector<const char*> words{};   ///< the file's words in their order, put for people; empty for a number
    const char* accepts = nullptr;      ///< shown in place of the range
    const char* needs = nullptr;        ///< key of the choice that gives it meaning...
    const char* needsValue = nullptr;   ///< ...when it is this, or with '!' in front when it is not
    const FieldInfo* stored = nullptr;  ///< the field of the core

    [[nodiscard]] const char* section() const noexcept;  ///< its section in the profile's file
    [[nodiscard]] bool isChoice() const noexcept { return !stored->words.empty(); }
    /// "0.01 to 500 V".
    [[nodiscard]] QString range() const;
};

[[nodiscard]] const std::vector<ProfileField>& profileForm();
/// The field that a refusal is about, which is the one that it names first. Null when it names none.
[[nodiscard]] const ProfileField* fieldIn(const QString& refusal);
/// A refusal of the core with the form's names in place of the file's keys: "“Smallest amplitude” 45 V is not below …".
[[nodiscard]] QString inFormWords(QString refusal);
/// Translated.
[[nodiscard]] QString profileWords(const char* text);

class ProfileTabs final : public QTabWidget {
    Q_OBJECT
public:
    struct Refusal {
        const ProfileField* field = nullptr;
        QString text;
    };

    explicit ProfileTabs(QWidget* parent = nullptr);
    /// Shows the values of `document`, a whole profile as toJson() writes it.
    void fill(const nlohmann::json& document);
    /// Writes what the fields hold into `document`, up to the first that does not hold a number; returns that one.
    [[nodiscard]] std::optional<Refusal> read(nlohmann::json& document) const;
    /// Shows `refusal` beside `field` and on its tab, and no other; null: none. Disables the fields that have no
    /// meaning with what is chosen now, except the refused one.
    void mark(const ProfileField* field, const QString& refusal);

    /// The tab of the field `key` is shown, and the field has the focus. `key` as in a profile's file.
    void goTo(const QString& key);

signals:
    void edited();

private:
    [[nodiscard]] QWidget* buildTab(ProfileTab tab);
    [[nodiscard]] FieldForm& formOf(const ProfileField& field) const { return *forms_[std::size_t(field.tab)]; }

    std::array<FieldForm*, kProfileTabs> forms_{};
};

}  // namespace tacto::gui
