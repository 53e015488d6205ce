#include "app/gui/pilot/PilotWorkspace.h"

#include "app/gui/pilot/OperatorPage.h"
#include "app/gui/pilot/PilotResult.h"
#include "app/gui/pilot/RehearsalPage.h"
#include "app/gui/pilot/SessionPath.h"
#include "app/gui/pilot/SessionSide.h"
#include "app/gui/pilot/SessionStartPage.h"
#include "app/gui/pilot/UnfinishedOffer.h"
#include "app/gui/runner/ReportView.h"
#include "app/gui/study/StudyList.h"
#include "app/gui/study/StudyPage.h"
#include "app/gui/theme/Building.h"
#include "app/gui/theme/Dialogs.h"
#include "app/gui/theme/Pages.h"
#include "app/gui/theme/RecordColumns.h"
#include "app/gui/theme/TabbedPage.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"
#include "core/kinds/ResultKinds.h"

namespace tacto::gui {

namespace {

enum HomeTab { kRehearsalTab, kStudyTab };

QString kindOf(const PilotStart& start, bool ofStudy) {
    if (!start.rehearsal) return start.simulated() ? QObject::tr("Study, simulated bench") : QObject::tr("Study");
    if (!start.person) return QObject::tr("Rehearsal, virtual participant");
    return ofStudy ? QObject::tr("Rehearsal with a person") : QObject::tr("Rehearsal: you answer yourself");
}

}  // namespace

PilotWorkspace::PilotWorkspace(BenchController& controller, QWidget* parent)
    : QWidget(parent),
      path_(new SessionPath(this)),
      pages_(new PageStack(this)),
      start_(new SessionStartPage(controller.watch(), pages_)),
      page_(new OperatorPage(pages_)),
      result_(new PilotResult(pages_)),
      side_(new SessionSide(this)),
      session_(std::make_unique<SessionConduct>(controller, *page_, this)) {
    setObjectName("pilotWorkspace");
    study_.setProfile([&controller] { return controller.profile(); });
    auto* row = rowIn(*this, 0);
    const auto edge = [this, row] {
        auto* line = new QFrame(this);
        line->setFrameShape(QFrame::VLine);
        line->setForegroundRole(QPalette::Mid);
        row->addWidget(line);
        return line;
    };
    row->addWidget(path_);
    pathEdge_ = edge();
    for (auto* page :
         {buildHome(), static_cast<QWidget*>(start_), static_cast<QWidget*>(page_), static_cast<QWidget*>(result_)})
        pages_->addWidget(page);
    row->addWidget(pages_, 1);
    sideEdge_ = edge();
    row->addWidget(side_);
    connectSession();
    connectResult();
    connect(start_, &SessionStartPage::beginWanted, this, &PilotWorkspace::beginOfStudy);
    for (const auto leaves : {&SessionStartPage::backWanted, &SessionStartPage::endDayWanted})
        connect(start_, leaves, this, &PilotWorkspace::leaveStart);
    showPage(kHome);
    afterLookChange(*this, [this] { showBeside(Page(pages_->currentIndex())); });
    onEvent(*this, QEvent::Resize, [this] { showBeside(Page(pages_->currentIndex())); });
}

PilotWorkspace::~PilotWorkspace() = default;

void PilotWorkspace::setButtonDevices(const std::shared_ptr<const ButtonDevices>& devices) {
    rehearsal_->setButtonDevices(devices);
    start_->setButtonDevices(devices);
}

QWidget* PilotWorkspace::buildHome() {
    home_ = new TabbedPage(pages_);
    rehearsal_ = new RehearsalPage(home_->room());
    studies_ = new StudyPage(study_, home_->room());
    home_->addTab(rehearsal_, tr("Rehearsal"));
    home_->addTab(studies_, tr("Study"));
    connect(rehearsal_, &RehearsalPage::beginWanted, this, [this] { beginRehearsal(false); });
    connect(studies_, &StudyPage::sessionWanted, this, &PilotWorkspace::prepareStart);
    connect(&study_, &OpenStudy::resultRead, this, [this](const RunResult& result) { showRecorded(result, true); });
    connect(&study_, &OpenStudy::changed, this, &PilotWorkspace::offerToGoOn);
    connect(rehearsal_, &RehearsalPage::resultWanted, this, [this](const QString& session) {
        wanted_ = session;
        rehearsed_.open(rehearsal_->folder(), nullptr);
    });
    connect(&rehearsed_, &OpenStudy::opened, this, [this] {
        exportTo_.isEmpty() ? rehearsed_.readResult(wanted_) : rehearsed_.exportBids(std::exchange(exportTo_, {}));
    });
    connect(&rehearsed_, &OpenStudy::exported, this, [this](const QString& place) {
        result_->say(tr("The results lie in %1.").arg(place));
        rehearsed_.close();
    });
    connect(&rehearsed_, &OpenStudy::resultRead, this, [this](const RunResult& result) {
        showRecorded(result, false);
        rehearsed_.close();
    });
    connect(&rehearsed_, &OpenStudy::refused, this, [this](const QString& why) {
        pages_->currentIndex() == kOutcome ? result_->say("⚠ " + why) : rehearsal_->say(why);
        exportTo_.clear();
        rehearsed_.close();
    });
    return home_;
}

void PilotWorkspace::connectSession() {
    auto* session = session_.get();
    connect(session, &SessionConduct::begun, this, [this, session] {
        const auto& start = session->start();
        path_->setTitle(tr("Session: %1").arg(start.who), kindOf(start, ofStudy_));
        const bool tests = resultTraits(start.protocol).kind != ResultKind::PilotThresholds;
        path_->begin(tests ? start.blocks.value_or(start.studyBlocks) : 0, start.person, start.massager);
        showPage(kSession);
    });
    connect(session, &SessionConduct::screenChanged, this, [this, session](const PilotScreen& screen) {
        path_->show(screen);
        side_->show(*session);
    });
    connect(session, &SessionConduct::asked, this, [this, session](const PilotPrompt& prompt) {
        path_->asked(prompt);
        side_->show(*session);
    });
    connect(session, &SessionConduct::changed, this, [this, session] { side_->show(*session); });
    connect(session, &SessionConduct::counted, path_, &SessionPath::count);
    connect(session, &SessionConduct::refused, this, &PilotWorkspace::sayWhereItBegan);
    connect(session, &SessionConduct::ended, this, [this, session](const std::shared_ptr<const FinishedRun>& run) {
        const auto& outcome = run->result.outcome;
        reopened_ = false;
        recorded_ = qtext(run->result.session.string());
        showPage(kOutcome);
        path_->end(outcome.error.has_value() || run->result.verdict() == "stopped" ? SessionEnd::BrokenOff
                   : memberAt(outcome.results, "range.usable") == false            ? SessionEnd::NoRange
                                                                                   : SessionEnd::Complete);
        shown_ = session->start().folder;
        result_->show(run->result, shown_, ofStudy_);
        if (ofStudy_) return study_.takeBack();  // offerToGoOn() follows
        rehearsal_->look();
        offerToGoOn();
    });
    connect(session, &SessionConduct::attentionWanted, this, &PilotWorkspace::attentionWanted);
    connect(session, &SessionConduct::runningChanged, this, &PilotWorkspace::runningChanged);
}

void PilotWorkspace::connectResult() {
    connect(result_, &PilotResult::anotherWanted, this, [this] {
        if (!ofStudy_) rehearsal_->renew();
        showPage(kHome);
    });
    connect(result_, &PilotResult::backWanted, this, [this] {
        if (!ofStudy_) rehearsal_->look();
        showPage(kHome);
    });
    connect(result_, &PilotResult::goOnWanted, this, &PilotWorkspace::goOn);
    connect(result_, &PilotResult::folderWanted, this, [this](const QString& folder) {
        if (const auto why = openOnDesktop(folder); !why.isEmpty()) result_->say(why);
    });
    connect(result_, &PilotResult::reportWanted, this, &PilotWorkspace::makeReport);
    connect(result_, &PilotResult::exportWanted, this, [this] {
        const QFileInfo folder(shown_);
        const FileQuestion question{.title = tr("A new or empty folder for the results, outside the rehearsal"),
                                    .wants = FileQuestion::Wants::NewFolder,
                                    .folder = folder.absolutePath(),
                                    .name = folder.fileName() + "-bids"};
        askForFile(*this, question, [this, rehearsal = shown_](const QString& place) {
            exportTo_ = place;
            rehearsed_.open(rehearsal, nullptr);
        });
    });
    connect(&reports_, &ReportMaker::failed, result_, &PilotResult::say);
    connect(&reports_, &ReportMaker::done, this, [this](const QString& out, const QString& signs) {
        result_->say(tr("The report is %1.").arg(out));
        ReportWindow::showReport(*this, out, signs);
    });
}

/// A study's report is asked for on its page, which says what it holds; a rehearsal's is drawn beside its folder.
void PilotWorkspace::makeReport() {
    if (ofStudy_) {
        showPage(kHome);
        if (auto* asks = studies_->findChild<QAction*>("studyReport")) asks->trigger();
        return;
    }
    const QFileInfo folder(shown_);
    result_->say(tr("The report is being drawn…"));
    reports_.make(ReportMaker::Order{.record = folder.absoluteFilePath(),
                                     .out = folder.absoluteFilePath() + "-report.pdf",
                                     .assurance = tr("The rehearsal is unchanged."),
                                     .signs = recorded_});
}

/// The session's path is shown with a session and with its result; a study's lists get the full width.
void PilotWorkspace::showPage(Page page) {
    if (page == kHome || page == kStart) {
        path_->clear();
        path_->setTitle(tr("Pilot sessions"), tr("Can a person tell the four conditions apart?"));
    }
    showBeside(page);
    pages_->setCurrentIndex(page);
}

void PilotWorkspace::showBeside(Page page) {
    // If large text leaves little room, the session's own page has priority, then the path, then the side column.
    const auto* shown = pages_->widget(page);
    const int room = (parentWidget() != nullptr ? parentWidget() : this)->width() - shown->minimumSizeHint().width();
    const bool ofASession = page == kSession || (page == kOutcome && !reopened_);
    const bool path = !plotOnly_ && ofASession && room >= path_->maximumWidth();
    const bool side = page == kSession && room >= path_->maximumWidth() + side_->maximumWidth();
    for (auto* left : {static_cast<QWidget*>(path_), static_cast<QWidget*>(pathEdge_)}) left->setVisible(path);
    for (auto* right : {static_cast<QWidget*>(side_), static_cast<QWidget*>(sideEdge_)}) right->setVisible(side);
}

void PilotWorkspace::showPlotOnly(bool only) {
    plotOnly_ = only;
    showBeside(Page(pages_->currentIndex()));
}

void PilotWorkspace::prepareStart(const QString& code) {
    const auto* study = study_.study();
    if (study == nullptr) return;
    const auto who = study->find(code.toStdString());
    if (!who) return studies_->list().say(sentence(who.error()));
    if (const auto refused = start_->prepare(*study, *who); !refused.isEmpty()) {
        showPage(kHome);
        return studies_->list().say(refused);
    }
    lossSaid_ = false;
    showPage(kStart);
}

QString PilotWorkspace::keepExclusions() {
    const auto left = start_->start();
    if (std::ranges::none_of(left.exclusions, &ExclusionAnswer::yes)) return {};
    auto* study = study_.study();
    if (study == nullptr) return tr("The yes is not kept: the study is being opened again. Try once more in a moment.");
    SessionRequest answered;
    answered.code = left.participant;
    answered.exclusions = left.exclusions;
    if (const auto noted = study->noteExclusions(answered); !noted)
        return tr("The yes is not kept: %1").arg(sentence(noted.error()));
    study_.noteChange();
    studies_->list().say(
        tr("%1 answered a question of the checklist with yes, which the study keeps: there is no session today.")
            .arg(qtext(left.participant)));
    return {};
}

bool PilotWorkspace::leaveStart() {
    const auto why = keepExclusions();
    start_->say(why);
    if (why.isEmpty()) showPage(kHome);
    return why.isEmpty();
}

bool PilotWorkspace::mayClose() {
    if (pages_->currentIndex() != kStart || leaveStart() || std::exchange(lossSaid_, true)) return true;
    emit attentionWanted();
    return false;
}

void PilotWorkspace::offerToGoOn() {
    if (reopened_ || running() || pages_->currentIndex() != kOutcome) return;
    if (!ofStudy_) return result_->setMayGoOn(rehearsal_->mayGoOn());
    const auto* study = study_.study();
    if (study == nullptr) return;
    const auto who = study->find(session_->start().participant);
    if (!who) return;
    const auto found = unfinishedOf(*study, *who);
    result_->setMayGoOn(found && *found && (*found)->mayGoOn);
}

/// In a study the checklist is answered again first.
void PilotWorkspace::goOn() {
    if (!ofStudy_) return beginRehearsal(true);
    prepareStart(qtext(session_->start().participant));
    start_->chooseGoOn();
}

void PilotWorkspace::showRecorded(const RunResult& result, bool ofStudy) {
    if (running()) return;  // the page of the running session stays
    ofStudy_ = ofStudy;
    reopened_ = true;
    recorded_ = qtext(result.session.string());
    shown_ = ofStudy ? study_.folder() : rehearsed_.folder();
    result_->show(result, shown_, ofStudy_);
    showPage(kOutcome);
}

void PilotWorkspace::beginRehearsal(bool goOn) {
    ofStudy_ = false;
    auto start = goOn ? session_->start() : rehearsal_->rehearsal();
    if (goOn) {
        start.unfinished = "resume";
        start.blocks.reset();
    }
    if (const auto trouble = session_->begin(start, rehearsal_->screens()); !trouble.isEmpty())
        return sayWhereItBegan(trouble);
    rehearsal_->say({});
}

void PilotWorkspace::beginOfStudy() {
    if (study_.busy()) return start_->say(tr("The study is being opened again. Try once more in a moment."));
    ofStudy_ = true;
    auto start = start_->start();
    start.folder = study_.folder();
    start.passphrase = study_.passphrase();
    start_->say({});
    study_.lend();  // the session opens the study itself
    if (const auto trouble = session_->begin(start, start_->screens()); !trouble.isEmpty()) sayWhereItBegan(trouble);
}

/// Shows why no session began, on the page where it was to begin.
void PilotWorkspace::sayWhereItBegan(const QString& why) {
    if (ofStudy_) {
        study_.takeBack();
        showPage(kStart);
        return start_->say(why);
    }
    showPage(kHome);
    home_->setCurrentIndex(kRehearsalTab);
    rehearsal_->look();
    rehearsal_->say(why);
}

QString PilotWorkspace::stopWords() const {
    const int stops = session_->participantStops();
    return stops == 0 ? tr("Participant’s STOP: not pressed")
                      : tr("Participant’s STOP: pressed %1 of %2").arg(stops).arg(kMaxParticipantStops);
}

}  // namespace tacto::gui

#include "moc_PilotWorkspace.cpp"
