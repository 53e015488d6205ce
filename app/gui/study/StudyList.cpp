#include "app/gui/study/StudyList.h"

#include <QFileInfo>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QMenu>

#include "app/gui/runner/ReportWindow.h"
#include "app/gui/study/AdverseEventDialog.h"
#include "app/gui/study/AmendDialog.h"
#include "app/gui/study/ConsentDialog.h"
#include "app/gui/study/EndPartDialog.h"
#include "app/gui/study/EnrolDialog.h"
#include "app/gui/study/GoBackDialog.h"
#include "app/gui/study/NextDayDialog.h"
#include "app/gui/study/StudySessions.h"
#include "app/gui/theme/Dialogs.h"
#include "app/gui/theme/Icons.h"
#include "app/gui/theme/Pages.h"
#include "app/gui/theme/RecordColumns.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"
#include "app/gui/theme/ToolRow.h"
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
      title_(new QLabel(this)),
      facts_(new QLabel(this)),
      trouble_(new QLabel(this)),
      tables_(new QVBoxLayout),
      withdrawn_(new QLabel(this)),
      sessions_(new StudySessions(this)) {
    setObjectName("studyList");
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(kListPad, kListPad, kListPad, kListPad);
    column->setSpacing(8);
    title_->setObjectName("studyTitle");
    setTextSize(*title_, TextSize::Large);
    facts_->setObjectName("studyFacts");
    setTone(*facts_, Tone::Quiet);
    trouble_->setObjectName("studyTrouble");
    setTone(*withdrawn_, Tone::Quiet);
    for (auto* label : {title_, facts_, trouble_, withdrawn_}) {
        label->setWordWrap(true);
        label->setTextFormat(Qt::PlainText);
    }
    column->addWidget(title_);
    column->addWidget(facts_);
    column->addWidget(trouble_);
    trouble_->hide();
    column->addSpacing(8);
    column->addWidget(buildParticipants());
    tables_->setSpacing(8);
    ofOneRow_ = buildOfOne();
    column->addLayout(tables_);
    column->addStretch();
    column->addWidget(buildFoot());
    connect(&study_, &OpenStudy::changed, this, &StudyList::refresh);
    connect(sessions_, &StudySessions::resultWanted, this, [this](const QString& id) {
        say({});
        study_.readResult(id);
    });
    connect(&study_, &OpenStudy::exported, this,
            [this](const QString& place) { say(tr("The results lie in %1.").arg(place), false); });
    connect(&reports_, &ReportMaker::done, this, [this](const QString& out) {
        say(tr("The report is %1.").arg(out), false);
        if (out.endsWith(".pdf", Qt::CaseInsensitive)) ReportWindow::showReport(*this, out);
    });
    connect(&reports_, &ReportMaker::failed, this, [this](const QString& why) { say(why); });
    afterLookChange(*this, [this] { layOut(); });
    refresh();
}

QPushButton* StudyList::button(const QString& text, const QString& tip, const char* name, QWidget* parent) {
    auto* made = new QPushButton(text, parent);
    made->setToolTip(tip);
    made->setObjectName(name);
    made->setAutoDefault(false);
    return made;
}

void StudyList::choose(const QString& code) {
    for (int row = 0; row < participants_->rowCount(); ++row) {
        if (participants_->item(row, 0)->text() == code) participants_->selectRow(row);
    }
}

void StudyList::askForConsent(const QString& code) { openDialog(new ConsentDialog(study_, code, this)); }

QWidget* StudyList::buildParticipants() {
    auto* holder = new QWidget(this);
    auto* row = new QHBoxLayout(holder);
    row->setContentsMargins(0, 0, 0, 0);
    auto* title = new QLabel(tr("Participants"), holder);
    setTextSize(*title, TextSize::Body, true);
    row->addWidget(title);
    row->addStretch();
    auto* enrol = button(tr("Enrol…"), tr("A new participant, who is given a code."), "enrol", holder);
    connect(enrol, &QPushButton::clicked, this, [this] {
        say({});
        auto* asks = new EnrolDialog(study_, this);
        connect(asks, &EnrolDialog::consentWanted, this, [this](const QString& code) {
            choose(code);
            askForConsent(code);
        });
        openDialog(asks);
    });
    row->addWidget(enrol);
    all_.push_back(enrol);
    return holder;
}

