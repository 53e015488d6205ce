// ProfileTabs.h - the fields of a profile (ProfileFields.h) on tabs, each with its range and, beside it, why it is
// refused.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QTabWidget>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "app/gui/live/ProfileFields.h"

namespace tacto::gui {

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
    struct Row {
        const ProfileField* field = nullptr;
        QLineEdit* line = nullptr;  ///< the field of a number
        QComboBox* box = nullptr;   ///< the field of a choice
        QLabel* label = nullptr;
        QLabel* refusal = nullptr;
    };
    [[nodiscard]] QWidget* buildTab(ProfileTab tab);
    [[nodiscard]] Row buildRow(const ProfileField& field, QWidget* page);
    void enableWhatMatters();

    std::vector<Row> rows_;
};

}  // namespace tacto::gui
