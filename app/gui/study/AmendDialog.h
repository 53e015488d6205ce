// AmendDialog.h - changes a study's settings under an amendment of the committee, which has a reference of its own.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QDialog>
#include <QLabel>

#include "app/gui/study/OpenStudy.h"
#include "app/gui/study/StudyForm.h"

namespace tacto::gui {

class AmendDialog final : public QDialog {
    Q_OBJECT
public:
    /// `study` outlives it.
    AmendDialog(OpenStudy& study, QWidget* parent);

private:
    void amend();
    OpenStudy& study_;
    StudyForm* form_;
    QLabel* trouble_;
};

}  // namespace tacto::gui
