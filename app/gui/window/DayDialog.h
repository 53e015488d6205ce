// DayDialog.h - asks who works today and on which sample; and the button in the menu bar that shows it and asks again.
#pragma once

#include <QDialog>
#include <QToolButton>

#include "app/gui/controller/DayNotes.h"

namespace tacto::gui {

/// Takes what is entered as it is entered. Closing it puts the question off for today.
class DayDialog final : public QDialog {
    Q_OBJECT
public:
    DayDialog(DayNotes& day, QWidget* parent);
};

/// "A. Weber · sample S-014", or the question.
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
