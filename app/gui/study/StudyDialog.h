// StudyDialog.h - the frame of a dialog that changes an open study: heading, explanation, what is asked, a line for
// what went wrong, and Cancel beside the button that acts.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QDialog>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

#include "app/gui/study/OpenStudy.h"
#include "app/gui/theme/Labels.h"

namespace tacto::gui {

class StudyDialog : public QDialog {
protected:
    /// `study` outlives it. `name` is the object's; without `explains` there is no explanation.
    StudyDialog(OpenStudy& study, const QString& name, const QString& title, const QString& explains, QWidget* parent);
    /// What is asked goes in here, before finish().
    [[nodiscard]] QVBoxLayout& column() { return *column_; }
    /// Takes `page` where it may need more room than the screen has; at least `least` pixels of it are in sight.
    void scroll(QWidget* page, int least = 0);
    /// The line for what went wrong, named `trouble`, and the buttons; none of them is the default. Returns Cancel.
    QPushButton* finish(const QString& trouble, QPushButton* act);

    [[nodiscard]] OpenStudy& opened() const { return study_; }
    /// The study to change; null, with `nothing` said ("Nothing was noted."), once it is not open any more.
    [[nodiscard]] Study* openStudy(const QString& nothing);
    void refuse(const QString& why);
    void refuse(const Error& error);
    void clearTrouble() { trouble_->say({}); }
    /// The study was changed: tells the others and closes.
    void noteAndClose();

private:
    OpenStudy& study_;
    QVBoxLayout* column_;
    TroubleLine* trouble_;
    bool scrolls_ = false;
};

}  // namespace tacto::gui
