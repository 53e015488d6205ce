// ConsentDialog.h - notes that a participant consented: to which version, when, and before which investigator.
//
// Thread-safety: the GUI thread.
#pragma once

#include "app/gui/runner/ParameterForm.h"
#include "app/gui/study/StudyDialog.h"

namespace tacto::gui {

class ConsentDialog final : public StudyDialog {
    Q_OBJECT
public:
    /// `study` outlives it.
    ConsentDialog(OpenStudy& study, const QString& code, QWidget* parent);

private:
    void note();
    const QString code_;
    ParameterForm* form_;
};

}  // namespace tacto::gui
