#include "app/gui/window/MainWindow.h"

#include <QApplication>
#include <QCloseEvent>
#include <QDir>
#include <QFileInfo>
#include <QLabel>
#include <QMenuBar>
#include <QMimeData>
#include <QPushButton>
#include <QScreen>
#include <QSettings>
#include <QStatusBar>
#include <QToolBar>
#include <QToolButton>
#include <QWindow>
#include <algorithm>
#include <utility>

#include "app/gui/live/LiveWorkspace.h"
#include "app/gui/pilot/ParticipantWindow.h"
#include "app/gui/pilot/PilotWorkspace.h"
#include "app/gui/runner/SimulatedBenchDialog.h"
#include "app/gui/runner/WiringPanel.h"
#include "app/gui/scope/ScopeFiles.h"
#include "app/gui/scope/ScopeWorkspace.h"
#include "app/gui/scope/measurements/MeasurementSummary.h"
#include "app/gui/theme/Building.h"
#include "app/gui/theme/Dialogs.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Told.h"
#include "app/gui/window/ArmDialog.h"
#include "app/gui/window/Attendance.h"
#include "app/gui/window/CloseQuestion.h"
#include "app/gui/window/DayDialog.h"
#include "app/gui/window/DeviceDock.h"
#include "app/gui/window/DockColumn.h"
#include "app/gui/window/MarkLine.h"
#include "app/gui/window/Menus.h"
#include "app/gui/window/NoticeBanner.h"
#include "app/gui/window/OutputDocks.h"
#include "app/gui/window/RecordingLine.h"
#include "app/gui/window/SafetyBar.h"
#include "app/gui/window/StateWords.h"
#include "app/gui/window/StopButton.h"
#include "app/gui/window/StopKeys.h"
#include "app/gui/window/WelcomeTour.h"
#include "app/gui/window/WorkspaceRail.h"
#include "app/gui/window/Workspaces.h"
#include "app/scripting/engine/ProtocolLibrary.h"
#include "core/bench/Telemetry.h"

