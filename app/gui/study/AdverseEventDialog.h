// AdverseEventDialog.h - notes an adverse event of a session. It survives a withdrawal.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QDialog>
#include <QLabel>

#include "app/gui/runner/ParameterForm.h"
#include "app/gui/study/OpenStudy.h"

namespace tacto::gui {

class AdverseEventDialog final : public QDialog {
    Q_OBJECT
public:
    /// `code`: whose last session is chosen first; may be empty. `study` outlives it.
    AdverseEventDialog(OpenStudy& study, const QString& code, QWidget* parent);

private:
    void note();
    OpenStudy& study_;
    ParameterForm* form_;
    QLabel* trouble_;
};

}  // namespace tacto::gui
