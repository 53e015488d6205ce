#include "app/gui/study/ConsentDialog.h"

#include <QPushButton>

#include "app/gui/study/DialogField.h"
#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {
constexpr int kConsentWide = 420;
}  // namespace

ConsentDialog::ConsentDialog(OpenStudy& study, const QString& code, QWidget* parent)
    : StudyDialog(study, "consentDialog", tr("Consent of %1").arg(code),
                  tr("The signed form stays on paper, apart from the code. What you enter here is sealed."), parent),
      code_(code),
      form_(new ParameterForm(this)) {
    setMinimumWidth(scaledPx(kConsentWide));
    const auto* open = opened().study();
    ProtocolDeclaration fields;
    fields.parameters = {dialogField("version", tr("Version of the form that was signed"), ParameterType::Text,
                                     open == nullptr ? std::string() : open->settings().consentVersion),
                         dialogField("date", tr("Day on which it was signed"), ParameterType::Date,
                                     open == nullptr ? std::string() : dateText(open->today())),
                         dialogField("by", tr("Investigator’s initials"), ParameterType::Text, std::string())};
    form_->show(fields);
    for (const auto& [name, tip] : {std::pair("version", tr("Sessions need consent to the version in force.")),
                                    std::pair("date", tr("No later than today.")),
                                    std::pair("by", tr("The investigator’s initials, not the participant’s."))})
        form_->findChild<QWidget*>(name)->setToolTip(tip);
    form_->referencePart().hide();  // a consent has none
    column().addWidget(form_);
    auto* note = new QPushButton(tr("Note the consent"), this);
    note->setObjectName("noteConsent");
    makePrimary(*note);
    finish("consentTrouble", note);
    note->setDefault(true);
    connect(note, &QPushButton::clicked, this, &ConsentDialog::note);
}

void ConsentDialog::note() {
    auto* study = openStudy(tr("Nothing was noted."));
    if (study == nullptr) return;
    const auto date = parseDate(form_->text("date").toStdString());
    if (!date) return refuse(tr("The day is missing. One as 2026-11-21 is expected."));
    const auto noted = study->consent(code_.toStdString(),
                                      {form_->text("version").toStdString(), *date, form_->text("by").toStdString()});
    if (!noted) return refuse(noted.error());
    noteAndClose();
}

}  // namespace tacto::gui

#include "moc_ConsentDialog.cpp"
