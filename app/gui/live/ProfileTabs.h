// ProfileTabs.h - a profile's fields on tabs, each with its range and, if refused, the reason next to it.
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

/// A field as shown to people: its place in the form, its label, and its effect. Units, ranges and choices come from
/// the core's table (profileFields() of core/bench/Profile.h), which alone decides what is valid.
struct ProfileField {
    ProfileTab tab;
    const char* key;
    const char* label;
    const char* tip;
    std::vector<const char*> words{};   ///< the file's words, in order, phrased for people; empty for a number
    const char* accepts = nullptr;      ///< text shown instead of the range
    const char* needs = nullptr;        ///< the field applies only if the choice with this key...
    const char* needsValue = nullptr;   ///< ...has this value, or with a leading '!' any other value
    const FieldInfo* stored = nullptr;  ///< the field's entry in the core's table

    [[nodiscard]] const char* section() const noexcept;  ///< its section in the profile file
    [[nodiscard]] bool isChoice() const noexcept { return !stored->words.empty(); }
    /// Returns, for example, "0.01 to 500 V".
    [[nodiscard]] QString range() const;
};

[[nodiscard]] const std::vector<ProfileField>& profileForm();
/// Returns the field that a refusal names first; null if it names none.
[[nodiscard]] const ProfileField* fieldIn(const QString& refusal);
/// Replaces the file's keys in a refusal by the form's names: "“Smallest amplitude” 45 V is not below …".
[[nodiscard]] QString inFormWords(QString refusal);
/// Returns the translated text.
[[nodiscard]] QString profileWords(const char* text);

class ProfileTabs final : public QTabWidget {
    Q_OBJECT
public:
    struct Refusal {
        const ProfileField* field = nullptr;
        QString text;
    };

    explicit ProfileTabs(QWidget* parent = nullptr);
    /// Shows the values of `document`, a whole profile as written by toJson().
    void fill(const nlohmann::json& document);
    /// Writes the fields into `document`, up to the first without a valid number; returns that field.
    [[nodiscard]] std::optional<Refusal> read(nlohmann::json& document) const;
    /// Shows `refusal` next to `field` and marks its tab, clearing all other refusals; null: none. Disables fields that
    /// have no effect with the present choices, except `field`.
    void mark(const ProfileField* field, const QString& refusal);

    /// Shows the tab of the field `key` (as in a profile file) and gives the field the focus.
    void goTo(const QString& key);

signals:
    void edited();

private:
    [[nodiscard]] QWidget* buildTab(ProfileTab tab);
    [[nodiscard]] FieldForm& formOf(const ProfileField& field) const { return *forms_[std::size_t(field.tab)]; }

    std::array<FieldForm*, kProfileTabs> forms_{};
};

}  // namespace tacto::gui
