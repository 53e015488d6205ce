#include "app/gui/pilot/SessionStartPage.h"

#include <QRadioButton>
#include <QRandomGenerator>
#include <QScrollBar>
#include <QSignalBlocker>
#include <algorithm>

#include "app/gui/pilot/DeviceRows.h"
#include "app/gui/pilot/SessionPath.h"
#include "app/gui/pilot/UnfinishedOffer.h"
#include "app/gui/theme/Building.h"
#include "app/gui/theme/Icons.h"
#include "app/gui/theme/Pages.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/ToolRow.h"

namespace tacto::gui {

namespace {
constexpr int kStartWide = 1200, kTwoColumns = 900;
constexpr int kMaxPlanSeed = 1'000'000'000;
}  // namespace

SessionStartPage::SessionStartPage(const DeviceWatch& watch, QWidget* parent)
    : QWidget(parent),
      head_(makeLabel({}, {.name = "sessionHead", .size = TextSize::Large}, this)),
      about_(new QLabel(this)),
      offer_(new UnfinishedOffer(this)),
      trouble_(new TroubleLine("sessionTrouble", this)) {
    setObjectName("sessionStart");
    auto* whole = columnIn(*this, 0);
    page_ = new ScrollingPage(this);
    auto* inside = new QWidget(page_->viewport());
    boundWidth(*inside, kStartWide);
    auto* column = columnIn(*inside, 12, {kPagePad, kPagePad, kPagePad, kPagePad});
    setTone(*about_, Tone::Quiet);
    for (auto* label : {head_, about_}) {
        wrapPlain(*label);
    }
    addAll(*column, {head_, about_, offer_});
    // Tab follows the order of creation: devices and screens first, then the checklist, then the buttons.
    auto* form = buildForm(*inside, watch);
    buildChecklist();
    begin_ = pageButton(tr("Begin the session"), "beginSession", {}, this);
    // The checklist is placed to the right of the form if there is room.
    auto* body = new TurningRow([] { return scaledPx(kTwoColumns); });
    body->setSpacing(scaledPx(32));
    body->addLayout(form, 1);
    body->addWidget(asks_, 1);
    column->addLayout(body);
    column->addStretch();
    page_->hold(inside);
    whole->addWidget(page_, 1);
    trouble_->setContentsMargins(kPagePad, 0, kPagePad, 8);
    whole->addWidget(trouble_);
    auto* foot = addPageFoot(*whole, this, QBoxLayout::TopToBottom);
    begin_->setIcon(icon("run", Ink::Primary));
    makePrimary(*begin_);
    endDay_ =
        pageButton(tr("End the day: keep the yes"), "endDay",
                   tr("The study keeps the answer, sealed: no session with this participant begins today."), this);
    makePrimary(*endDay_);
    auto* back = pageButton(tr("Back to the study"), "backToStudy", {}, this);
    whyNot_ = makeLabel({}, {.name = "whyNotBegin", .tone = Tone::Quiet, .wraps = true, .plain = true}, this);
    foot->addWidget(whyNot_);
    auto* buttons = new QHBoxLayout;
    for (auto* button : {begin_, endDay_, back}) buttons->addWidget(button);
    buttons->addStretch();
    foot->addLayout(buttons);
    connect(begin_, &QPushButton::clicked, this, &SessionStartPage::beginWanted);
    connect(endDay_, &QPushButton::clicked, this, &SessionStartPage::endDayWanted);
    connect(back, &QPushButton::clicked, this, &SessionStartPage::backWanted);
    connect(offer_, &UnfinishedOffer::changed, this, &SessionStartPage::judge);
}

/// Builds the form: what to run, the devices, and screens and keys for both people.
QLayout* SessionStartPage::buildForm(QWidget& parent, const DeviceWatch& watch) {
    form_ = new FieldForm(&parent, FieldForm::Labels::Beside);
    devices_ = new DeviceRows(*form_, watch);
    seats_ = std::make_unique<SeatRows>(*form_);
    auto fields = procedureFields();
    for (const auto& more : {devices_->fields(), seats_->fields()}) std::ranges::copy(more, std::back_inserter(fields));
    form_->show(fields);
    seats_->connectFields();
    auto* column = new QVBoxLayout;
    column->setSpacing(12);
    column->addWidget(form_);
    column->addWidget(seats_->about());
    column->addStretch();
    connect(devices_, &DeviceRows::changed, this, &SessionStartPage::judge);
    connect(&seats_->inputs(), &InputRows::changed, this, &SessionStartPage::judge);
    connect(form_, &FieldForm::edited, this, &SessionStartPage::judge);
    return column;
}

void SessionStartPage::buildChecklist() {
    asks_ = new QWidget(this);
    checklist_ = new ExclusionChecklist(asks_);
    auto* column = columnIn(*asks_, 8);
    column->addWidget(strongLabel(tr("Exclusion checklist: ask each, today"), asks_));
    column->addWidget(
        explanation(tr("A yes ends the day, whatever is answered later. Which one it was is sealed."), asks_));
    column->addWidget(checklist_);
    column->addStretch();
    connect(checklist_, &ExclusionChecklist::changed, this, &SessionStartPage::judge);
}

QString SessionStartPage::prepare(const Study& study, const Participant& participant) {
    const auto refusal = [&](bool again) {
        const auto may = study.mayTakePart(participant, again);
        return may ? QString() : sentence(may.error());
    };
    const auto unfinished = unfinishedOf(study, participant);
    const bool mayGoOn = unfinished && *unfinished && (*unfinished)->mayGoOn;
    refusedAnew_ = refusal(false);
    refusedAgain_ = mayGoOn ? refusal(true) : refusedAnew_;
    if (!refusedAnew_.isEmpty() && !refusedAgain_.isEmpty()) return refusedAgain_;
    code_ = participant.code;
    virtual_ = participant.virtualSeed.has_value();
    rehearsal_ = study.isRehearsal();
    massager_ = study.settings().modality == Modality::Massager;
    checklist_->ask(exclusionItems(study.settings()));
    asks_->setVisible(!virtual_);
    seats_->showFor(!virtual_);
    seats_->setBlind(study.settings().blind);
    seats_->offerWords(qtext(study.folder().string()), study.settings().words);
    blocks_ = study.settings().blocks;
    study_ = qtext(study.settings().id);
    seats_->recall(study_);
    if (const auto& approved = study.settings().procedure) form_->set("method", qtext(nameOf(approved->method)));
    say(unfinished ? QString() : sentence(unfinished.error()));
    offer_->offer({});  // forgets an earlier choice
    offer_->offer(unfinished ? *unfinished : std::nullopt);
    title_ = qtext(study.settings().title);
    head_->setText(tr("A session of %1").arg(qtext(code_)));
    seed_ = participant.virtualSeed.value_or(0);
    devices_->offer(study.settings(), !virtual_);
    judge();
    if (auto* first = form_->findChild<QWidget*>("protocol"); first != nullptr) first->setFocus();
    page_->verticalScrollBar()->setValue(0);
    return {};
}

void SessionStartPage::chooseGoOn() { offer_->chooseGoOn(); }

PilotStart SessionStartPage::start() const {
    PilotStart made;
    made.title = title_;
    made.participant = code_;
    made.devices = devices_->chosen();
    made.massager = massager_;
    made.studyBlocks = blocks_;
    made.who = qtext(code_);
    made.person = !virtual_;
    made.confirmsCode = !virtual_;
    made.rehearsal = rehearsal_;
    if (!virtual_) made.exclusions = checklist_->answers();
    made.unfinished = offer_->chosen();
    made.inputsOf = study_;
    made.seed = std::uint64_t(QRandomGenerator::system()->bounded(1, kMaxPlanSeed));
    seats_->writeTo(made);
    return made;
}

void SessionStartPage::judge() {
    followOffer(*form_, *offer_);
    const int blocks = isWholeSession(*form_) ? blocks_ : 0;
    about_->setText(virtual_ ? tr("A virtual participant of seed %1, on the simulated bench. It answers no to the "
                                  "checklist and is done in seconds.")
                                   .arg(seed_)
                             : tr("The person reads the code on their own screen and says whether it is theirs, before "
                                  "anything else. With them the whole takes %1.")
                                   .arg(sessionLasts(blocks)));
    const auto open = checklist_->answers().size();
    const bool whole = virtual_ || checklist_->whole();
    const bool chosen = offer_->isSettled();
    auto lacks = devices_->missing();
    if (lacks.isEmpty()) lacks = seats_->missing(!virtual_);
    const bool refused = sayRefused(*trouble_, *form_);
    const auto& mayNot = offer_->goesOn() ? refusedAgain_ : refusedAnew_;
    asks_->setEnabled(!chosen || mayNot.isEmpty());
    const bool yes = !virtual_ && std::ranges::any_of(checklist_->answers(), &ExclusionAnswer::yes);
    const auto why =
        yes ? tr("A question was answered with yes: there is no session today. End the day, and the study keeps it.") +
                  (checklist_->changedFromYes() ? ' ' + tr("If the yes was a slip, tick so below the questions.")
                                                : QString())
        : !chosen           ? tr("First choose what happens to the interrupted session.")
        : !mayNot.isEmpty() ? mayNot
        : !lacks.isEmpty()  ? lacks
        : !whole            ? tr("%1 of %2 questions of the checklist are answered; each is needed.")
                       .arg(open)
                       .arg(checklist_->items().size())
                 : QString();
    begin_->setEnabled(why.isEmpty() && !refused);
    begin_->setVisible(!yes);
    endDay_->setVisible(yes);
    whyNot_->setText(why);
    whyNot_->setVisible(!why.isEmpty());
    begin_->setToolTip(
        !why.isEmpty() ? why : tr("Every condition of the study is looked at first. Nothing is delivered before."));
    begin_->setText(offer_->goesOn() ? tr("Go on with the session") : tr("Begin the session"));
}

void SessionStartPage::say(const QString& what) { trouble_->say(what); }

ExclusionChecklist::ExclusionChecklist(QWidget* parent)
    : QWidget(parent), grid_(new QGridLayout), slip_(new QCheckBox(tr("The yes was a slip: the answer is no"), this)) {
    nameWidget(*this, "exclusionChecklist", tr("Exclusion checklist"));
    slip_->setObjectName("yesWasASlip");
    connect(slip_, &QCheckBox::toggled, this, &ExclusionChecklist::changed);
    auto* column = columnIn(*this, 8);
    column->addLayout(grid_);
    column->addWidget(slip_);
    grid_->setHorizontalSpacing(scaledPx(16));
    grid_->setVerticalSpacing(scaledPx(8));
    grid_->setColumnStretch(0, 1);
    ask(exclusionItems());
}

void ExclusionChecklist::ask(const std::vector<ExclusionItem>& items) {
    // The rows of questions that stay keep their place in the tab order.
    const auto [end, ignored] = std::ranges::mismatch(items_, items);
    for (auto stays = std::size_t(end - items_.begin()); groups_.size() > stays;
         groups_.pop_back(), items_.pop_back(), saidYes_.pop_back()) {
        delete grid_->itemAtPosition(int(groups_.size()) - 1, 0)->widget();
        qDeleteAll(groups_.back()->buttons());
        delete groups_.back();
    }
    for (auto* group : groups_) {
        group->setExclusive(false);
        for (auto* choice : group->buttons()) choice->setChecked(false);
        group->setExclusive(true);
    }
    while (items_.size() < items.size()) addRow(items[items_.size()]);
    saidYes_.assign(items_.size(), false);
    slip_->setChecked(false);
    slip_->hide();
}

void ExclusionChecklist::addRow(const ExclusionItem& item) {
    const int row = int(items_.size());
    grid_->addWidget(makeLabel(qtext(item.question), {.wraps = true, .plain = true}, this), row, 0);
    auto* group = new QButtonGroup(this);
    QWidget* before = groups_.empty() ? nullptr : groups_.back()->button(kYes);
    for (const auto answer : {kNo, kYes}) {
        auto* choice = new QRadioButton(answer == kYes ? tr("yes") : tr("no"), this);
        nameWidget(*choice, qtext(item.key) + (answer == kYes ? "-yes" : "-no"),
                   tr("%1 %2").arg(qtext(item.question), choice->text()));
        group->addButton(choice, answer);
        grid_->addWidget(choice, row, 1 + answer, Qt::AlignTop);
        if (before != nullptr) setTabOrder(before, choice);
        before = choice;
    }
    setTabOrder(before, slip_);
    connect(group, &QButtonGroup::idToggled, this, [this, row](int answer, bool on) {
        if (on) noteAnswer(std::size_t(row), answer == kYes);
        emit changed();
    });
    groups_.push_back(group);
    items_.push_back(item);
    saidYes_.push_back(false);
}

void ExclusionChecklist::noteAnswer(std::size_t row, bool yes) {
    if (yes) {
        saidYes_[row] = true;
        const QSignalBlocker once(slip_);
        slip_->setChecked(false);  // a tick was about an earlier yes
    }
    slip_->setVisible(changedFromYes());
}

bool ExclusionChecklist::changedFromYes() const {
    for (std::size_t i = 0; i < groups_.size(); ++i)
        if (saidYes_[i] && groups_[i]->checkedId() == kNo) return true;
    return false;
}

std::vector<ExclusionAnswer> ExclusionChecklist::answers() const {
    std::vector<ExclusionAnswer> all;
    for (std::size_t i = 0; i < groups_.size(); ++i) {
        if (const int given = groups_[i]->checkedId(); given >= 0)
            all.push_back({items_[i].key, given == kYes || (saidYes_[i] && !slip_->isChecked())});
    }
    return all;
}

}  // namespace tacto::gui

#include "moc_SessionStartPage.cpp"
