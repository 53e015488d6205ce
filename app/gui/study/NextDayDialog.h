// NextDayDialog.h - notes what a participant reports on a day after a session: side effects, redness, swelling.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QComboBox>
#include <vector>

#include "app/gui/runner/ParameterForm.h"
#include "app/gui/study/StudyDialog.h"

namespace tacto::gui {

class NextDayDialog final : public StudyDialog {
    Q_OBJECT
public:
    /// `code`: whose last session is chosen first; may be empty. `study` outlives it.
    NextDayDialog(OpenStudy& study, const QString& code, QWidget* parent);

private:
    [[nodiscard]] QWidget* buildItems();
    void note();
    struct Item {
        QComboBox* severity;
        QComboBox* relation;
    };
    ParameterForm* form_;
    std::vector<Item> items_;  // as kSideEffects
};

}  // namespace tacto::gui
