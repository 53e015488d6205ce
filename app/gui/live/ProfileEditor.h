// ProfileEditor.h - the encoding profile as a form with a drawing of the mapping: edit, check, apply, open, save.
//
// A wrong value is refused in the core's own words next to its field, and is never applied; no value is clamped.
#pragma once

#include <QDialog>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QTimer>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/gui/controller/BenchController.h"
#include "app/gui/live/ProfilePreview.h"
#include "app/gui/live/ProfileTabs.h"

namespace tacto::gui {

class ProfileEditor final : public QDialog {
    Q_OBJECT
public:
    /// Deletes itself when closed.
    explicit ProfileEditor(BenchController& controller, QWidget* parent = nullptr);
    /// Opens the field `key`, as named in a profile file.
    void goTo(const QString& key);
    /// Returns the sentence that refuses the form's values; empty if they are valid.
    [[nodiscard]] QString trouble() const { return trouble_; }
    /// Reads a profile file into the form; if the file is wrong, says why and keeps the form.
    void openFile(const QString& path);
    void saveFile(const QString& path);

private:
    struct Read {
        std::optional<Profile> profile;
        QString refusal;
        const ProfileField* where = nullptr;
    };
    [[nodiscard]] QWidget* buildButtons();
    void fill(const Profile& profile);
    [[nodiscard]] Read read() const;
    void judge();
    void say(const QString& text, bool wrong);
    void apply();
    void chooseFile();
    void chooseTarget();

    BenchController& controller_;
    nlohmann::json document_;  ///< the document loaded; keeps fields that the form does not show
    QLineEdit* name_;
    ProfileTabs* tabs_;
    QLabel* says_;
    QLabel* facts_;
    QPushButton* apply_ = nullptr;
    QPushButton* save_ = nullptr;
    ProfilePreview* preview_;
    QTimer look_;
    QString trouble_;
    bool filling_ = false;
    bool applying_ = false;
};

}  // namespace tacto::gui
