#include "app/gui/pilot/RehearsalPage.h"

#include <QDateTime>
#include <QDir>
#include <QSettings>
#include <QStandardPaths>

#include "app/gui/pilot/InputRows.h"
#include "app/gui/pilot/SessionPath.h"
#include "app/gui/pilot/UnfinishedOffer.h"
#include "app/gui/theme/Building.h"
#include "app/gui/theme/Icons.h"
#include "app/gui/theme/Pages.h"
#include "app/gui/theme/Text.h"

namespace tacto::gui {

namespace {

constexpr int kFormWide = 620;
constexpr int kMaxBlocks = 10, kMaxSeed = 1'000'000;

QString newFolder() {
    const QDir documents(QStandardPaths::writableLocation(QStandardPaths::DocumentsLocation));
    return documents.filePath("Tactoscope/rehearsal-" + QDateTime::currentDateTime().toString("yyyyMMdd-HHmmss"));
}

constexpr const char* kLast = "lastRehearsal";  // of QSettings

/// What the rehearsal in a folder says about the next session; all empty if there is none yet.
struct SeenRehearsal {
    std::optional<Modality> modality = {};
    std::optional<Unfinished> unfinished = {};
    std::optional<bool> person = {};             ///< whether a person answered in the participant's last session
    QString ended = {};                          ///< the id of the last session that has ended
    std::optional<std::uint64_t> lastSeed = {};  ///< of the last session's participant
};

/// `participant`: empty for the one of the last session.
SeenRehearsal seenIn(const QString& folder, const std::string& participant = {}) {
    SeenRehearsal seen;
    if (folder.isEmpty() || !Study::isThere(folder.toStdString())) return seen;
    const auto study = Study::open(folder.toStdString(), nullptr, Study::Access::Read);
    if (!study || !study->isRehearsal()) return seen;
    seen.modality = study->settings().modality;
    const auto sessions = study->sessions();
    const auto last = sessions.empty() ? std::string() : sessions.back().code;
    if (const auto theirs = study->find(last)) seen.lastSeed = theirs->virtualSeed;
    const auto who = study->find(participant.empty() ? last : participant);
    for (const auto& session : sessions) {
        if (who && session.participant == who->id) seen.person = session.basis != SessionBasis::Virtual;
        if (session.state != StudySessionState::Unfinished && session.opened) seen.ended = qtext(session.id);
    }
    if (!who) return seen;
    if (const auto found = unfinishedOf(*study, *who)) seen.unfinished = *found;
    return seen;
}

/// Returns the last rehearsal's folder if its session was interrupted, perhaps with the program; otherwise a new one.
QString firstFolder() {
    const auto last = QSettings().value(kLast).toString();
    return seenIn(last).unfinished ? last : newFolder();
}

constexpr double kTenfold = 10, kFourfold = 4;

}  // namespace

RehearsalPage::RehearsalPage(QWidget* parent)
    : QWidget(parent),
      title_(makeLabel({}, {.name = "rehearsalTitle", .size = TextSize::Large}, this)),
      folder_(new FolderRow(firstFolder(), tr("A new folder, or the folder of a rehearsal to continue."),
                            tr("The rehearsal’s folder"), this)),
      offer_(new UnfinishedOffer(this)),
      trouble_(new TroubleLine("rehearsalTrouble", this)) {
    auto* whole = columnIn(*this, 0);
    auto* page = new ScrollingPage(this);
    auto* inside = new QWidget(page->viewport());
    auto* column = columnIn(*inside, 8, {kPagePad, kPagePad, kPagePad, kPagePad / 2});
    column->addWidget(title_);
    column->addWidget(explanation(
        tr("The whole session as participant and operator see it, on simulated devices: checklist, thresholds, "
           "training, test, ratings. No person receives any output."),
        inside));
    folder_->line().setObjectName("studyFolder");
    folder_->line().setAccessibleName(tr("Folder of the rehearsal"));
    form_ = new FieldForm(inside, FieldForm::Labels::Beside);
    boundWidth(*form_, kFormWide);
    seats_ = std::make_unique<SeatRows>(*form_);
    form_->show(fields());
    seats_->connectFields();
    seats_->recall(kRehearsals);
    if (const auto seed = seenIn(folder_->folder()).lastSeed) form_->set("rehearsalSeed", QString::number(*seed));
    column->addWidget(form_);
    column->addWidget(seats_->about());
    column->addStretch();
    page->hold(inside);
    whole->addWidget(page, 1);
    auto* foot = addPageFoot(*whole, this, QBoxLayout::TopToBottom);
    foot->addWidget(trouble_);
    begin_ = pageButton(tr("Begin rehearsal"), "beginRehearsal", {}, this);
    begin_->setIcon(icon("run", Ink::Primary));
    makePrimary(*begin_);
    connect(begin_, &QPushButton::clicked, this, [this] {
        QSettings().setValue(kLast, folder());
        emit beginWanted();
    });
    result_ = pageButton(tr("Show the last result"), "lastResult",
                         tr("What the last session of this rehearsal that has ended came to."), this);
    connect(result_, &QPushButton::clicked, this, [this] { emit resultWanted(ended_); });
    auto* both = new QHBoxLayout;
    for (auto* button : {begin_, result_}) both->addWidget(button);
    whyNot_ = makeLabel({}, {.name = "whyNotRehearse", .tone = Tone::Quiet, .wraps = true, .plain = true}, this);
    both->addWidget(whyNot_, 1);
    foot->addLayout(both);
    connect(&folder_->line(), &QLineEdit::textChanged, this, &RehearsalPage::look);
    connect(offer_, &UnfinishedOffer::changed, this, &RehearsalPage::judge);
    connect(&seats_->inputs(), &InputRows::changed, this, &RehearsalPage::judge);
    connect(form_, &FieldForm::edited, this, [this] { form_->text("rehearsalSeed") == seen_ ? judge() : look(); });
    look();
}

/// Returns the fields: folder, interrupted session, who answers and how fast, what to run, and the devices.
std::vector<FormField> RehearsalPage::fields() const {
    std::vector<FormField> all{
        ownField(tr("Folder"), folder_),
        ownField({}, offer_),
        choiceField(
            "whoAnswers", tr("Participant"),
            {{"virtual", tr("a virtual participant")}, {"person", tr("you, in their window")}},
            tr("A virtual participant answers by itself. Either way nothing but simulated devices is used. Who began "
               "a rehearsal goes on with it.")),
        choiceField("rehearsalPace", tr("Pace"),
                    {{"fast", tr("as fast as possible")},
                     {"tenfold", tr("ten times as fast as a person, to watch")},
                     {"own", tr("the session’s own")}},
                    tr("As fast as possible: seconds. Ten times as fast: some minutes; no screen stays for more than a "
                       "second. The session’s own: as long as with a person, to watch what is delivered.")),
        choiceField("ownPace", tr("Pace"),
                    {{"fourfold", tr("four times as fast as a session")}, {"own", tr("the session’s own")}},
                    tr("What is presented, and the pauses, pass four times as fast: nothing is felt, so nothing is "
                       "lost. You have as long to answer as ever. The session’s own: as a participant will know it.")),
        wholeField("rehearsalSeed", tr("Seed"), 1, kMaxSeed, 1,
                   tr("The same seed gives the same order, and the same virtual participant.")),
        choiceField("rehearsalModality", tr("Felt through"),
                    {{qtext(nameOf(Modality::Electrodes)), tr("electrodes")},
                     {qtext(nameOf(Modality::Massager)), tr("a massager")}},
                    tr("These devices make what is felt; a massager has a strength instead of a current. A rehearsal "
                       "keeps the devices that it began with."))};
    std::ranges::copy(procedureFields(), std::back_inserter(all));
    all.push_back(wholeField("rehearsalBlocks", tr("Blocks of the test"), 1, kMaxBlocks, kUsualBlocks,
                             tr("Each block has 18 trials: four per condition and two empty.")));
    std::ranges::copy(seats_->fields(), std::back_inserter(all));
    return all;
}

bool RehearsalPage::person() const { return form_->text("whoAnswers") == "person"; }

bool RehearsalPage::mayGoOn() const { return offer_->asks() && offer_->offered()->mayGoOn; }

PilotStart RehearsalPage::rehearsal() const {
    PilotStart made;
    made.folder = folder_->folder();
    made.title = made.folder.section('/', -1);
    made.seed = form_->text("rehearsalSeed").toULongLong();
    made.participant = fmt::format("virtual:{}", made.seed);
    made.person = person();
    const auto pace = form_->text("rehearsalPace");
    made.realTime = !made.person && pace == "own";
    if (made.person)
        made.pace = form_->text("ownPace") == "fourfold" ? kFourfold : 0;
    else
        made.pace = pace == "tenfold" ? kTenfold : 0;
    made.who = made.person ? tr("you") : tr("virtual, seed %1").arg(made.seed);
    made.unfinished = offer_->chosen();
    const auto modality = form_->text("rehearsalModality").toStdString();
    made.massager = modality == nameOf(Modality::Massager);
    if (!modality_) made.modality = modality;
    if (!offer_->goesOn()) made.blocks = form_->text("rehearsalBlocks").toInt();
    made.inputsOf = kRehearsals;
    seats_->writeTo(made);
    return made;
}

void RehearsalPage::look() {
    seen_ = form_->text("rehearsalSeed");
    const auto seen = seenIn(folder_->folder(), "virtual:" + seen_.toStdString());
    modality_ = seen.modality;
    person_ = seen.person;
    ended_ = seen.ended;
    if (modality_) form_->set("rehearsalModality", qtext(nameOf(*modality_)));
    form_->setFieldEnabled("rehearsalModality", !modality_);
    if (person_) form_->set("whoAnswers", *person_ ? "person" : "virtual");
    form_->setFieldEnabled("whoAnswers", !person_);
    title_->setText(modality_ ? tr("Another session of this rehearsal") : tr("A new rehearsal"));
    result_->setVisible(!ended_.isEmpty());
    seats_->offerWords(folder_->folder(), {});
    offer_->offer(seen.unfinished);
    judge();
}

void RehearsalPage::renew() { folder_->line().setText(newFolder()); }

void RehearsalPage::judge() {
    followOffer(*form_, *offer_);
    form_->setRowVisible("rehearsalPace", !person());
    form_->setRowVisible("ownPace", person());
    const auto pace = form_->text("rehearsalPace");
    seats_->showFor(person(), pace == "own" ? tr("about an hour") : pace == "tenfold" ? tr("some minutes") : QString());
    form_->setFieldEnabled("rehearsalBlocks", !offer_->goesOn() && isWholeSession(*form_));
    const auto lacks = seats_->missing(person());
    const bool refused = sayRefused(*trouble_, *form_);
    const auto why = !offer_->isSettled() ? tr("First choose what happens to the interrupted session.")
                     : folder_->folder().isEmpty()
                         ? tr("The folder is missing. A new one, or that of a rehearsal, is expected.")
                         : lacks;
    begin_->setEnabled(why.isEmpty() && !refused);
    const int blocks = isWholeSession(*form_) ? form_->text("rehearsalBlocks").toInt() : 0;
    const bool asASession = person() && form_->text("ownPace") == "own";
    whyNot_->setText(!why.isEmpty() || !asASession ? why : tr("With you it takes %1.").arg(sessionLasts(blocks)));
    begin_->setToolTip(
        !why.isEmpty() ? why : tr("Opens both windows. Nothing is delivered before the checklist is answered."));
    begin_->setText(offer_->goesOn() ? tr("Go on with the rehearsal") : tr("Begin rehearsal"));
}

void RehearsalPage::say(const QString& what) { trouble_->say(what); }

}  // namespace tacto::gui

#include "moc_RehearsalPage.cpp"