/// What can be done with the participant who is chosen in the table.
QWidget* StudyList::buildOfOne() {
    auto* holder = new QWidget(this);
    auto* row = new QHBoxLayout(holder);
    row->setContentsMargins(0, 0, 0, 0);
    row->setSpacing(8);
    auto* start =
        button(tr("Start a session…"), tr("Starts a session for the selected participant."), "startSession", holder);
    start->setIcon(icon("run", Ink::Primary));
    makePrimary(*start);
    connect(start, &QPushButton::clicked, this, [this] {
        say({});
        emit sessionWanted(code_);
    });
    auto* consent =
        button(tr("Consent…"), tr("Notes that the participant signed the form in force."), "consentOne", holder);
    connect(consent, &QPushButton::clicked, this, [this] {
        say({});
        askForConsent(code_);
    });
    auto* more = button(tr("More"), tr("Their page, leaving, withdrawing."), "moreOfOne", holder);
    auto* menu = new QMenu(more);
    const auto add = [&](const QString& text, const char* name, auto open) {
        auto* action = menu->addAction(text);
        action->setObjectName(name);
        connect(action, &QAction::triggered, this, [this, open] {
            say({});
            open();
        });
    };
    add(tr("Their page in plain words…"), "pageOfOne", [this] {
        makeReport(tr("The page for %1").arg(code_), "for-participant.pdf", {"--participant", code_});
    });
    add(tr("Leaves the study…"), "leaveOne",
        [this] { openDialog(new EndPartDialog(study_, EndPartDialog::How::Leave, code_, this)); });
    add(tr("Withdraws…"), "withdrawOne",
        [this] { openDialog(new EndPartDialog(study_, EndPartDialog::How::Withdraw, code_, this)); });
    more->setMenu(menu);
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
    auto* reports = button(tr("Report"), tr("As PDF or HTML, outside the study’s folder."), "reports", holder);
    auto* menu = new QMenu(reports);
    const auto addReport = [&](const QString& text, const char* name, const QString& file, const QStringList& more) {
        auto* action = menu->addAction(text);
        action->setObjectName(name);
        connect(action, &QAction::triggered, this, [this, text, file, more] { makeReport(text, file, more); });
    };
    addReport(tr("For the study: results, with codes…"), "studyReport", "study-report.pdf", {});
    addReport(tr("For the committee: side effects and events, no codes…"), "committeeReport", "committee-report.pdf",
              {"--for", "committee"});
    reports->setMenu(menu);
    auto* out = button(tr("Export…"), tr("Results without codes and dates, as a BIDS dataset in a new folder."),
                       "exportStudy", holder);
    auto* exports = new QMenu(out);
    const auto addExport = [&](const QString& text, const char* name, const BidsWith& with) {
        auto* action = exports->addAction(text);
        action->setObjectName(name);
        connect(action, &QAction::triggered, this, [this, with] { askForExport(with); });
    };
    addExport(tr("Results as BIDS…"), "exportResults", {});
    addExport(tr("Results as BIDS, with age, sex and handedness…"), "exportWithAbout",
              {.age = true, .sex = true, .handedness = true});
    out->setMenu(exports);
    auto* note = button(tr("Note"), tr("What happened, is changed or is reported later."), "noteOfStudy", holder);
    auto* notes = new QMenu(note);
    const auto addNote = [&](const QString& text, const char* name, auto dialog) {
        auto* action = notes->addAction(text);
        action->setObjectName(name);
        connect(action, &QAction::triggered, this, [this, dialog] {
            say({});
            openDialog(dialog());
        });
        return action;
    };
    addNote(tr("An amendment of the committee…"), "amendStudy", [this] { return new AmendDialog(study_, this); });
    addNote(tr("An adverse event…"), "noteAdverseEvent",
            [this] { return new AdverseEventDialog(study_, code_, this); });
    addNote(tr("The day after a session…"), "noteNextDay", [this] { return new NextDayDialog(study_, code_, this); });
    goBack_ = addNote(tr("Go back to this older ledger…"), "goBackInStudy",
                      [this] { return new GoBackDialog(study_, this); });
    note->setMenu(notes);
    auto* close = button(tr("Close the study"), tr("Forgets its passphrase. Another program can change it then."),
                         "closeStudy", holder);
    connect(close, &QPushButton::clicked, this, [this] { study_.close(); });
    for (auto* each : {note, reports, out}) about->addWidget(each);
    about->addStretch();
    row->addLayout(about, 1);
    row->addWidget(close);
    for (auto* each : {note, reports, out, close}) all_.push_back(each);
    return holder;
}

QString StudyList::chosen() const { return code_; }

void StudyList::say(const QString& what, bool trouble) {
    trouble_->setText(what.isEmpty() || !trouble ? what : "⚠ " + what);
    setTone(*trouble_, trouble ? Tone::Warning : Tone::Text);
    trouble_->setVisible(!what.isEmpty());
}

