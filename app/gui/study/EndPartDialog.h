// EndPartDialog.h - ends a participant's part in a study: leaving keeps their data, withdrawing destroys the key to
// them, which takes the code typed once more and says what it cannot reach.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QLineEdit>
#include <QPushButton>

#include "app/gui/study/StudyDialog.h"

namespace tacto::gui {

class EndPartDialog final : public StudyDialog {
    Q_OBJECT
public:
    enum class How { Leave, Withdraw };
    /// `study` outlives it.
    EndPartDialog(OpenStudy& study, How how, const QString& code, QWidget* parent);

private:
    [[nodiscard]] QString exportsText() const;
    void judge();
    void end();
    const How how_;
    const QString code_;
    QLineEdit* typed_ = nullptr;
    QPushButton* end_;
};

}  // namespace tacto::gui
