#include "app/gui/study/StudyDialog.h"

#include <QDialogButtonBox>

#include "app/gui/theme/Dialogs.h"
#include "app/gui/theme/Pages.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"

namespace tacto::gui {

StudyDialog::StudyDialog(OpenStudy& study, const QString& name, const QString& title, const QString& explains,
                         QWidget* parent)
    : QDialog(parent), study_(study), column_(new QVBoxLayout(this)), trouble_(new TroubleLine({}, this)) {
    setObjectName(name);
    setWindowTitle(title);
    column_->addWidget(heading(title, this));
    if (!explains.isEmpty()) column_->addWidget(explanation(explains, this));
}

void StudyDialog::scroll(QWidget* page, int least) {
    auto* scrolling = new ScrollingPage(this);
    scrolling->hold(page);
    if (least > 0) scrolling->setMinimumHeight(least);
    column_->addWidget(scrolling, 1);
    scrolls_ = true;
}

QPushButton* StudyDialog::finish(const QString& trouble, QPushButton* act) {
    trouble_->setObjectName(trouble);
    if (!scrolls_) column_->addStretch(1);  // what is asked stays together below the heading
    column_->addWidget(trouble_);
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel, this);
    buttons->addButton(act, QDialogButtonBox::ActionRole);
    auto* cancel = buttons->button(QDialogButtonBox::Cancel);
    for (auto* button : {cancel, act}) button->setAutoDefault(false);
    column_->addWidget(buttons);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    growWithContent(*this);
    return cancel;
}

Study* StudyDialog::openStudy(const QString& nothing) {
    auto* study = study_.study();
    if (study == nullptr) refuse(QObject::tr("The study is not open any more. %1").arg(nothing));
    return study;
}

void StudyDialog::refuse(const QString& why) { trouble_->say(why); }

void StudyDialog::refuse(const Error& error) { refuse(sentence(error)); }

void StudyDialog::noteAndClose() {
    study_.noteChange();
    accept();
}

}  // namespace tacto::gui
