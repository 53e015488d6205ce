#include "app/gui/study/PassphraseDialog.h"

#include <QDialogButtonBox>
#include <QFormLayout>
#include <QVBoxLayout>

#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {
constexpr int kPassphraseChars = 60;
}

PassphraseDialog::PassphraseDialog(Purpose purpose, const QString& study, QWidget* parent)
    : QDialog(parent), purpose_(purpose), first_(new PassphraseEdit(this)), trouble_(new QLabel(this)) {
    const bool isNew = purpose == Purpose::New;
    setObjectName("passphraseDialog");
    setWindowTitle(isNew ? tr("A passphrase for the new study") : tr("Open a study"));
    auto* column = new QVBoxLayout(this);
    column->addWidget(heading(isNew ? tr("A passphrase for “%1”").arg(study) : tr("“%1” is sealed").arg(study), this));
    column->addWidget(explanation(
        isNew ? tr("It seals who takes part and what they answer. It is kept nowhere: a lost passphrase is lost data. "
                   "Write it on paper, seal that in an envelope and lock it away.")
              : tr("Codes, answers and levels are read with its passphrase only."),
        this));
    auto* form = new QFormLayout;
    first_->setObjectName("passphrase");
    first_->setMinimumWidth(fontMetrics().averageCharWidth() * kPassphraseChars);
    form->addRow(tr("&Passphrase"), first_);
    if (isNew) {
        second_ = new PassphraseEdit(this);
        second_->setObjectName("passphraseAgain");
        second_->setAccessibleName(tr("Passphrase once more"));
        form->addRow(tr("&Once more"), second_);
        connect(second_, &PassphraseEdit::edited, this, &PassphraseDialog::judge);
        connect(second_, &QLineEdit::returnPressed, this, &PassphraseDialog::give);
    }
    column->addLayout(form);
    trouble_->setObjectName("passphraseTrouble");
    trouble_->setTextFormat(Qt::PlainText);
    trouble_->setWordWrap(true);
    setTone(*trouble_, Tone::Warning);
    trouble_->setMinimumHeight(2 * fontMetrics().height());
    column->addWidget(trouble_);
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel, this);
    cancel_ = buttons->button(QDialogButtonBox::Cancel);
    go_ = buttons->addButton(isNew ? tr("Create the study") : tr("Open"), QDialogButtonBox::ActionRole);
    go_->setObjectName("usePassphrase");
    makePrimary(*go_);
    for (auto* button : buttons->buttons()) static_cast<QPushButton*>(button)->setAutoDefault(false);
    column->addWidget(buttons);
    connect(first_, &PassphraseEdit::edited, this, &PassphraseDialog::judge);
    connect(first_, &QLineEdit::returnPressed, this, &PassphraseDialog::give);
    connect(go_, &QPushButton::clicked, this, &PassphraseDialog::give);
    connect(buttons, &QDialogButtonBox::rejected, this, &PassphraseDialog::reject);
    judge();
    first_->setFocus();
}

void PassphraseDialog::judge() {
    if (second_ != nullptr) {
        const bool differs = !second_->isEmpty() && !first_->equals(*second_);
        trouble_->setText(differs ? tr("The two are not the same yet.") : QString());
    }
    const bool whole = !first_->isEmpty() && (second_ == nullptr || first_->equals(*second_));
    go_->setEnabled(whole && !looking_);
    cancel_->setEnabled(mayCancel());
}

bool PassphraseDialog::mayCancel() const { return !looking_ || purpose_ == Purpose::Open; }

void PassphraseDialog::reject() {
    if (!mayCancel()) return;
    if (looking_) emit givenUp();
    QDialog::reject();
}

void PassphraseDialog::give() {
    if (!go_->isEnabled()) return;
    passphrase_ = std::make_shared<const Secret>(first_->typed());
    looking_ = true;
    judge();
    trouble_->setText(purpose_ == Purpose::New ? tr("Making the keys…") : tr("Opening…"));
    emit given();
}

void PassphraseDialog::refuse(const QString& why) {
    looking_ = false;
    passphrase_.reset();
    first_->wipe();
    if (second_ != nullptr) second_->wipe();
    first_->setFocus();
    judge();
    trouble_->setText("⚠ " + why);
    adjustSize();
}

}  // namespace tacto::gui

#include "moc_PassphraseDialog.cpp"
