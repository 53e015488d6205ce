#include "app/gui/study/EnrolDialog.h"

#include <QFormLayout>
#include <algorithm>

#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {
constexpr int kMaxEnrolSeed = 1'000'000;
constexpr int kEnrolWide = 420;
}  // namespace

EnrolDialog::EnrolDialog(OpenStudy& study, QWidget* parent)
    : StudyDialog(study, "enrolDialog", tr("Enrol a participant"),
                  tr("A participant is known here by a code alone. Never write a name, a birth date or a hospital "
                     "number."),
                  parent),
      form_(new QWidget(this)),
      who_(new QComboBox(form_)),
      seed_(new QSpinBox(form_)),
      group_(new QComboBox(form_)),
      own_(new QLineEdit(form_)),
      age_(new QLineEdit(form_)),
      sex_(new QComboBox(form_)),
      hand_(new QComboBox(form_)),
      code_(new QLabel(this)),
      next_(new QLabel(this)) {
    setMinimumWidth(scaledPx(kEnrolWide));
    auto* form = new QFormLayout(form_);
    form->setContentsMargins(0, 0, 0, 0);
    who_->setObjectName("enrolWho");
    who_->addItem(tr("a person"), false);
    who_->addItem(tr("a virtual participant"), true);
    form->addRow(tr("&Who"), who_);
    seed_->setObjectName("enrolSeed");
    seed_->setRange(1, kMaxEnrolSeed);
    seed_->setToolTip(tr("The same seed is the same virtual participant."));
    form->addRow(tr("&Seed"), seed_);
    group_->setObjectName("enrolGroup");
    for (const auto& [word, group] : kParticipantGroups) group_->addItem(qtext(word), int(group));
    form->addRow(tr("&Group"), group_);
    own_->setObjectName("enrolCode");
    own_->setPlaceholderText(tr("a new one is drawn"));
    own_->setToolTip(tr("Only where the code comes from elsewhere. Its last character checks the others."));
    form->addRow(tr("&Code"), own_);
    const auto tip = tr("Only where the approval asks for it. It is sealed, and exported only on request.");
    age_->setObjectName("enrolAge");
    age_->setPlaceholderText(tr("not given"));
    age_->setToolTip(tip);
    form->addRow(tr("&Age in years"), age_);
    sex_->setObjectName("enrolSex");
    hand_->setObjectName("enrolHandedness");
    for (auto* box : {sex_, hand_}) {
        box->addItem(tr("not given"), QString());
        box->setToolTip(tip);
    }
    for (const auto word : kSexes) sex_->addItem(qtext(word), qtext(word));
    for (const auto word : kHandednesses) hand_->addItem(qtext(word), qtext(word));
    form->addRow(tr("Se&x"), sex_);
    form->addRow(tr("&Handedness"), hand_);
    column().addWidget(form_);
    code_->setObjectName("enrolledCode");
    code_->setAlignment(Qt::AlignCenter);
    code_->setTextInteractionFlags(Qt::TextSelectableByMouse);
    setTextSize(*code_, TextSize::Display);
    next_->setWordWrap(true);
    for (auto* label : {code_, next_}) {
        label->setTextFormat(Qt::PlainText);
        label->hide();
        column().addWidget(label);
    }
    enrol_ = new QPushButton(tr("Enrol"), this);
    enrol_->setObjectName("enrolNow");
    makePrimary(*enrol_);
    close_ = finish("enrolTrouble", enrol_);
    enrol_->setDefault(true);
    connect(enrol_, &QPushButton::clicked, this, &EnrolDialog::act);
    connect(who_, &QComboBox::currentIndexChanged, this, &EnrolDialog::judge);
    judge();
}

void EnrolDialog::judge() {
    const bool isVirtual = who_->currentData().toBool();
    auto* rows = static_cast<QFormLayout*>(form_->layout());
    rows->setRowVisible(seed_, isVirtual);
    for (QWidget* ofPerson : {static_cast<QWidget*>(age_), static_cast<QWidget*>(sex_), static_cast<QWidget*>(hand_)})
        rows->setRowVisible(ofPerson, !isVirtual);
}

void EnrolDialog::act() {
    if (code_->text().isEmpty()) return enrol();
    emit consentWanted(code_->text());
    accept();
}

void EnrolDialog::enrol() {
    auto* study = openStudy(tr("No participant was enrolled."));
    if (study == nullptr) return;
    Participant participant;
    participant.code = own_->text().trimmed().toStdString();
    participant.group = ParticipantGroup(group_->currentData().toInt());
    if (who_->currentData().toBool()) {
        participant.virtualSeed = std::uint64_t(seed_->value());
    } else {
        participant.age = age_->text().trimmed().toStdString();
        participant.sex = sex_->currentData().toString().toStdString();
        participant.handedness = hand_->currentData().toString().toStdString();
    }
    const auto enrolled = study->enrol(std::move(participant));
    if (!enrolled) return refuse(enrolled.error());
    showCode(*enrolled);
    opened().noteChange();
}

void EnrolDialog::showCode(const Participant& participant) {
    clearTrouble();
    form_->hide();
    enrol_->setText(tr("Note the consent…"));
    code_->setText(qtext(participant.code));
    next_->setText(participant.virtualSeed
                       ? tr("Enrolled. The consent to the form in force comes next, as for everyone.")
                       : tr("Enrolled. Give the person this code on paper: they read it on their own screen at each "
                            "session. Keep it apart from their name. Their consent comes next."));
    code_->show();
    next_->show();
    close_->setText(tr("Close"));
    adjustSize();
}

}  // namespace tacto::gui

#include "moc_EnrolDialog.cpp"
