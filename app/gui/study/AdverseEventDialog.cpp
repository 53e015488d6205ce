#include "app/gui/study/AdverseEventDialog.h"

#include <QPushButton>
#include <QVBoxLayout>

#include "app/gui/study/DialogField.h"
#include "app/gui/study/DialogFoot.h"
#include "app/gui/theme/ScrollingPage.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {
constexpr int kEventWide = 520, kEventHigh = 580, kLeastForm = 120;
}

AdverseEventDialog::AdverseEventDialog(OpenStudy& study, const QString& code, QWidget* parent)
    : QDialog(parent), study_(study), form_(new ParameterForm), trouble_(new QLabel(this)) {
    setObjectName("adverseEventDialog");
    setWindowTitle(tr("An adverse event"));
    auto* column = new QVBoxLayout(this);
    column->addWidget(heading(tr("An adverse event"), this));
    column->addWidget(explanation(
        tr("It is sealed under the study’s key, stands in the committee’s report, and stays when the participant "
           "withdraws. Never write a name."),
        this));
    ProtocolDeclaration fields;
    if (const auto* open = study_.study()) fields.parameters.push_back(sessionField(*open, code));
    const auto needed = tr("the committee cannot judge it");
    auto what = dialogField("what", tr("What happened"), ParameterType::Text, {});
    what.needed = needed.toStdString();
    auto serious = dialogField("serious", tr("Serious"), ParameterType::Boolean, {});
    serious.value = false;
    auto reported = dialogField("reported", tr("Reported to the committee"), ParameterType::Boolean, {});
    reported.value = false;
    for (auto& field : {what, scoreField("severity", tr("Severity"), kEventSeverities, needed),
                        scoreField("relation", tr("Relation to the stimulation"), kRelations, needed), serious,
                        dialogField("action", tr("What was done"), ParameterType::Text, {}),
                        dialogField("outcome", tr("What became of it"), ParameterType::Text, {}), reported})
        fields.parameters.push_back(field);
    form_->show(fields);
    form_->referencePart().hide();
    auto* page = new ScrollingPage(this);
    page->hold(form_);
    column->addWidget(page, 1);
    trouble_->setObjectName("adverseEventTrouble");
    auto* note = new QPushButton(tr("Note the event"), this);
    note->setObjectName("noteEvent");
    makePrimary(*note);
    addFoot(*this, *column, *trouble_, note);
    connect(note, &QPushButton::clicked, this, &AdverseEventDialog::note);
    resize(scaledPx(kEventWide), kEventHigh);
    page->setMinimumHeight(scaledPx(kLeastForm));
}

void AdverseEventDialog::note() {
    auto* study = study_.study();
    if (study == nullptr) return trouble_->setText(tr("⚠ The study is not open any more. Nothing was noted."));
    if (const auto open = form_->unanswered(); !open.isEmpty()) {
        form_->goToRefused();
        return trouble_->setText("⚠ " + open);
    }
    AdverseEvent event;
    event.what = form_->text("what").trimmed().toStdString();
    event.severity = form_->text("severity").toInt();
    event.relation = form_->text("relation").toInt();
    event.serious = form_->text("serious") == "true";
    event.action = form_->text("action").trimmed().toStdString();
    event.outcome = form_->text("outcome").trimmed().toStdString();
    event.reported = form_->text("reported") == "true";
    const auto noted = study->adverseEvent(form_->text("session").toStdString(), event);
    if (!noted) return trouble_->setText("⚠ " + sentence(noted.error()));
    study_.noteChange();
    accept();
}

}  // namespace tacto::gui

#include "moc_AdverseEventDialog.cpp"
