#include "app/gui/study/AmendDialog.h"

#include <QPushButton>

#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {
constexpr int kAmendWide = 860, kAmendHigh = 560;
}

AmendDialog::AmendDialog(OpenStudy& study, QWidget* parent)
    : StudyDialog(study, "amendDialog", tr("An amendment"),
                  tr("Change only what the committee has newly approved. Later sessions follow it. The amendment also "
                     "restates this program’s protocols and limit sets and the profile in use."),
                  parent),
      form_(new StudyForm) {
    if (const auto* open = opened().study()) form_->amend(open->settings());
    scroll(form_);
    auto* amend = new QPushButton(tr("Note the amendment"), this);
    amend->setObjectName("amendNow");
    makePrimary(*amend);
    finish("amendTrouble", amend);
    connect(form_, &StudyForm::edited, this, &AmendDialog::clearTrouble);
    connect(amend, &QPushButton::clicked, this, &AmendDialog::amend);
    resize(scaledPx(kAmendWide), kAmendHigh);
}

void AmendDialog::amend() {
    auto* study = openStudy(tr("Nothing was changed."));
    if (study == nullptr) return;
    auto settings = form_->read(opened().profile());
    if (!settings) return refuse(settings.error());
    const auto reference = settings->approval.reference;
    const auto amended = study->amend(std::move(*settings), reference);
    if (!amended) return refuse(amended.error());
    noteAndClose();
}

}  // namespace tacto::gui

#include "moc_AmendDialog.cpp"
