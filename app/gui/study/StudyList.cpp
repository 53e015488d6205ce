#include "app/gui/study/StudyList.h"

#include <QApplication>
#include <QDateTime>
#include <QFileInfo>
#include <QMenu>
#include <QSignalBlocker>
#include <algorithm>
#include <ranges>
#include <utility>

#include "app/gui/runner/ReportView.h"
#include "app/gui/study/PageTable.h"
#include "app/gui/study/PassphraseDialog.h"
#include "app/gui/study/StudyDialogs.h"
#include "app/gui/theme/Building.h"
#include "app/gui/theme/Dialogs.h"
#include "app/gui/theme/Icons.h"
#include "app/gui/theme/Pages.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/ToolRow.h"
#include "core/kinds/ResultKinds.h"
#include "core/session/SessionReader.h"
#include "core/study/StudyFiles.h"

namespace tacto::gui {

namespace {

using nlohmann::json;

constexpr int kListPad = 16;

QString stateWords(ParticipantState state) {
    switch (state) {
        case ParticipantState::Active:
            return QObject::tr("takes part");
        case ParticipantState::Left:
            return QObject::tr("has left; data kept");
        case ParticipantState::Withdrawn:
            break;
    }
    return QObject::tr("has withdrawn");
}

QString consentWords(const Study& study, const Participant& participant) {
    if (participant.consents.empty()) return QObject::tr("none yet");
    const auto& last = participant.consents.back();
    const auto words = QObject::tr("version %1, %2").arg(qtext(last.version), qtext(dateText(last.date)));
    return study.consented(participant) ? words : "⚠ " + words;
}

/// Returns the code in the chosen row; empty if none is chosen.
QString chosenIn(const PageTable& participants) {
    const int row = participants.chosenRow();
    return row < 0 ? QString() : participants.item(row, 0)->text();
}

}  // namespace

json participantRows(const Study& study) {
    auto rows = json::array();
    for (const auto& one : study.participants()) {
        if (one.state == ParticipantState::Withdrawn) continue;
        const auto who =
            one.virtualSeed ? QObject::tr("virtual, seed %1").arg(*one.virtualSeed) : QObject::tr("person");
        rows.push_back({{"code", one.code},
                        {"who", who.toStdString()},
                        {"group", wordFor(Words<ParticipantGroup>(kParticipantGroups), one.group)},
                        {"state", stateWords(one.state).toStdString()},
                        {"consent", consentWords(study, one).toStdString()},
                        {"sessions", one.sessions}});
    }
    return rows;
}

StudyList::StudyList(OpenStudy& study, QWidget* parent)
    : QWidget(parent),
      study_(study),
      title_(makeLabel({}, {.name = "studyTitle", .size = TextSize::Large}, this)),
      facts_(makeLabel({}, {.name = "studyFacts", .tone = Tone::Quiet}, this)),
      keys_(makeLabel({}, {.name = "studyKeys", .tone = Tone::Quiet, .selectable = true}, this)),
      hold_(makeLabel({}, {.name = "studyHolds", .tone = Tone::Warning}, this)),
      trouble_(new QLabel(this)),
      participants_(new PageTable("participants", tr("Participants"), *this, kListPad, true)),
      withdrawn_(new QLabel(this)),
      sessions_(new StudySessions(*this)) {
    setObjectName("studyList");
    auto* column = columnIn(*this, 8, {kListPad, kListPad, kListPad, kListPad});
    trouble_->setObjectName("studyTrouble");
    setTone(*withdrawn_, Tone::Quiet);
    for (auto* label : {title_, facts_, keys_, hold_, trouble_, withdrawn_}) {
        wrapPlain(*label);
    }
    addAll(*column, {title_, facts_, keys_, hold_, trouble_});
    trouble_->hide();
    column->addSpacing(8);
    column->addWidget(buildParticipants());
    ofOneRow_ = buildOfOne();
    for (QWidget* each : std::initializer_list<QWidget*>{participants_, withdrawn_, ofOneRow_, sessions_})
        column->addWidget(each);
    connect(participants_, &QTableWidget::itemSelectionChanged, this, [this] {
        code_ = chosenIn(*participants_);
        judge();
    });
    column->addStretch();
    foot_ = buildFoot();
    connect(&study_, &OpenStudy::changed, this, &StudyList::refresh);
    connect(sessions_, &StudySessions::resultWanted, this, [this](const QString& id) {
        say({});
        study_.readResult(id);
    });
    connect(&study_, &OpenStudy::exported, this,
            [this](const QString& place) { say(tr("The results lie in %1.").arg(place), false); });
    connect(&reports_, &ReportMaker::done, this, [this](const QString& out, const QString& signs) {
        const bool shows = out.endsWith(".pdf", Qt::CaseInsensitive);
        auto words = tr("The report is %1.").arg(out);
        if (shows && signs.isEmpty()) words += ' ' + tr("It tells of no closed session that could keep a signature.");
        say(words, false);
        if (shows) ReportWindow::showReport(*this, out, signs);
    });
    connect(&reports_, &ReportMaker::failed, this, [this](const QString& why) { say(why); });
    refresh();
}

QAction* StudyList::addAction(QPushButton& to, const QString& text, const char* name, std::function<void()> act) {
    auto* action = to.menu()->addAction(text);
    action->setObjectName(name);
    connect(action, &QAction::triggered, this, [this, act = std::move(act)] {
        say({});
        act();
    });
    return action;
}

void StudyList::choose(const QString& code) {
    for (int row = 0; row < participants_->rowCount(); ++row) {
        if (participants_->item(row, 0)->text() == code) participants_->selectRow(row);
    }
}

void StudyList::askForConsent(const QString& code) { openDialog(consentDialog(study_, code, this)); }

QWidget* StudyList::buildParticipants() {
    auto* holder = new QWidget(this);
    auto* row = rowIn(*holder, 12);
    row->addWidget(strongLabel(tr("Participants"), holder));
    auto* enrol = pageButton(tr("Enrol…"), "enrol", tr("A new participant, who is given a code."), holder);
    connect(enrol, &QPushButton::clicked, this, [this] {
        say({});
        const auto consentWanted = [this](const QString& code) {
            choose(code);
            askForConsent(code);
        };
        openDialog(enrolDialog(study_, consentWanted, this));
    });
    row->addWidget(enrol);
    row->addStretch();
    all_.push_back(enrol);
    return holder;
}

/// Builds the buttons for the participant selected in the table.
QWidget* StudyList::buildOfOne() {
    auto* holder = new QWidget(this);
    auto* row = rowIn(*holder, 8);
    auto* start = pageButton(tr("Start a session…"), "startSession",
                             tr("Starts a session for the selected participant."), holder);
    start->setIcon(icon("run", Ink::Primary));
    makePrimary(*start);
    connect(start, &QPushButton::clicked, this, [this] {
        say({});
        emit sessionWanted(code_);
    });
    auto* consent =
        pageButton(tr("Consent…"), "consentOne", tr("Notes that the participant signed the form in force."), holder);
    connect(consent, &QPushButton::clicked, this, [this] {
        say({});
        askForConsent(code_);
    });
    auto* more = pageButton(tr("More"), "moreOfOne", tr("Their page, and ways to leave or withdraw."), holder);
    more->setMenu(new QMenu(more));
    addAction(*more, tr("Their page in plain words…"), "pageOfOne", [this] {
        makeReport(tr("The page for %1").arg(code_), "for-participant.pdf", {"--participant", code_});
    });
    addAction(*more, tr("Leaves the study…"), "leaveOne",
              [this] { openDialog(endPartDialog(study_, EndOfPart::Leave, code_, this)); });
    addAction(*more, tr("Withdraws…"), "withdrawOne",
              [this] { openDialog(endPartDialog(study_, EndOfPart::Withdraw, code_, this)); });
    for (auto* each : {start, consent, more}) {
        row->addWidget(each);
        ofOne_.push_back(each);
    }
    row->addStretch();
    return holder;
}

QWidget* StudyList::buildFoot() {
    auto* holder = new QWidget(this);
    auto* about = new QHBoxLayout;
    auto* row = new TurningRow({}, holder);
    row->setContentsMargins(0, 0, 0, 0);
    for (QBoxLayout* each : {static_cast<QBoxLayout*>(about), static_cast<QBoxLayout*>(row)}) each->setSpacing(8);
    auto* found = pageButton(tr("Results"), "studyResultsWanted",
                             tr("Each session with its encoding, which encoding is better, and the figures."), holder);
    connect(found, &QPushButton::clicked, this, [this] {
        say({});
        study_.readResults();
    });
    auto* reports = pageButton(tr("Report"), "reports", tr("As PDF or HTML, outside the study’s folder."), holder);
    auto* out = pageButton(tr("Export…"), "exportStudy",
                           tr("Results without codes and dates, as a BIDS dataset in a new folder."), holder);
    auto* note = pageButton(tr("Note"), "noteOfStudy", tr("What happened, is changed or is reported later."), holder);
    for (auto* each : {reports, out, note}) each->setMenu(new QMenu(each));
    const auto results = tr("For the study: results, with codes…");
    addAction(*reports, results, "studyReport", [=, this] { makeReport(results, "study-report.pdf", {}); });
    const auto committee = tr("For the committee: side effects and events, no codes…");
    addAction(*reports, committee, "committeeReport", [=, this] {
        makeReport(committee, "committee-report.pdf", {"--for", "committee"});
    });
    addAction(*out, tr("Results as BIDS…"), "exportResults", [this] { askForExport({}); });
    addAction(*out, tr("Results as BIDS, with age, sex or handedness…"), "exportWithAbout", [this] {
        openDialog(exportDialog(
            study_, [this](const BidsWith& with) { askForExport(with); }, this));
    });
    const auto noted = [this](QDialog* asks) {
        const auto what = asks->windowTitle();
        connect(asks, &QDialog::accepted, this, [this, what] { say(tr("Noted: %1.").arg(what), false); });
        return asks;
    };
    addAction(*note, tr("An amendment of the committee…"), "amendStudy",
              [=, this] { openDialog(noted(amendDialog(study_, this))); });
    addAction(*note, tr("An adverse event…"), "noteAdverseEvent",
              [=, this] { openDialog(noted(adverseEventDialog(study_, code_, this))); });
    addAction(*note, tr("The day after a session…"), "noteNextDay",
              [=, this] { openDialog(noted(nextDayDialog(study_, code_, this))); });
    for (const auto& kind : studyLogKinds()) {
        const auto title = QCoreApplication::translate("StudyLog", kind.title);
        addAction(*note, title + "…", qPrintable("note-" + QString(kind.key)),
                  [=, this, &kind] { openDialog(noted(noteDialog(study_, kind, this))); });
    }
    release_ = addAction(*note, tr("Release after a serious event…"), "releaseStudy",
                         [this] { openDialog(releaseDialog(study_, this)); });
    passphrase_ = addAction(*note, tr("Another passphrase…"), "changePassphrase", [this] { changePassphrase(); });
    goBack_ = addAction(*note, tr("Go back to this older ledger…"), "goBackInStudy",
                        [this] { openDialog(goBackDialog(study_, this)); });
    auto* close = pageButton(tr("Close the study"), "closeStudy",
                             tr("Forgets its passphrase. Another program can change it then."), holder);
    connect(close, &QPushButton::clicked, this, [this] { study_.close(); });
    for (auto* each : {found, note, reports, out}) about->addWidget(each);
    about->addStretch();
    row->addLayout(about, 1);
    row->addWidget(close);
    for (auto* each : {found, note, reports, out, close}) all_.push_back(each);
    return holder;
}

QString StudyList::chosen() const { return code_; }

void StudyList::say(const QString& what, bool trouble) {
    trouble_->setText(what.isEmpty() || !trouble ? what : "⚠ " + what);
    setTone(*trouble_, trouble ? Tone::Warning : Tone::Text);
    trouble_->setVisible(!what.isEmpty());
}

/// Shown apart from what say() says, so that no other message takes its place.
void StudyList::showHold(const Study& study) {
    const auto approved = study.stillApproved();
    auto words = approved ? QString() : tr("⚠ No session can begin: %1").arg(sentence(approved.error()));
    for (const auto* way : {release_, goBack_})
        if (!approved && way->isVisible()) words += ' ' + tr("Here that is “%1” under “Note”.").arg(way->text());
    hold_->setText(words);
    hold_->setVisible(!words.isEmpty());
}

void StudyList::refresh() {
    const auto* study = study_.study();
    if (study != nullptr) showTables(*study);
    judge();
}

void StudyList::showTables(const Study& study) {
    const auto& settings = study.settings();
    title_->setText(qtext(settings.title));
    const auto& approval = settings.approval;
    facts_->setText(study.isRehearsal()
                        ? tr("A rehearsal: nothing of it is sealed, and only simulated devices are used.")
                        : tr("Approval %1, %2 to %3 · consent form %4 · %5 of %6 participants enrolled")
                              .arg(qtext(approval.reference), qtext(dateText(approval.from)),
                                   qtext(dateText(approval.expires)), qtext(settings.consentVersion))
                              .arg(study.participants().size())
                              .arg(settings.participantsMax));
    keys_->setText(tr("Keys: %1. Two people should each hold a copy on another medium, apart from the passphrase: the "
                      "investigator, and who answers for the data.")
                       .arg(qtext(study.keyFile().string())));
    keys_->setVisible(!study.isRehearsal());
    passphrase_->setVisible(!study.isRehearsal());
    const auto events = study.adverseEvents();
    release_->setVisible(events && std::ranges::any_of(*events, [](const auto& each) {
                             return each.second.serious && each.second.releasedBy.empty();
                         }));
    goBack_->setVisible(study.lossOfGoingBack().has_value());
    showHold(study);
    const auto people = participantRows(study);
    {
        const QSignalBlocker asOne(participants_);  // the buttons for one participant keep the focus
        participants_->show({{"Code", "code"},
                             {"Who", "who"},
                             {"Group", "group"},
                             {"State", "state"},
                             {"Sessions", "sessions", ResultColumn::As::Number},
                             {"Consent", "consent"}},
                            people);
        participants_->clearSelection();
        choose(code_);
        if (participants_->chosenRow() < 0 && participants_->rowCount() > 0)
            participants_->selectRow(participants_->rowCount() - 1);
    }
    code_ = chosenIn(*participants_);
    const auto gone = std::ranges::count(study.participants(), ParticipantState::Withdrawn, &Participant::state);
    withdrawn_->setText(people.empty() && gone == 0 ? tr("No participant is enrolled. Enrol one first.")
                        : gone == 0                 ? QString()
                        : gone == 1                 ? tr("One more has withdrawn.")
                                                    : tr("%1 more have withdrawn.").arg(gone));
    withdrawn_->setVisible(!withdrawn_->text().isEmpty());
    participants_->setVisible(!people.empty());
    ofOneRow_->setVisible(!people.empty());
    sessions_->show(study);
}

void StudyList::judge() {
    const auto* study = study_.study();
    const bool there = study != nullptr;
    // A button that is disabled for a while loses the focus, perhaps to STOP.
    auto* focus = QApplication::focusWidget();
    const bool ours = focus != nullptr && (isAncestorOf(focus) || foot_->isAncestorOf(focus));
    if (!there && ours && focus_ == nullptr) focus_ = focus;
    for (auto* each : all_) each->setEnabled(there);
    for (auto* each : ofOne_) each->setEnabled(there && !code_.isEmpty());
    sessions_->setReadable(there);
    if (there && focus_ != nullptr) std::exchange(focus_, nullptr)->setFocus();
}

/// Returns the record in which a signature of the report is noted: of the last session that it tells of and whose
/// record is closed. `code`: the participant whom it is about; empty for the whole study.
QString StudyList::signedIn(const QString& code) const {
    const auto* study = study_.study();
    auto sessions = study == nullptr ? std::vector<StudySession>() : study->sessions();
    for (const auto& each : sessions | std::views::reverse) {
        const bool told = code.isEmpty() || qtext(each.code) == code;
        if (!told || !each.opened || each.state == StudySessionState::Unfinished) continue;
        const auto path = study->pathOf(each.parts.back().file);
        if (const auto record = SessionReader::open(path); record && record->closed()) return qtext(path.string());
    }
    return {};
}

void StudyList::makeReport(const QString& title, const QString& name, const QStringList& more) {
    FileQuestion question{.title = title,
                          .wants = FileQuestion::Wants::NewFile,
                          .filters = {tr("Reports (*.pdf *.html)")},
                          .folder = QFileInfo(study_.folder()).absolutePath(),
                          .name = name,
                          .suffix = "pdf"};
    askForFile(*this, question, [this, more](const QString& out) {
        if (!noteReport(out, more)) return;
        say(tr("The report is being drawn…"), false);
        const auto one = more.indexOf("--participant");
        reports_.make(ReportMaker::Order{.record = study_.folder(),
                                         .out = out,
                                         .more = more + QStringList{"--noted"},
                                         .passphrase = study_.passphrase(),
                                         .assurance = more.contains("committee")
                                                          ? tr("The study is unchanged.")
                                                          : tr("The study notes that this report was asked for."),
                                         .signs = signedIn(one < 0 ? QString() : more[one + 1])});
    });
}

/// Records in the study that a report will be written, if it names people; the committee's report does not.
bool StudyList::noteReport(const QString& out, const QStringList& more) {
    if (more.contains("committee")) return true;
    auto* study = study_.study();
    if (study == nullptr) {
        say(tr("The study is not open any more. No report was made."));
        return false;
    }
    const auto noted = study->exported(QFileInfo(out).absoluteFilePath().toStdString(),
                                       more.contains("--participant") ? "participant report" : "study report");
    if (!noted) say(sentence(noted.error()));
    return noted.has_value();
}

void StudyList::changePassphrase() {
    auto* asks = new PassphraseDialog(PassphraseDialog::Purpose::Change, title_->text(), this);
    connect(asks, &PassphraseDialog::given, this, [this, asks] {
        const auto held = study_.passphrase();
        if (held && asks->knows(*held)) return study_.changePassphrase(asks->passphrase());
        asks->refuse(tr("The passphrase so far is another. Nothing was changed."));
    });
    connect(&study_, &OpenStudy::passphraseChanged, asks, [this, asks] {
        asks->accept();
        say(tr("The passphrase was changed. Copies of the key file still open with the earlier one: replace them."),
            false);
    });
    connect(&study_, &OpenStudy::refused, asks, &PassphraseDialog::refuse);
    openDialog(asks);
}

void StudyList::askForExport(const BidsWith& with) {
    FileQuestion question{.title = tr("A new or empty folder for the results, outside the study"),
                          .wants = FileQuestion::Wants::NewFolder,
                          .folder = QFileInfo(study_.folder()).absolutePath(),
                          .name = QFileInfo(study_.folder()).fileName() + "-bids"};
    askForFile(*this, question, [this, with](const QString& place) {
        say(tr("The results are being written…"), false);
        study_.exportBids(place, with);
    });
}

namespace {

using nlohmann::json;

QString stateWords(StudySessionState state) {
    switch (state) {
        case StudySessionState::Unfinished:
            return QObject::tr("interrupted, can continue");
        case StudySessionState::Complete:
            return QObject::tr("complete");
        case StudySessionState::Stopped:
            break;
    }
    return QObject::tr("ended before its end");
}

QString protocolWords(const std::string& protocol) {
    switch (resultTraits(protocol).kind) {
        case ResultKind::PilotIdentification:
            return QObject::tr("identification");
        case ResultKind::PilotThresholds:
            return QObject::tr("thresholds");
        default:
            return qtext(protocol);
    }
}

std::string localText(std::chrono::sys_seconds at) {
    return QDateTime::fromSecsSinceEpoch(at.time_since_epoch().count()).toString("yyyy-MM-dd HH:mm").toStdString();
}

/// Returns the rows: {code, number, protocol, encoding, state, answered, begun}.
json sessionRows(const std::vector<StudySession>& sessions) {
    auto rows = json::array();
    for (const auto& one : sessions)
        rows.push_back({{"code", one.code.empty() ? json() : json(namedWith(one.basis, one.code))},
                        {"number", one.number},
                        {"protocol", protocolWords(one.protocol).toStdString()},
                        {"encoding", one.encoding.empty() ? json() : json(one.encoding)},
                        {"state", stateWords(one.state).toStdString()},
                        {"answered", one.answered},
                        {"begun", localText(one.parts.front().begun)}});
    return rows;
}

}  // namespace

StudySessions::StudySessions(QWidget& page)
    : QWidget(&page), table_(new PageTable("studySessions", tr("Sessions"), page, kListPad, true)) {
    auto* column = columnIn(*this, 8);
    column->addWidget(strongLabel(tr("Sessions"), this));
    column->addWidget(table_);
    result_ = pageButton(tr("Show result"), "showResult", {}, this);
    column->addWidget(result_, 0, Qt::AlignLeft);
    connect(result_, &QPushButton::clicked, this, [this] {
        if (const auto* one = chosen()) emit resultWanted(qtext(one->id));
    });
    connect(table_, &QTableWidget::cellActivated, result_, [this] { result_->click(); });
    connect(table_, &QTableWidget::itemSelectionChanged, this, [this] {
        const int row = table_->chosenRow();
        id_ = row < 0 ? std::string() : sessions_.at(std::size_t(row)).id;
        judge();
    });
    judge();
}

void StudySessions::show(const Study& study) {
    sessions_ = study.sessions();
    const auto known = std::ranges::find(sessions_, std::exchange(id_, {}), &StudySession::id);
    table_->show({{"Participant", "code"},
                  {"Session", "number", ResultColumn::As::Number},
                  {"Begun", "begun"},
                  {"Protocol", "protocol"},
                  {"Answers", "answered", ResultColumn::As::Number},
                  {"State", "state"},
                  {"Encoding", "encoding"}},
                 sessionRows(sessions_));
    if (!sessions_.empty())
        table_->selectRow(known == sessions_.end() ? table_->rowCount() - 1 : int(known - sessions_.begin()));
    setVisible(!sessions_.empty());
    judge();
}

void StudySessions::setReadable(bool readable) {
    readable_ = readable;
    judge();
}

const StudySession* StudySessions::chosen() const {
    const auto found = std::ranges::find(sessions_, id_, &StudySession::id);
    return found == sessions_.end() ? nullptr : &*found;
}

void StudySessions::judge() {
    const auto* one = chosen();
    const bool ended = one != nullptr && one->state != StudySessionState::Unfinished;
    result_->setEnabled(readable_ && ended);
    result_->setToolTip(ended ? tr("What the selected session came to, read from its record.")
                              : tr("Select a session that has ended: only those have a result."));
}

}  // namespace tacto::gui

#include "moc_StudyList.cpp"
