#include "app/gui/study/GoBackDialog.h"

#include <QFormLayout>
#include <algorithm>

#include "app/gui/theme/ConfirmButton.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {
constexpr int kGoBackWide = 520;
}

GoBackDialog::GoBackDialog(OpenStudy& study, QWidget* parent)
    : StudyDialog(
          study, "goBackDialog", tr("Go back to an older ledger"),
          tr("Put the newest ledger back from your copy if there is one. Going back gives it up for good: it is "
             "noted in the ledger, stands in each report, and no session begins today."),
          parent),
      typed_(new QLineEdit(this)),
      back_(new ConfirmButton(tr("Give up what is lost"), this)) {
    setMinimumWidth(scaledPx(kGoBackWide));
    auto* lost = new QLabel(this);
    lost->setObjectName("goBackLoss");
    lost->setTextFormat(Qt::PlainText);
    lost->setWordWrap(true);
    lost->setTextInteractionFlags(Qt::TextSelectableByMouse);
    column().addWidget(lost);
    const auto* open = opened().study();
    const auto loss = open == nullptr ? Result<LedgerLoss>(fail(ErrorCode::NotFound, "the study is not open any more"))
                                      : open->lossOfGoingBack();
    lost->setText(loss ? sentence(Error{ErrorCode::Stopped, loss->sentence()}) : sentence(loss.error()));
    if (loss) word_ = qtext(loss->word());
    auto* form = new QFormLayout;
    if (opened().passphrase()) {
        passphrase_ = new PassphraseEdit(this);
        passphrase_->setObjectName("goBackPassphrase");
        passphrase_->setToolTip(tr("The study’s passphrase, typed once more."));
        form->addRow(tr("&Passphrase"), passphrase_);
        connect(passphrase_, &PassphraseEdit::edited, this, &GoBackDialog::judge);
    }
    typed_->setObjectName("goBackWord");
    typed_->setPlaceholderText(word_);
    typed_->setToolTip(tr("The word that names what is lost."));
    form->addRow(tr("Type the &word"), typed_);
    column().addLayout(form);
    back_->setObjectName("goBack");
    finish("goBackTrouble", back_);
    connect(typed_, &QLineEdit::textChanged, this, &GoBackDialog::judge);
    connect(back_, &QPushButton::clicked, this, &GoBackDialog::goBack);
    judge();
}

void GoBackDialog::judge() {
    back_->setEnabled(!word_.isEmpty() && typed_->text().trimmed() == word_ &&
                      (passphrase_ == nullptr || !passphrase_->isEmpty()));
}

void GoBackDialog::goBack() {
    auto* study = openStudy(tr("Nothing was changed."));
    if (study == nullptr) return;
    if (passphrase_ != nullptr) {
        const auto typed = passphrase_->typed();
        const bool same = opened().passphrase() && std::ranges::equal(typed.bytes(), opened().passphrase()->bytes());
        passphrase_->wipe();
        if (!same) return refuse(tr("The passphrase is another than the study’s. Nothing was changed."));
    }
    if (const auto done = study->goBack(word_.toStdString()); !done) return refuse(done.error());
    noteAndClose();
}

}  // namespace tacto::gui

#include "moc_GoBackDialog.cpp"
