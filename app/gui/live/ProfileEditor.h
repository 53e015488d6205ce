// ProfileEditor.h - the encoding profile as a form with its mapping drawn: edit, check, apply, open, save.
//
// A wrong value is said in the validation's own sentence and is never applied; nothing is clamped.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QComboBox>
#include <QDialog>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <nlohmann/json.hpp>

#include "app/gui/desk/BenchDesk.h"
#include "app/gui/live/ProfilePreview.h"

namespace tacto::gui {

class ProfileEditor final : public QDialog {
    Q_OBJECT
public:
    ProfileEditor(BenchDesk& desk, QWidget* parent = nullptr);
    /// The sentence that refuses what the form holds; empty when it is sound.
    [[nodiscard]] QString trouble() const { return trouble_->text(); }

private:
    [[nodiscard]] QWidget* buildForm();
    [[nodiscard]] QWidget* buildButtons();
    void fill(const Profile& profile);
    [[nodiscard]] Result<Profile> read() const;
    void judge();
    void apply();
    void load();
    void save();

    BenchDesk& desk_;
    Profile profile_;  ///< what the form began with; keeps what the form does not show
    std::vector<std::pair<std::string, QLineEdit*>> numbers_;
    std::vector<std::pair<std::string, QComboBox*>> choices_;
    QLabel* trouble_;
    QLabel* facts_;
    QPushButton* apply_;
    QPushButton* save_;
    ProfilePreview* preview_;
};

}  // namespace tacto::gui
