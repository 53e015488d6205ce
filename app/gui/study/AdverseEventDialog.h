// AdverseEventDialog.h - notes an adverse event of a session. It survives a withdrawal.
//
// Thread-safety: the GUI thread.
#pragma once

#include "app/gui/runner/ParameterForm.h"
#include "app/gui/study/StudyDialog.h"

namespace tacto::gui {

class AdverseEventDialog final : public StudyDialog {
    Q_OBJECT
public:
    /// `code`: whose last session is chosen first; may be empty. `study` outlives it.
    AdverseEventDialog(OpenStudy& study, const QString& code, QWidget* parent);

private:
    void note();
    ParameterForm* form_;
};

}  // namespace tacto::gui
