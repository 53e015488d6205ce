#include "app/gui/study/AmendDialog.h"

#include <QPushButton>
#include <QVBoxLayout>

#include "app/gui/study/DialogFoot.h"
#include "app/gui/theme/ScrollingPage.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {
constexpr int kAmendWide = 860, kAmendHigh = 560;
}

AmendDialog::AmendDialog(OpenStudy& study, QWidget* parent)
    : QDialog(parent), study_(study), form_(new StudyForm), trouble_(new QLabel(this)) {
    setObjectName("amendDialog");
    setWindowTitle(tr("An amendment"));
    auto* column = new QVBoxLayout(this);
    column->addWidget(heading(tr("An amendment"), this));
    column->addWidget(explanation(
        tr("Change what the committee approved anew, and nothing else. From then on sessions keep to it. This "
           "program’s protocols and limit sets, and the profile in use, are stated anew as well."),
        this));
    auto* page = new ScrollingPage(this);
    if (const auto* open = study_.study()) form_->amend(open->settings());
    page->hold(form_);
    column->addWidget(page, 1);
    trouble_->setObjectName("amendTrouble");
    auto* amend = new QPushButton(tr("Note the amendment"), this);
    amend->setObjectName("amendNow");
    makePrimary(*amend);
    addFoot(*this, *column, *trouble_, amend);
    connect(form_, &StudyForm::edited, trouble_, &QLabel::clear);
    connect(amend, &QPushButton::clicked, this, &AmendDialog::amend);
    resize(scaledPx(kAmendWide), kAmendHigh);
}

void AmendDialog::amend() {
    auto* study = study_.study();
    if (study == nullptr) return trouble_->setText(tr("⚠ The study is not open any more. Nothing was changed."));
    auto settings = form_->read(study_.profile());
    if (!settings) return trouble_->setText("⚠ " + sentence(settings.error()));
    const auto reference = settings->approval.reference;
    const auto amended = study->amend(std::move(*settings), reference);
    if (!amended) return trouble_->setText("⚠ " + sentence(amended.error()));
    study_.noteChange();
    accept();
}

}  // namespace tacto::gui

#include "moc_AmendDialog.cpp"
