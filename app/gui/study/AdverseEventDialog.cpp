#include "app/gui/study/AdverseEventDialog.h"

#include <QPushButton>

#include "app/gui/study/DialogField.h"
#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {
constexpr int kEventWide = 520, kEventHigh = 580, kMinFormHeight = 120;
}

AdverseEventDialog::AdverseEventDialog(OpenStudy& study, const QString& code, QWidget* parent)
    : StudyDialog(study, "adverseEventDialog", tr("An adverse event"),
                  tr("It is sealed under the study’s key, stands in the committee’s report, and stays when the "
                     "participant withdraws. Never write a name."),
                  parent),
      form_(new ParameterForm) {
    ProtocolDeclaration fields;
    if (const auto* open = opened().study()) fields.parameters.push_back(sessionField(*open, code));
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
    form_->setMissingSaidOnceLeft();
    form_->show(fields);
    form_->referencePart().hide();
    scroll(form_, scaledPx(kMinFormHeight));
    auto* note = new QPushButton(tr("Note the event"), this);
    note->setObjectName("noteEvent");
    makePrimary(*note);
    finish("adverseEventTrouble", note);
    connect(note, &QPushButton::clicked, this, &AdverseEventDialog::note);
    resize(scaledPx(kEventWide), kEventHigh);
}

void AdverseEventDialog::note() {
    auto* study = openStudy(tr("Nothing was noted."));
    if (study == nullptr) return;
    if (const auto open = form_->unanswered(); !open.isEmpty()) {
        form_->goToRefused();
        return refuse(open);
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
    if (!noted) return refuse(noted.error());
    noteAndClose();
}

}  // namespace tacto::gui

#include "moc_AdverseEventDialog.cpp"
