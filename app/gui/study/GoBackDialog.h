// GoBackDialog.h - goes on with a study's ledger that is not the newest that this computer knows: says what is lost,
// and takes the passphrase once more and the word that names the loss.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QLineEdit>
#include <QPushButton>

#include "app/gui/study/PassphraseEdit.h"
#include "app/gui/study/StudyDialog.h"

namespace tacto::gui {

class GoBackDialog final : public StudyDialog {
    Q_OBJECT
public:
    /// `study` outlives it.
    GoBackDialog(OpenStudy& study, QWidget* parent);

private:
    void judge();
    void goBack();
    QString word_;
    PassphraseEdit* passphrase_ = nullptr;  ///< a rehearsal has none
    QLineEdit* typed_;
    QPushButton* back_;
};

}  // namespace tacto::gui
