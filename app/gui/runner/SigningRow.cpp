#include "app/gui/runner/SigningRow.h"

#include <QTime>

#include "app/gui/theme/Building.h"
#include "app/gui/theme/Text.h"
#include "core/session/SessionLabels.h"
#include "core/session/SessionSignature.h"

namespace tacto::gui {

SigningRow::SigningRow(QWidget* parent)
    : QWidget(parent),
      signer_(new QLineEdit(this)),
      sign_(pageButton(tr("Note signature"), "signReport",
                       tr("Keeps the name, the time and the report’s hash in the session."), this)) {
    auto* row = rowIn(*this, 8);
    nameWidget(*signer_, "signedBy", tr("Signed by"), tr("Who signed the report, in ink or in the PDF."));
    signer_->setPlaceholderText(tr("Signed by"));
    signer_->setMaxLength(int(kLabelLimit));
    row->addWidget(signer_, 1);
    row->addWidget(sign_);
    connect(signer_, &QLineEdit::textChanged, this, &SigningRow::judge);
    connect(sign_, &QPushButton::clicked, this, &SigningRow::sign);
    judge();
}

void SigningRow::offer(const QString& session, const QString& report, const QString& by) {
    if (session != session_) {
        noted_.clear();
        signer_->setText(by);
    }
    session_ = session;
    report_ = report;
    judge();
}

void SigningRow::judge() { sign_->setEnabled(!busy_ && !report_.isEmpty() && !signer_->text().trimmed().isEmpty()); }

void SigningRow::sign() {
    busy_ = true;
    judge();
    const auto by = signer_->text().simplified().toStdString(), report = report_.toStdString();
    signing_.start(
        this, [by, report, session = session_.toStdString()] { return signReport(session, report, by); },
        [this, session = session_](const Result<SessionSignature>& done) {
            busy_ = false;
            judge();
            if (session != session_) return;  // another run has ended since
            if (!done) return emit ended(tr("Not signed: %1").arg(sentence(done.error())));
            noted_ = tr("Signed by %1, %2").arg(qtext(done->by), QTime::currentTime().toString("HH:mm"));
            emit ended(noted_);
        });
}

}  // namespace tacto::gui

#include "moc_SigningRow.cpp"
