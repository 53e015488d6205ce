// NewStudyPage.h - what a new study needs before it is made: its folder, its settings, and then a passphrase.
//
// Thread-safety: the GUI thread.
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

class NewStudyPage final : public QWidget {
    Q_OBJECT
public:
    /// `study` outlives it.
    explicit NewStudyPage(OpenStudy& study, QWidget* parent = nullptr);
    /// As a new one.
    void clear();

signals:
    void cancelled();

private:
    void askForPassphrase();
    OpenStudy& study_;
    FolderRow* folder_;
    StudyForm* form_ = nullptr;
    TroubleLine* trouble_;
    QPointer<PassphraseDialog> asks_;
};

}  // namespace tacto::gui