namespace tacto::gui {

namespace {

constexpr int kFrame_ms = 33, kBesideBench_ms = 100, kIdle_ms = 1000;
constexpr int kStirred_ms = 700;     // how long every frame is shown after something has happened
constexpr QSize kWanted(1440, 900);  // size of the window on a large enough screen
constexpr int kDocksFrom = 960;      // narrower windows, or windows with large text, start with the docks in a strip
constexpr int kAllDocksFrom = 480;   // in lower windows all docks except the drive's start folded

/// Moves and shrinks the window until it fits on its screen, because STOP is in its corner and the screen may have
/// changed. Ignores maximised windows. The frame is not known before a window is shown, so call this again afterwards.
void keepOnScreen(QWidget& window) {
    if (window.isMaximized() || window.isFullScreen()) return;
    const auto room = window.screen()->availableGeometry();
    const auto frame = window.frameGeometry().size() - window.geometry().size();
    window.resize(window.size().boundedTo(room.size() - frame));
    auto place = window.frameGeometry();
    place.moveRight(std::min(place.right(), room.right()));
    place.moveBottom(std::min(place.bottom(), room.bottom()));
    place.moveLeft(std::max(place.left(), room.left()));
    place.moveTop(std::max(place.top(), room.top()));
    if (place.topLeft() != window.frameGeometry().topLeft()) window.move(place.topLeft());
}

/// Lays out a splitter as at first: each part gets its wanted size, and the stretch factors share the rest.
void layOutAnew(QSplitter& splitter) {
    const bool across = splitter.orientation() == Qt::Horizontal;
    const int count = splitter.count();
    QList<int> sizes, stretches;
    int left = across ? splitter.width() : splitter.height(), shares = 0;
    for (int i = 0; i < count; ++i) {
        const auto* part = splitter.widget(i);
        const auto policy = part->sizePolicy();
        const auto wanted = part->sizeHint().expandedTo(part->minimumSizeHint()).expandedTo(part->minimumSize());
        sizes << std::max(0, across ? wanted.width() : wanted.height());
        stretches << (across ? policy.horizontalStretch() : policy.verticalStretch());
        left -= sizes.back();
        shares += stretches.back();
    }
    for (int i = 0; i < count && left > 0; ++i) sizes[i] += shares > 0 ? left * stretches[i] / shares : left / count;
    splitter.setSizes(sizes);
}

}  // namespace

MainWindow::MainWindow(BenchController::MakeRegistry makeRegistry, std::function<QDate()> today)
    : controller_(std::move(makeRegistry), nullptr, std::move(today)) {
    setWindowTitle(tr("Tactoscope"));
    setAcceptDrops(true);
    setDockOptions(AllowNestedDocks | AllowTabbedDocks);  // not animated: another move would interrupt it
    // Read before any widget exists: a later change of theme restyles each widget, which takes very long.
    const QSettings settings;
    applyTextSize(settings.value("textSize", kUsualText).toInt());
    applyTheme(settings.value("theme").toString() == "dark" ? Theme::Dark : Theme::Light);
    keys_ = new StopKeys(
        [this](const char* by) {
            auto* pilot = workspaces_ == nullptr ? nullptr : workspaces_->pilot();
            const bool theirs = pilot != nullptr && std::string_view(by).starts_with("participant");
            theirs ? static_cast<void>(pilot->stopAsParticipant(by)) : controller_.stop(by);
        },
        this);

    safety_ = new SafetyBar(controller_, calibrations_, this);
    auto* top = new QToolBar(tr("Safety"), this);
    top->setObjectName("safetyToolBar");
    top->setMovable(false);
    top->setFloatable(false);
    top->toggleViewAction()->setEnabled(false);  // the bar cannot be hidden
    top->setContextMenuPolicy(Qt::PreventContextMenu);
    top->addWidget(safety_);
    addToolBar(Qt::TopToolBarArea, top);
    setContextMenuPolicy(Qt::NoContextMenu);
    stop_ = safety_->findChild<QWidget*>("stopButton");
    attendance_ = new Attendance(*this);
    connect(safety_, &SafetyBar::resumed, attendance_, &Attendance::noteHand);
    if (!attendance_->displayTells())
        safety_->addToStopTip(tr(
            "This display does not tell which desktop the window is on, what lies over it, or who holds keyboard and "
            "mouse: keep it in sight while output is on."));

    auto* centre = new QWidget(this);
    centre->setObjectName("centre");
    centre->setAttribute(Qt::WA_StyledBackground);
    auto* layout = columnIn(*centre, 0);
    line_ = new RecordingLine(controller_, *statusBar());
    workspaces_ = new Workspaces(controller_, calibrations_, centre);
    layout->addWidget(workspaces_, 1);
    banner_ = new NoticeBanner(controller_, *line_, *centre);
    setCentralWidget(centre);
    mark_ = new MarkLine(controller_, *line_, *centre, *banner_);
    connect(mark_, &MarkLine::refused, banner_, &NoticeBanner::complain);
    connect(&Told::all(), &Told::said, line_, [this](const QString& what) { line_->say(what); });
    if (const auto resources = resourcesFolder(); !resources) banner_->complain(sentence(resources.error()));
    if (const auto added = addedLimitsText(controller_.limits()); !added.empty()) {
        auto* limits = makeLabel(QString::fromStdString(added), {.name = "added-limits"}, this);
        statusBar()->addPermanentWidget(limits);
    }

    connectWorkspaces();
    rail_ = new WorkspaceRail(this);
    addToolBar(Qt::LeftToolBarArea, rail_);
    connect(rail_, &WorkspaceRail::chosen, this, [this](int index) {
        showWorkspace(index);
        workspaces_->takeFocus();
    });
    buildDocks();
    new Menus(*this, rail_->workspaces(), *docks_, *line_);
    auto* day = new DayButton(controller_.day(), menuBar());
    connect(day, &QToolButton::clicked, this, [this] { askForDay(false); });
    connect(&controller_.day(), &DayNotes::wanted, this, [this] {
        askForDay(true);
        line_->say(DayNotes::wantedText());
    });
    tour_ = new WelcomeTour(*this);
    arming_ = new ArmQuestion(controller_, *this);
    connect(arming_, &ArmQuestion::refused, banner_, &NoticeBanner::complain);
    connect(safety_, &SafetyBar::armRequested, this, &MainWindow::askToArm);
    connect(safety_, &SafetyBar::faultReset, arming_,
            [this](const DriveCommand& drove) { arming_->ask(ArmDialog::Purpose::Arm, drove); });
    connect(safety_, &SafetyBar::detailsRequested, line_, &RecordingLine::showLog);
    connect(&controller_, &BenchController::changed, this, &MainWindow::showTitle);
    closing_ = new CloseQuestion(
        controller_, *this, [this] { return workspaces_->runners(); },
        [this] { return workspaces_->pilot() != nullptr && workspaces_->pilot()->running(); });
    // Before any page is made: a pilot session must still count as running when reopen() looks.
    connect(&controller_, &BenchController::finished, this,
            [this](const std::shared_ptr<const FinishedRun>& run) { reopen(*run); });
    restore();
    connect(&frame_, &QTimer::timeout, this, &MainWindow::tick);
    frame_.setObjectName("frame");
    connect(&controller_, &BenchController::changed, this, &MainWindow::stir);
    connect(&controller_, &BenchController::failed, this, &MainWindow::stir);
    connect(&controller_, &BenchController::changed, this, &MainWindow::followBench);
    qApp->installEventFilter(this);
    stir();
    showTitle();
    onEvent(*this, QEvent::Resize, [this] {
        const bool changed = hasRoomForDocks_ != (width() >= scaledPx(kDocksFrom)) ||
                             hasRoomForAllDocks_ != (height() >= scaledPx(kAllDocksFrom));
        if (docks_ != nullptr && changed) enterDocks();
    });
}

MainWindow::~MainWindow() {
    // Hiding notifies the workspaces, and they use the controller. So hide now: the controller is a member, and gone by
    // the time Qt would hide the window.
    hide();
    qApp->removeEventFilter(this);
}

void MainWindow::connectWorkspaces() {
    connect(workspaces_, &Workspaces::complained, banner_, &NoticeBanner::complain);
    connect(workspaces_, &Workspaces::markWanted, this, &MainWindow::markMoment);
    connect(workspaces_, &Workspaces::plotOnlyWanted, this, [this] { findChild<QAction*>("plotOnly")->trigger(); });
    connect(workspaces_, &Workspaces::simulatedBenchWanted, this, &MainWindow::openSimulatedBench);
    connect(workspaces_, &Workspaces::pilotMade, this,
            [this] { connect(workspaces_->pilot(), &PilotWorkspace::runningChanged, this, &MainWindow::noteBlind); });
}

void MainWindow::buildDocks() {
    drive_ = new DriveDock(controller_, this);
    measurements_ = new FoldingDock(tr("Measurements"), "measurements", "measurementDock", this);
    summary_ = new MeasurementSummary(measurements_);
    auto& scope = workspaces_->scope();
    summary_->follow(scope.readings());
    measurements_->setContent(summary_);
    exposure_ = new ExposureDock(controller_, this);
    devices_ = new DeviceDock(controller_, calibrations_, this);
    docks_ = new DockColumn(*this, {drive_, measurements_, exposure_, devices_});
    connect(workspaces_, &Workspaces::captured, summary_, &MeasurementSummary::measure);
    connect(&scope, &ScopeWorkspace::captureShown, summary_, &MeasurementSummary::take);
    connect(exposure_, &ExposureDock::areaWanted, this,
            [this] { workspaces_->live().editProfile("electrode_area_cm2"); });
    connect(&scope, &ScopeWorkspace::driveWanted, this, [this] {
        docks_->show(*drive_);
        drive_->takeFocus();
    });
    connect(workspaces_, &Workspaces::shown, this, [this] {
        rail_->setCurrent(workspace());
        enterDocks();
    });
    connect(measurements_, &QDockWidget::visibilityChanged, &scope, &ScopeWorkspace::setWatched);
    connect(devices_, &DeviceDock::simulatedBenchRequested, this, &MainWindow::askForSimulatedBench);
    connect(devices_, &DeviceDock::recordingRequested, this, &MainWindow::chooseRecording);
    connect(devices_, &DeviceDock::checkRequested, this, &MainWindow::checkImpedance);
}

/// What a person or the window system does. A tick causes none of these.
bool MainWindow::eventFilter(QObject* /*watched*/, QEvent* event) {
    switch (event->type()) {
        case QEvent::KeyPress:
        case QEvent::MouseButtonPress:
        case QEvent::MouseButtonRelease:
        case QEvent::Wheel:
        case QEvent::TouchBegin:
        case QEvent::TabletPress:
        case QEvent::Drop:
        case QEvent::Close:
        case QEvent::Expose:
        case QEvent::WindowStateChange:
        case QEvent::ApplicationStateChange:
            stir();
            break;
        default:
            break;
    }
    return false;
}

void MainWindow::stir() {
    stirred_.start();
    if (frame_.interval() != kFrame_ms || !frame_.isActive()) frame_.start(kFrame_ms);
}

bool MainWindow::inSight() const {
    return !isMinimized() && (windowHandle() == nullptr || windowHandle()->isExposed());
}

int MainWindow::frameTime_ms(InterlockState state) const {
    const auto activity = controller_.activity();
    const auto* pilot = workspaces_->pilot();
    const bool runs = pilot != nullptr && pilot->running();
    if (runs || !stirred_.hasExpired(kStirred_ms)) return kFrame_ms;
    if (activity == Activity::Closed) return kIdle_ms;
    const bool still = activity == Activity::Live && outputIsOff(state) && state != InterlockState::Faulted;
    return still && !(inSight() && workspace() == Workspaces::kLive) ? kBesideBench_ms : kFrame_ms;
}

void MainWindow::tick() {
    // The window system may add its frame long after the window is shown, without moving it. The frame must fit too.
    if (awaitsFrame_ && frameGeometry() != geometry()) {
        awaitsFrame_ = false;
        keepOnScreen(*this);
    }
    const auto* pilot = workspaces_->pilot();
    const bool blind = pilot != nullptr && pilot->blind();
    const auto seen = controller_.telemetry();
    const auto telemetry = blind ? blinded(seen) : seen;
    safety_->refresh(telemetry);
    attend(seen);
    keys_->stayFirst(controller_.activity() != Activity::Closed);
    if (const int next = frameTime_ms(seen.state); next != frame_.interval()) frame_.start(next);
    showTitle();
    standIn();
    if (smallStop_) smallStop_->showState(safety_->shownState());
    if (smallStop_ && smallStop_->isHidden()) {  // the user closed it by its frame
        smallStop_.reset();
        findChild<QAction*>("smallStopShown")->setChecked(false);
    }
    if (blind) safety_->setParticipantsStop(pilot->stopWords());
    banner_->refresh(telemetry);
    devices_->refresh(telemetry);
    drive_->refresh(telemetry);
    exposure_->refresh(telemetry);
    docks_->refresh();
    line_->refresh();
    const bool measured = measurements_->isVisible();
    workspaces_->refresh(telemetry, measured, inSight());
    if (measured) summary_->refresh(telemetry);
}

void MainWindow::followBench() {
    const auto before = std::exchange(activity_, controller_.activity());
    if (activity_ == before) return;
    if (activity_ == Activity::Closed) reopens_ = false;
    if (activity_ != Activity::Live || std::exchange(reopens_, false)) return;
    const bool hadFocus = workspaces_->isAncestorOf(QApplication::focusWidget());
    showWorkspace(Workspaces::kLive);
    if (hadFocus) workspaces_->takeFocus();  // not into a text field, in which Space would not stop
}

/// After an error or a stop it stays closed until a person opens it, and after a session of a study.
void MainWindow::reopen(const FinishedRun& run) {
    const auto* pilot = workspaces_->pilot();
    if (run.result.outcome.error || run.result.stoppedBySafety || !controller_.closedByRun() ||
        (pilot != nullptr && pilot->running()))
        return;
    QTimer::singleShot(0, this, [this, asked = run.order.asked] {  // first the workspaces show the result
        if (controller_.stoppedSince(asked)) return;               // also by a stop that came while the run closed
        const bool wanted = controller_.closedByRun();
        controller_.openAgain();
        reopens_ = wanted && !controller_.closedByRun();  // nothing opens on a new day without its notes
    });
}

int MainWindow::workspace() const { return workspaces_->currentIndex(); }

void MainWindow::showWorkspace(int index) { workspaces_->showPage(index); }

/// Live work has open docks, with the docks of the present page unfolded; other pages give the room to their plot.
void MainWindow::enterDocks() {
    const int page = workspace();
    const bool live = page == Workspaces::kLive, scope = workspaces_->showsScope();
    const auto name = scope ? QString("oscilloscope") : QString::number(page);
    std::vector<FoldingDock*> folded;
    hasRoomForDocks_ = width() >= scaledPx(kDocksFrom);
    hasRoomForAllDocks_ = height() >= scaledPx(kAllDocksFrom);
    if (!hasRoomForAllDocks_)
        folded = {measurements_, exposure_, devices_};
    else if (live)
        folded.push_back(scope ? static_cast<FoldingDock*>(devices_) : measurements_);
    docks_->enter({page, name, live && hasRoomForDocks_, folded});
}

void MainWindow::showPlotOnly(bool only) {
    rail_->setVisible(!only);
    statusBar()->setVisible(!only);
    menuBar()->setVisible(!only);
    workspaces_->showPlotOnly(only);
    docks_->setHidden(DockColumn::Hidden::PlotOnly, only);
    // The focused widget may now be hidden; another needs the focus, so that Space stops.
    if (only) workspaces_->takeFocus();
}

void MainWindow::resetLayout() {
    docks_->reset();
    enterDocks();
    for (auto* splitter : findChildren<QSplitter*>()) layOutAnew(*splitter);
    workspaces_->scope().resetLayout();
    line_->say(tr("Docks and columns are where they were at first."));
}

/// Puts the file and the state into the title, to be read in the taskbar even if another window covers this one.
void MainWindow::showTitle() {
    const auto open = controller_.open();
    const bool simulated = open && open->simulated();
    const auto state = safety_->shownState();
    QString title = simulated ? tr("Simulated") : QString();
    if (isOn(state) || state == InterlockState::Faulted)
        title = simulated ? tr("%1, simulated").arg(stateStyle(state).word) : stateStyle(state).word;
    if (const QFileInfo file(workspaces_->file()); !file.filePath().isEmpty()) {
        const auto name = file.fileName() == "recording.json" ? file.dir().dirName() : file.fileName();
        title = isOn(state) || state == InterlockState::Faulted ? tr("%1 – %2").arg(title, name) : name;
    }
    // The program's name stands last, because otherwise Qt would append the name.
    const auto whole = title.isEmpty() ? tr("Tactoscope") : tr("%1 – Tactoscope").arg(title);
    if (windowTitle() != whole) setWindowTitle(whole);
}

void MainWindow::showSmallStop(bool shown) {
    standsIn_ = false;
    if (!shown) return smallStop_.reset();
    smallStop_ = std::make_unique<SmallStop>([this] { controller_.stop("operator (STOP)"); }, *this);
    smallStop_->show();
}

/// If another program's window covers STOP, a small STOP appears once. It goes when the large one is free again.
void MainWindow::standIn() {
    const bool covered = attendance_->isCovered();
    if (covered == std::exchange(covered_, covered) || (covered ? smallStop_ != nullptr : !standsIn_)) return;
    showSmallStop(covered);
    standsIn_ = covered;
    findChild<QAction*>("smallStopShown")->setChecked(covered);
    if (covered) line_->say(tr("Another program’s window lies over STOP: a small STOP stands above it."));
}

void MainWindow::askToArm() { arming_->ask(ArmDialog::Purpose::Arm); }

/// Hides levels and trains from lanes, bars and docks while the operator is blind.
void MainWindow::noteBlind() {
    auto* pilot = workspaces_->pilot();
    const bool blind = pilot->blind();
    if (blind) showWorkspace(Workspaces::kPilot);
    rail_->keepTo(blind ? std::optional<int>(Workspaces::kPilot) : std::nullopt,
                  tr("Hidden until the session ends: it would show what is delivered."));
    const bool pauses = pilot->running() && pilot->participantWindow() != nullptr;
    std::optional<PauseInstead> instead;
    if (pauses)
        instead = {[pilot](bool pause) { pilot->pauseSession(pause); }, [pilot] { return pilot->sessionPaused(); }};
    safety_->setPauseInstead(std::move(instead));
    docks_->setHidden(DockColumn::Hidden::Blind, blind);
    safety_->setBlind(blind);
    line_->setBlind(blind);
}

void MainWindow::checkImpedance() { arming_->ask(ArmDialog::Purpose::CheckImpedance); }

void MainWindow::askForSimulatedBench() {
    std::vector<DeviceUri> before;
    if (const auto open = controller_.open()) {
        for (const auto& device : open->about.devices)
            if (auto uri = DeviceUri::parse(device.uri)) before.push_back(std::move(*uri));
    }
    auto* dialog = new SimulatedBenchDialog(tr("&Open"), before, {}, this);
    connect(dialog, &SimulatedBenchDialog::chosen, this, [this](const QString& devices, quint64 seed) {
        LiveOrder order;
        order.uris = devicesOf(devices).value_or(std::vector<DeviceUri>());
        order.profile = controller_.profile();
        order.seed = seed;
        controller_.openLive(order);
    });
    openDialog(dialog);
}

void MainWindow::openSimulatedBench() {
    LiveOrder order;
    order.uris.push_back(*DeviceUri::parse("sim:"));
    order.profile = controller_.profile();
    controller_.openLive(order);
}

void MainWindow::openFile(const QString& path) { workspaces_->openFile(path); }

void MainWindow::chooseFile() {
    FileQuestion question{
        .title = tr("Open"),
        .filters = {tr("Recordings, sessions and captures (*.json *.tacto %1)").arg(ScopeFiles::captureGlobs()),
                    tr("All files (*)")}};
    askForFile(*this, question, [this](const QString& path) { openFile(path); });
}

void MainWindow::chooseRecording() {
    FileQuestion question{.title = tr("Open a recording: its folder"), .wants = FileQuestion::Wants::Folder};
    askForFile(*this, question, [this](const QString& path) { openFile(path); });
}

void MainWindow::closeUnasked() { closing_->closeUnasked(); }

void MainWindow::beginTour() { tour_->begin(); }

void MainWindow::markMoment() { mark_->begin(); }

void MainWindow::askForDay(bool once) {
    if (!once || !controller_.day().asked()) openDialog(new DayDialog(controller_.day(), this));
}

void MainWindow::showDock(const QString& name) {
    for (auto* dock : docks_->docks()) {
        if (dock->objectName() != name) continue;
        docks_->show(*dock);
        resizeDocks({dock}, {std::max(dock->height(), dock->sizeHint().height())}, Qt::Vertical);
    }
}

void MainWindow::setTheme(Theme theme) {
    applyTheme(theme);
    QSettings().setValue("theme", theme == Theme::Dark ? "dark" : "light");
}

void MainWindow::setTextPercent(int percent) {
    QSettings settings;
    const int before = settings.value("textSize", kUsualText).toInt();
    settings.setValue("textSize", percent);
    if (before == kUsualText && percent != before) {
        usual_ = UsualLayout{size(), {}, saveState(), {}};
        for (auto* splitter : findChildren<QSplitter*>()) usual_->columns.emplace_back(splitter, splitter->sizes());
    }
    applyTextSize(percent);
    if (percent != kUsualText)
        return QTimer::singleShot(0, this, [this] {
            if (usual_) usual_->larger = size();
        });
    if (!usual_) return;
    // After the parts are laid out for the text, and have asked for other sizes themselves.
    QTimer::singleShot(0, this, [this, usual = *std::exchange(usual_, std::nullopt)] {
        QTimer::singleShot(0, this, [this, usual] { layOutAsUsual(usual); });
    });
}

void MainWindow::layOutAsUsual(const UsualLayout& usual) {
    if (size() == usual.larger) resize(usual.size);
    restoreState(usual.docks);
    for (const auto& [splitter, sizes] : usual.columns)
        if (splitter) splitter->setSizes(sizes);
    enterDocks();
}

void MainWindow::restore() {
    QSettings settings;
    if (!restoreGeometry(settings.value("geometry").toByteArray())) resize(kWanted);
    keepOnScreen(*this);
    if (!restoreState(settings.value("state").toByteArray())) {
        QTimer::singleShot(0, this, [this] { docks_->reset(); });  // after the window is laid out
    }
    // A window that was closed with only the plot visible starts complete.
    rail_->show();
    statusBar()->show();
    // A damaged saved state must not hide STOP.
    if (auto* top = findChild<QToolBar*>("safetyToolBar")) {
        addToolBar(Qt::TopToolBarArea, top);
        top->show();
    }
    showWorkspace(settings.value("workspace", 0).toInt());
}

void MainWindow::showEvent(QShowEvent* event) {
    QMainWindow::showEvent(event);
    if (event->spontaneous()) return;
    awaitsFrame_ = true;
    QTimer::singleShot(0, this, [this] { keepOnScreen(*this); });
}

void MainWindow::attend(const Telemetry& telemetry) {
    const auto* pilot = workspaces_->pilot();
    const QWidget* theirs = pilot == nullptr ? nullptr : pilot->participantWindow();
    // On a single screen the participant's window covers this window.
    const bool covers = theirs != nullptr && theirs->isVisible() && theirs->screen() == screen();
    const bool on = isOn(telemetry.state);
    const auto* stop = covers ? theirs->findChild<QWidget*>("participantStop") : stop_;
    const auto why = attendance_->absence({covers ? *theirs : *this, *stop, smallStop_.get()}, on);
    if (why.isEmpty() || !on || safety_->held(telemetry.state)) return;
    safety_->holdOutput(true);
    static_cast<void>(controller_.markMoment(telemetry.at, tr("output paused: %1").arg(why)));
    banner_->sayWhile(tr("Output is paused: %1, and STOP was out of reach. It goes on when you press Resume.").arg(why),
                      [this](const Telemetry& now) { return safety_->held(now.state); });
}

void MainWindow::closeEvent(QCloseEvent* event) {
    const bool ran = closing_->runs();
    controller_.stop("the window closes");  // before any question
    if (!closing_->mayClose(ran)) return event->ignore();
    auto* pilot = workspaces_->pilot();
    if (pilot != nullptr && !pilot->mayClose() && !closing_->unasked()) return event->ignore();
    QSettings settings;
    settings.setValue("geometry", saveGeometry());
    settings.setValue("state", saveState());
    settings.setValue("workspace", workspace());
    smallStop_.reset();
    event->accept();
}

void MainWindow::dragEnterEvent(QDragEnterEvent* event) {
    if (event->mimeData()->hasUrls() && event->mimeData()->urls().first().isLocalFile()) event->acceptProposedAction();
}

void MainWindow::dropEvent(QDropEvent* event) {
    for (const auto& url : event->mimeData()->urls()) openFile(url.toLocalFile());
    event->acceptProposedAction();
}

}  // namespace tacto::gui

#include "moc_MainWindow.cpp"
