#include "app/gui/study/EndPartDialog.h"

#include <QFormLayout>

#include "app/gui/theme/ConfirmButton.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {
constexpr int kEndPartWide = 480;
}

EndPartDialog::EndPartDialog(OpenStudy& study, How how, const QString& code, QWidget* parent)
    : StudyDialog(study, how == How::Withdraw ? "withdrawDialog" : "leaveDialog",
                  (how == How::Withdraw ? tr("%1 withdraws") : tr("%1 leaves the study")).arg(code), {}, parent),
      how_(how),
      code_(code) {
    const bool withdraws = how == How::Withdraw;
    setMinimumWidth(scaledPx(kEndPartWide));
    const auto say = [&](const QString& what, const char* name) {
        auto* label = new QLabel(what, this);
        label->setObjectName(name);
        label->setTextFormat(Qt::PlainText);
        label->setWordWrap(true);
        label->setTextInteractionFlags(Qt::TextSelectableByMouse);
        column().addWidget(label);
    };
    if (withdraws) {
        say(tr("The key to everything that %1 did and answered is destroyed. The data can never be opened again. The "
               "study keeps only that a participant withdrew, when, after how many sessions, and adverse events.")
                .arg(code),
            "withdrawWhat");
        say(tr("This program cannot reach copies of the key file, backups, and spare blocks of a solid-state disk: "
               "they still open the data for anyone with the passphrase. Delete the copies by hand."),
            "withdrawCopies");
        say(exportsText(), "withdrawExports");
        auto* form = new QFormLayout;
        typed_ = new QLineEdit(this);
        typed_->setObjectName("withdrawCode");
        typed_->setPlaceholderText(code);
        typed_->setToolTip(tr("The participant’s code, typed once more."));
        form->addRow(tr("Type the &code"), typed_);
        column().addLayout(form);
        connect(typed_, &QLineEdit::textChanged, this, &EndPartDialog::judge);
    } else {
        say(tr("%1 takes part in no further session. The collected data stay, and are part of results and exports. "
               "If they want their data destroyed, they withdraw instead.")
                .arg(code),
            "leaveWhat");
    }
    end_ = new ConfirmButton(withdraws ? tr("Destroy the key") : tr("Leave the study"), this);
    end_->setObjectName("endPart");
    finish("endPartTrouble", end_);
    connect(end_, &QPushButton::clicked, this, &EndPartDialog::end);
    judge();
}

QString EndPartDialog::exportsText() const {
    const auto* study = opened().study();
    const auto all = study == nullptr ? std::vector<StudyExport>() : study->exports();
    if (all.empty()) return tr("Nothing was exported from this study.");
    QStringList places;
    for (const auto& one : all) places << "• " + qtext(one.place);
    return tr("Exported files stay where they were saved. Delete them by hand:") + '\n' + places.join('\n');
}

void EndPartDialog::judge() {
    end_->setEnabled(typed_ == nullptr || typed_->text().trimmed().compare(code_, Qt::CaseInsensitive) == 0);
}

void EndPartDialog::end() {
    auto* study = openStudy(tr("Nothing was changed."));
    if (study == nullptr) return;
    const auto code = code_.toStdString();
    const auto done = how_ == How::Withdraw ? study->withdraw(code) : study->leave(code);
    if (!done) return refuse(done.error());
    noteAndClose();
}

}  // namespace tacto::gui

#include "moc_EndPartDialog.cpp"
