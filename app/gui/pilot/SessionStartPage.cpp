#include "app/gui/pilot/SessionStartPage.h"

#include <QFormLayout>
#include <QHBoxLayout>
#include <QRandomGenerator>
#include <QVBoxLayout>

#include "app/gui/pilot/DeviceRows.h"
#include "app/gui/pilot/ExclusionChecklist.h"
#include "app/gui/pilot/UnfinishedOffer.h"
#include "app/gui/theme/Icons.h"
#include "app/gui/theme/LookChange.h"
#include "app/gui/theme/ScrollingPage.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"
#include "app/gui/theme/TurningRow.h"

namespace tacto::gui {

namespace {
constexpr int kStartPad = 16, kStartWide = 1200, kTwoColumns = 900;
constexpr int kMaxPlanSeed = 1'000'000'000;
}  // namespace

SessionStartPage::SessionStartPage(const DeviceWatch& watch, QWidget* parent)
    : QWidget(parent),
      head_(new QLabel(this)),
      about_(new QLabel(this)),
      offer_(new UnfinishedOffer(this)),
      protocol_(new QComboBox(this)),
      method_(new QComboBox(this)),
      trouble_(new TroubleLine("sessionTrouble", this)) {
    setObjectName("sessionStart");
    auto* whole = new QVBoxLayout(this);
    whole->setContentsMargins(0, 0, 0, 0);
    whole->setSpacing(0);
    auto* page = new ScrollingPage(this);
    auto* inside = new QWidget(page->viewport());
    boundWidth(*inside, kStartWide);
    auto* column = new QVBoxLayout(inside);
    column->setContentsMargins(kStartPad, kStartPad, kStartPad, kStartPad);
    column->setSpacing(12);
    head_->setObjectName("sessionHead");
    setTextSize(*head_, TextSize::Large);
    setTone(*about_, Tone::Quiet);
    for (auto* label : {head_, about_}) {
        label->setTextFormat(Qt::PlainText);
        label->setWordWrap(true);
    }
    column->addWidget(head_);
    column->addWidget(about_);
    column->addWidget(offer_);
    auto* form = new QFormLayout;
    form->setVerticalSpacing(8);
    form->setRowWrapPolicy(QFormLayout::WrapLongRows);
    protocol_->setObjectName("sessionProtocol");
    protocol_->addItem(tr("the whole session"), "pilot-identification");
    protocol_->addItem(tr("thresholds alone"), "pilot-thresholds");
    form->addRow(tr("What is run"), protocol_);
    method_->setObjectName("sessionMethod");
    method_->addItem(tr("QUEST+"), "quest");
    method_->addItem(tr("weighted staircase"), "staircase");
    form->addRow(tr("Detection by"), method_);
    devices_ = new DeviceRows(*form, *inside, watch);
    seats_ = std::make_unique<SeatRows>(*form, *inside);
    // Tab goes from what is made first to what is made later: devices and seats, the checklist, then the buttons.
    asks_ = new QWidget(this);
    checklist_ = new ExclusionChecklist(asks_);
    begin_ = new QPushButton(tr("Begin the session"), this);
    auto* left = new QVBoxLayout;
    left->setSpacing(12);
    left->addLayout(form);
    left->addWidget(seats_->about());
    left->addStretch();
    // The checklist stands beside the rest where there is room.
    auto* body = new TurningRow([] { return scaledPx(kTwoColumns); });
    body->setSpacing(scaledPx(32));
    body->addLayout(left, 1);
    body->addWidget(asks_, 1);
    column->addLayout(body);
    auto* asks = new QVBoxLayout(asks_);
    asks->setContentsMargins(0, 0, 0, 0);
    asks->setSpacing(8);
    auto* title = new QLabel(tr("Exclusion checklist: ask each, today"), asks_);
    setTextSize(*title, TextSize::Body, true);
    asks->addWidget(title);
    asks->addWidget(
        explanation(tr("A yes ends the day, whatever is answered later. Which one it was is sealed."), asks_));
    asks->addWidget(checklist_);
    asks->addStretch();
    column->addStretch();
    page->hold(inside);
    whole->addWidget(page, 1);
    trouble_->setContentsMargins(kStartPad, 0, kStartPad, 8);
    whole->addWidget(trouble_);
    auto* edge = new QFrame(this);
    edge->setFrameShape(QFrame::HLine);
    edge->setForegroundRole(QPalette::Mid);
    whole->addWidget(edge);
    auto* foot = new QHBoxLayout;
    foot->setContentsMargins(kStartPad, 12, kStartPad, 12);
    foot->setSpacing(8);
    begin_->setObjectName("beginSession");
    begin_->setIcon(icon("run", Ink::Primary));
    makePrimary(*begin_);
    auto* back = new QPushButton(tr("Back to the study"), this);
    back->setObjectName("backToStudy");
    for (auto* button : {begin_, back}) {
        button->setAutoDefault(false);
        foot->addWidget(button);
    }
    foot->addStretch();
    whole->addLayout(foot);
    connect(begin_, &QPushButton::clicked, this, &SessionStartPage::beginWanted);
    connect(back, &QPushButton::clicked, this, &SessionStartPage::backWanted);
    connect(checklist_, &ExclusionChecklist::changed, this, &SessionStartPage::judge);
    connect(devices_, &DeviceRows::changed, this, &SessionStartPage::judge);
    connect(offer_, &UnfinishedOffer::changed, this, &SessionStartPage::judge);
    connect(&seats_->inputs(), &InputRows::changed, this, &SessionStartPage::judge);
    connect(&seats_->markers(), &QLineEdit::textChanged, this, &SessionStartPage::judge);
}

void SessionStartPage::prepare(const Study& study, const Participant& participant) {
    code_ = participant.code;
    virtual_ = participant.virtualSeed.has_value();
    rehearsal_ = study.isRehearsal();
    massager_ = study.settings().modality == Modality::Massager;
    checklist_->clear();
    asks_->setVisible(!virtual_);
    seats_->showFor(!virtual_);
    seats_->setBlind(study.settings().blind);
    study_ = qtext(study.settings().id);
    seats_->recall(study_);
    if (const auto& approved = study.settings().procedure)
        method_->setCurrentIndex(method_->findData(qtext(nameOf(approved->method))));
    const auto unfinished = unfinishedOf(study, participant);
    say(unfinished ? QString() : sentence(unfinished.error()));
    offer_->offer(unfinished ? *unfinished : std::nullopt);
    title_ = qtext(study.settings().title);
    head_->setText(tr("A session of %1").arg(qtext(code_)));
    about_->setText(virtual_ ? tr("A virtual participant of seed %1, on the simulated bench. It answers no to the "
                                  "checklist and is done in seconds.")
                                   .arg(*participant.virtualSeed)
                             : tr("The person reads the code on their own screen and says whether it is theirs, before "
                                  "anything else."));
    devices_->offer(study.settings(), !virtual_);
    judge();
}

PilotStart SessionStartPage::start() const {
    PilotStart made;
    made.title = title_;
    made.participant = code_;
    made.devices = devices_->chosen();
    made.massager = massager_;
    made.who = qtext(code_);
    made.person = !virtual_;
    made.confirmsCode = !virtual_;
    made.rehearsal = rehearsal_;
    if (!virtual_) made.exclusions = checklist_->answers();
    made.protocol = protocol_->currentData().toString().toStdString();
    made.method = method_->currentData().toString().toStdString();
    made.unfinished = offer_->chosen();
    made.inputsOf = study_;
    made.seed = std::uint64_t(QRandomGenerator::system()->bounded(1, kMaxPlanSeed));
    seats_->writeTo(made);
    return made;
}

void SessionStartPage::judge() {
    const bool goesOn = offer_->chosen() == "resume";
    if (goesOn) protocol_->setCurrentIndex(protocol_->findData(qtext(offer_->offered()->protocol)));
    for (auto* box : {protocol_, method_}) box->setEnabled(!goesOn);
    const auto open = checklist_->answers().size();
    const bool whole = virtual_ || checklist_->whole();
    const bool chosen = !offer_->asks() || !offer_->chosen().empty();
    auto lacks = devices_->missing();
    if (lacks.isEmpty()) lacks = seats_->missing(!virtual_);
    begin_->setEnabled(whole && chosen && lacks.isEmpty());
    begin_->setToolTip(!chosen            ? tr("First choose what happens to the interrupted session.")
                       : !lacks.isEmpty() ? lacks
                       : !whole           ? tr("%1 of %2 questions of the checklist are answered; each is needed.")
                                      .arg(open)
                                      .arg(exclusionItems().size())
                                : tr("Every condition of the study is looked at first. Nothing is delivered before."));
    begin_->setText(goesOn ? tr("Go on with the session") : tr("Begin the session"));
}

void SessionStartPage::say(const QString& what) { trouble_->say(what); }

}  // namespace tacto::gui

#include "moc_SessionStartPage.cpp"
