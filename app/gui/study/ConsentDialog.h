// ConsentDialog.h - notes that a participant consented: to which version, when, and before which investigator.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QDialog>
#include <QLabel>

#include "app/gui/runner/ParameterForm.h"
#include "app/gui/study/OpenStudy.h"

namespace tacto::gui {

class ConsentDialog final : public QDialog {
    Q_OBJECT
public:
    /// `study` outlives it.
    ConsentDialog(OpenStudy& study, const QString& code, QWidget* parent);

private:
    void note();
    OpenStudy& study_;
    const QString code_;
    ParameterForm* form_;
    QLabel* trouble_;
};

}  // namespace tacto::gui