void StudyList::sayWhatHinders() {
    const auto* study = study_.study();
    const auto approved = study == nullptr ? Result<void>() : study->stillApproved();
    auto words = approved ? QString() : tr("No session can begin: %1").arg(sentence(approved.error()));
    if (goBack_->isVisible()) words += ' ' + tr("Here that is “%1” under “Note”.").arg(goBack_->text());
    say(words);
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
    goBack_->setVisible(study.lossOfGoingBack().has_value());
    if (!study.stillApproved()) sayWhatHinders();
    delete std::exchange(participants_, nullptr);
    const auto people = participantRows(study);
    participants_ = makeRecordTable({{"Code", "code"},
                                     {"Who", "who"},
                                     {"Group", "group"},
                                     {"State", "state"},
                                     {"Sessions", "sessions", ResultColumn::As::Number},
                                     {"Consent", "consent"}},
                                    people, this);
    participants_->setObjectName("participants");
    participants_->setAccessibleName(tr("Participants"));
    participants_->setSelectionBehavior(QAbstractItemView::SelectRows);
    participants_->setFocusPolicy(Qt::StrongFocus);
    connect(participants_, &QTableWidget::itemSelectionChanged, this, [this] {
        const auto rows = participants_->selectionModel()->selectedRows();
        code_ = rows.isEmpty() ? QString() : participants_->item(rows.front().row(), 0)->text();
        judge();
    });
    layOut();
    choose(std::exchange(code_, QString()));
    if (code_.isEmpty() && participants_->rowCount() > 0) participants_->selectRow(participants_->rowCount() - 1);
    const auto gone = std::ranges::count(study.participants(), ParticipantState::Withdrawn, &Participant::state);
    withdrawn_->setText(people.empty() && gone == 0 ? tr("No participant is enrolled. Enrol one first.")
                        : gone == 0                 ? QString()
                        : gone == 1                 ? tr("One more has withdrawn.")
                                                    : tr("%1 more have withdrawn.").arg(gone));
    withdrawn_->setVisible(!withdrawn_->text().isEmpty());
    tables_->addWidget(participants_);
    tables_->addWidget(withdrawn_);
    tables_->addWidget(ofOneRow_);
    tables_->addWidget(sessions_);
    participants_->setVisible(!people.empty());
    ofOneRow_->setVisible(!people.empty());
    sessions_->show(study);
    layOut();
}

/// In the style and size of text that they have where they stand.
void StudyList::layOut() {
    const int room = std::max(1, widthInSight(*this) - 2 * (kListPad + 1));
    sessions_->layOut(room);
    if (participants_ == nullptr) return;
    participants_->ensurePolished();
    participants_->horizontalHeader()->ensurePolished();
    layOutRecordTable(*participants_, room);
    participants_->setSelectionMode(QAbstractItemView::SingleSelection);
}

void StudyList::resizeEvent(QResizeEvent* event) {
    QWidget::resizeEvent(event);
    if (event->size().width() != event->oldSize().width()) layOut();
}

void StudyList::judge() {
    const auto* study = study_.study();
    const bool there = study != nullptr;
    for (auto* each : all_) each->setEnabled(there);
    for (auto* each : ofOne_) each->setEnabled(there && !code_.isEmpty());
    sessions_->setReadable(there);
}

void StudyList::makeReport(const QString& title, const QString& name, const QStringList& more) {
    FileQuestion question;
    question.title = title;
    question.wants = FileQuestion::Wants::NewFile;
    question.filters = {tr("Reports (*.pdf *.html)")};
    question.folder = QFileInfo(study_.folder()).absolutePath();
    question.name = name;
    question.suffix = "pdf";
    askForFile(*this, question, [this, more](const QString& out) {
        if (!noteReport(out, more)) return;
        say(tr("The report is being drawn…"), false);
        reports_.make(ReportMaker::Order{.record = study_.folder(),
                                         .out = out,
                                         .more = more + QStringList{"--noted"},
                                         .passphrase = study_.passphrase(),
                                         .assurance = more.contains("committee")
                                                          ? tr("The study is unchanged.")
                                                          : tr("The study notes that this report was asked for.")});
    });
}

/// One that names people is noted before it is written; the committee's names none.
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

void StudyList::askForExport(const BidsWith& with) {
    FileQuestion question;
    question.title = tr("A new or empty folder for the results, outside the study");
    question.wants = FileQuestion::Wants::NewFolder;
    question.folder = QFileInfo(study_.folder()).absolutePath();
    askForFile(*this, question, [this, with](const QString& place) {
        say(tr("The results are being written…"), false);
        study_.exportBids(place, with);
    });
}

}  // namespace tacto::gui

#include "moc_StudyList.cpp"
