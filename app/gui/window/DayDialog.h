// DayDialog.h - asks for today's operator and sample; and a button in the menu bar that shows both and asks again.
#pragma once

#include <QDialog>
#include <QToolButton>

#include "app/gui/controller/DayNotes.h"

namespace tacto::gui {

/// Takes over each entry as it is typed. Closing the dialog postpones the question for today.
class DayDialog final : public QDialog {
    Q_OBJECT
public:
    DayDialog(DayNotes& day, QWidget* parent);
};

/// Shows "A. Weber · sample S-014", or asks for both; in a menu bar it stands in the right corner.
class DayButton final : public QToolButton {
    Q_OBJECT
public:
    DayButton(DayNotes& day, QWidget* parent);

protected:
    void changeEvent(QEvent* event) override;

private:
    void say();
    DayNotes& day_;
};

}  // namespace tacto::gui
