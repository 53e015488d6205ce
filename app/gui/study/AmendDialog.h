// AmendDialog.h - changes a study's settings under an amendment of the committee, which has a reference of its own.
//
// Thread-safety: the GUI thread.
#pragma once

#include "app/gui/study/StudyDialog.h"
#include "app/gui/study/StudyForm.h"

namespace tacto::gui {

class AmendDialog final : public StudyDialog {
    Q_OBJECT
public:
    /// `study` outlives it.
    AmendDialog(OpenStudy& study, QWidget* parent);

private:
    void amend();
    StudyForm* form_;
};

}  // namespace tacto::gui
