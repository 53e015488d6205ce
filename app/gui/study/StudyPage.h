// StudyPage.h - page for studies in the Pilot workspace: opens or creates a study, then lists its contents.
#pragma once

#include <QLabel>
#include <QPointer>
#include <QPushButton>
#include <QWidget>

#include "app/gui/study/OpenStudy.h"
#include "app/gui/study/PassphraseDialog.h"
#include "app/gui/study/StudyForm.h"
#include "app/gui/theme/EntryFields.h"
#include "app/gui/theme/Labels.h"

namespace tacto::gui {

class NewStudyPage;
class PageStack;
class PassphraseDialog;
class StudyList;
class StudyResults;

class StudyPage final : public QWidget {
    Q_OBJECT
public:
    /// `study` must outlive this.
    explicit StudyPage(OpenStudy& study, QWidget* parent = nullptr);
    /// Opens a study; asks for its passphrase if there is one.
    void open(const QString& folder);
    [[nodiscard]] StudyList& list() { return *list_; }

signals:
    void sessionWanted(const QString& code);

private:
    enum Page { kNone, kNew, kList, kResults };
    [[nodiscard]] QWidget* buildNone();
    void showNone();
    void showRecent();
    void chooseFolder();
    void say(const QString& what);
    OpenStudy& study_;
    PageStack* pages_;
    NewStudyPage* new_;
    QPushButton* open_ = nullptr;
    QPushButton* create_ = nullptr;
    QVBoxLayout* recent_ = nullptr;
    StudyList* list_ = nullptr;
    StudyResults* results_ = nullptr;
    TroubleLine* trouble_ = nullptr;
    QPointer<PassphraseDialog> asks_;
};

/// The page to create a study: its folder, its settings, and then a passphrase.
class NewStudyPage final : public QWidget {
    Q_OBJECT
public:
    /// `study` must outlive this.
    explicit NewStudyPage(OpenStudy& study, QWidget* parent = nullptr);
    /// Empties the page for a new study.
    void clear();

signals:
    void cancelled();

private:
    /// Disables the button, with the reason beside it, while a value is refused. Returns the settings otherwise.
    std::optional<StudySettings> judge();
    void askForPassphrase();
    OpenStudy& study_;
    FolderRow* folder_;
    StudyForm* form_ = nullptr;
    TroubleLine* trouble_;
    QPushButton* create_ = nullptr;
};

}  // namespace tacto::gui
