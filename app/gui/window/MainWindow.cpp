#include "app/gui/window/MainWindow.h"

#include <QApplication>
#include <QCloseEvent>
#include <QFileInfo>
#include <QLabel>
#include <QMenuBar>
#include <QMimeData>
#include <QPushButton>
#include <QSettings>
#include <QSplitter>
#include <QStatusBar>
#include <QToolBar>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "app/gui/calibrate/CalibrateWorkspace.h"
#include "app/gui/live/LiveWorkspace.h"
#include "app/gui/pilot/PilotWorkspace.h"
#include "app/gui/runner/ProtocolWorkspace.h"
#include "app/gui/scope/MeasurementSummary.h"
#include "app/gui/scope/ScopeFiles.h"
#include "app/gui/scope/ScopeWorkspace.h"
#include "app/gui/sessions/SessionsWorkspace.h"
#include "app/gui/theme/Dialogs.h"
#include "app/gui/theme/ScrollingPage.h"
#include "app/gui/theme/TabbedPage.h"
#include "app/gui/window/ArmQuestion.h"
#include "app/gui/window/CloseQuestion.h"
#include "app/gui/window/DayDialog.h"
#include "app/gui/window/DeviceDock.h"
#include "app/gui/window/DockColumn.h"
#include "app/gui/window/DriveDock.h"
#include "app/gui/window/ExposureDock.h"
#include "app/gui/window/MarkLine.h"
#include "app/gui/window/Menus.h"
#include "app/gui/window/NoticeBanner.h"
#include "app/gui/window/RecentFiles.h"
#include "app/gui/window/RecordingLine.h"
#include "app/gui/window/SafetyBar.h"
#include "app/gui/window/SimulatedBenchDialog.h"
#include "app/gui/window/StopKeys.h"
#include "app/gui/window/WelcomeTour.h"
#include "app/gui/window/WindowPlace.h"
#include "app/gui/window/WorkspaceRail.h"
#include "app/run/AllDrivers.h"
#include "app/run/CaptureFormatsList.h"
#include "core/devices/Driver.h"

namespace tacto::gui {

namespace {

constexpr int kFrame_ms = 33;
constexpr QSize kWanted(1440, 900);  // where the screen is large enough
constexpr int kDocksFrom = 960;      // narrower windows, as with large text, begin with the docks in a strip

/// A workspace, made where it stands.
template <typename Workspace, typename... Arguments>
Workspace* makeIn(ScrollingPage& page, Arguments&&... arguments) {
    auto* workspace = new Workspace(std::forward<Arguments>(arguments)..., page.viewport());
    page.hold(workspace);
    return workspace;
}

template <typename Workspace, typename... Arguments>
Workspace* addPage(QStackedWidget& pages, Arguments&&... arguments) {
    auto* page = new ScrollingPage(&pages);
    auto* workspace = makeIn<Workspace>(*page, std::forward<Arguments>(arguments)...);
    pages.addWidget(page);
    return workspace;
}

enum LiveTab { kTouch, kScope };
enum Page { kLive, kCalibrate, kSafetyCheck, kSeparability, kPilot, kSessions, kProtocols };

}  // namespace

MainWindow::MainWindow(BenchController::MakeRegistry makeRegistry, Pages pages, std::function<QDate()> today)
    : controller_(std::move(makeRegistry), nullptr, std::move(today)) {
    setWindowTitle(tr("Tactoscope"));
    setAcceptDrops(true);
    setDockOptions(AllowNestedDocks | AllowTabbedDocks);  // animated, they stop where another move cuts in
    // Before there is a widget: a theme that comes later dresses each of them anew, and takes longer than all the rest.
    const QSettings settings;
    applyTextSize(settings.value("textSize", 100).toInt());
    applyTheme(settings.value("theme").toString() == "dark" ? Theme::Dark : Theme::Light);
    new StopKeys(
        [this](const char* by) {
            const bool theirs = pilot_ != nullptr && std::string_view(by).starts_with("participant");
            theirs ? static_cast<void>(pilot_->stopAsParticipant(by)) : controller_.stop(by);
        },
        this);

    safety_ = new SafetyBar(controller_, calibrations_, this);
    auto* top = new QToolBar(tr("Safety"), this);
    top->setObjectName("safetyToolBar");
    top->setMovable(false);
    top->setFloatable(false);
    top->toggleViewAction()->setEnabled(false);  // always there
    top->setContextMenuPolicy(Qt::PreventContextMenu);
    top->addWidget(safety_);
    addToolBar(Qt::TopToolBarArea, top);
    setContextMenuPolicy(Qt::NoContextMenu);

    auto* centre = new QWidget(this);
    centre->setObjectName("centre");
    centre->setAttribute(Qt::WA_StyledBackground);
    auto* layout = new QVBoxLayout(centre);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    line_ = new RecordingLine(controller_, *statusBar());
    banner_ = new NoticeBanner(controller_, *line_, centre);
    layout->addWidget(banner_);
    pages_ = new QStackedWidget(centre);
    layout->addWidget(pages_, 1);
    setCentralWidget(centre);
    mark_ = new MarkLine(controller_, *line_, *centre);
    connect(mark_, &MarkLine::refused, banner_, &NoticeBanner::complain);
    if (const auto resources = resourcesFolder(); !resources) banner_->complain(sentence(resources.error()));
    if (const auto added = addedLimitsText(controller_.limits()); !added.empty()) {
        auto* limits = new QLabel(QString::fromStdString(added), this);
        limits->setObjectName("added-limits");
        statusBar()->addPermanentWidget(limits);
    }

    buildLive();
    rail_ = new WorkspaceRail(this);
    addToolBar(Qt::LeftToolBarArea, rail_);
    connect(rail_, &WorkspaceRail::chosen, this, [this](int index) {
        showWorkspace(index);
        focusWorkspace();
    });
    buildDocks();
    new Menus(*this, rail_->workspaces(), *docks_, *line_);
    auto* day = new DayButton(controller_.day(), menuBar());
    connect(day, &QToolButton::clicked, this, [this] { askForDay(false); });
    menuBar()->setCornerWidget(day, Qt::TopRightCorner);
    connect(&controller_.day(), &DayNotes::wanted, this, [this] {
        askForDay(true);
        line_->say(DayNotes::wantedText());
    });
    tour_ = new WelcomeTour(*this);
    arming_ = new ArmQuestion(controller_, *this);
    connect(arming_, &ArmQuestion::refused, banner_, &NoticeBanner::complain);
    connect(safety_, &SafetyBar::armRequested, this, &MainWindow::askToArm);
    connect(safety_, &SafetyBar::detailsRequested, line_, &RecordingLine::showLog);
    connect(&controller_, &BenchController::changed, this, &MainWindow::noteChange);
    if (pages == Pages::AtOnce) buildOthers();
    restore();
    connect(&frame_, &QTimer::timeout, this, &MainWindow::tick);
    frame_.start(kFrame_ms);
    noteChange();
}

MainWindow::~MainWindow() {
    // Hiding notifies the workspaces, and they ask the controller: it is a member, and gone when Qt would hide the
    // window.
    hide();
}

void MainWindow::buildLive() {
    livePage_ = new TabbedPage(pages_);
    livePage_->setObjectName("livePage");
    auto* touch = new ScrollingPage(livePage_->room());
    live_ = makeIn<LiveWorkspace>(*touch, controller_);
    livePage_->addTab(touch, tr("&Touch"), live_->tools());
    auto* oscilloscope = new ScrollingPage(livePage_->room());
    scope_ = makeIn<ScopeWorkspace>(*oscilloscope, controller_);
    livePage_->addTab(oscilloscope, tr("&Oscilloscope"), scope_->tools());
    pages_->addWidget(livePage_);
    connect(live_, &LiveWorkspace::refusedRecording, banner_, &NoticeBanner::complain);
    connect(live_, &LiveWorkspace::markWanted, this, &MainWindow::markMoment);
    connect(scope_, &ScopeWorkspace::openBenchWanted, this, &MainWindow::openSimulatedBench);
}

void MainWindow::buildOthers() {
    if (closing_ != nullptr) return;
    calibrate_ = addPage<CalibrateWorkspace>(*pages_, controller_, calibrations_);
    safetyCheck_ = addPage<ProtocolWorkspace>(*pages_, controller_, "load-safety");
    separability_ = addPage<ProtocolWorkspace>(*pages_, controller_, "separability");
    pilot_ = addPage<PilotWorkspace>(*pages_, controller_);
    pilot_->setButtonDevices(buttonDevices());
    connect(pilot_, &PilotWorkspace::attentionWanted, this, [this] { showWorkspace(kPilot); });
    connect(pilot_, &PilotWorkspace::runningChanged, this, &MainWindow::noteBlind);
    sessions_ = addPage<SessionsWorkspace>(*pages_, controller_);
    protocols_ = addPage<ProtocolWorkspace>(*pages_, controller_, QString());
    for (auto* runner : calibrate_->runners())
        connect(runner, &ProtocolWorkspace::attentionWanted, this, [this] { showWorkspace(kCalibrate); });
    connect(safetyCheck_, &ProtocolWorkspace::attentionWanted, this, [this] { showWorkspace(kSafetyCheck); });
    connect(separability_, &ProtocolWorkspace::attentionWanted, this, [this] { showWorkspace(kSeparability); });
    connect(protocols_, &ProtocolWorkspace::attentionWanted, this, [this] { showWorkspace(kProtocols); });
    for (auto* runner : runners()) {
        connect(runner, &ProtocolWorkspace::profileChangeWanted, live_, [this] { live_->editProfile(); });
        connect(runner, &ProtocolWorkspace::sessionWanted, this, &MainWindow::openFile);
        connect(runner, &ProtocolWorkspace::safetyCheckWanted, this, [this] { showWorkspace(kSafetyCheck); });
        connect(runner, &ProtocolWorkspace::liveWanted, this, [this] { showWorkspace(kLive); });
        connect(runner, &ProtocolWorkspace::captured, summary_, &MeasurementSummary::measure);
    }
    connect(sessions_, &SessionsWorkspace::captureChosen, this, [this](std::shared_ptr<const Capture> capture) {
        scope_->show(std::move(capture));
        showScope();
    });
    connect(sessions_, &SessionsWorkspace::recordingReady, this, [this](const QString& folder) {
        if (!live_->openRecording(folder)) return;
        showWorkspace(kLive);
        livePage_->setCurrentIndex(kTouch);
    });
    const auto all = runners();
    closing_ = new CloseQuestion(controller_, *this, {all.begin(), all.end()}, [this] { return pilot_->running(); });
}

void MainWindow::buildDocks() {
    drive_ = new DriveDock(controller_, this);
    measurements_ = new FoldingDock(tr("Measurements"), "measurements", "measurementDock", this);
    summary_ = new MeasurementSummary(measurements_);
    summary_->follow(scope_->readings());
    measurements_->setContent(summary_);
    exposure_ = new ExposureDock(controller_, this);
    devices_ = new DeviceDock(controller_, calibrations_, this);
    docks_ = new DockColumn(*this, {drive_, measurements_, exposure_, devices_});
    connect(scope_, &ScopeWorkspace::captureShown, summary_, &MeasurementSummary::take);
    connect(exposure_, &ExposureDock::areaWanted, live_, [this] { live_->editProfile("electrode_area_cm2"); });
    connect(scope_, &ScopeWorkspace::driveWanted, this, [this] {
        docks_->show(*drive_);
        drive_->takeFocus();
    });
    connect(livePage_, &TabbedPage::currentChanged, this, &MainWindow::enterDocks);
    connect(measurements_, &QDockWidget::visibilityChanged, scope_, &ScopeWorkspace::setWatched);
    connect(devices_, &DeviceDock::simulatedBenchRequested, this, &MainWindow::askForSimulatedBench);
    connect(devices_, &DeviceDock::recordingRequested, this, &MainWindow::chooseRecording);
    connect(devices_, &DeviceDock::checkRequested, this, &MainWindow::checkImpedance);
}

std::array<ProtocolWorkspace*, 5> MainWindow::runners() const {
    const auto [stimulator, sensor] = calibrate_->runners();
    return {stimulator, sensor, safetyCheck_, separability_, protocols_};
}

void MainWindow::tick() {
    const auto telemetry = controller_.telemetry();
    safety_->refresh(telemetry);
    if (pilot_ != nullptr && pilot_->blind()) safety_->setParticipantsStop(pilot_->stopWords());
    banner_->refresh(telemetry);
    devices_->refresh(telemetry);
    drive_->refresh(telemetry);
    exposure_->refresh(telemetry);
    docks_->refresh();
    line_->refresh();
    const bool live = workspace() == kLive;
    live_->refresh(telemetry, live && livePage_->currentIndex() == kTouch);
    const bool measured = measurements_->isVisible();
    if (measured || (live && livePage_->currentIndex() == kScope)) scope_->refresh(telemetry);
    if (measured) summary_->refresh(telemetry);
    if (closing_ == nullptr) return;  // nothing runs where there is no page for it
    // One of them takes what a run says: the one it was started from, told apart by themselves.
    for (auto* protocol : runners()) protocol->refresh();
    pilot_->refresh(telemetry);
}

void MainWindow::showWorkspace(int index) {
    if (index != kLive) buildOthers();
    if (index < 0 || index >= pages_->count() || (pilot_ != nullptr && pilot_->blind() && index != kPilot)) return;
    pages_->setCurrentIndex(index);
    rail_->setCurrent(index);
    enterDocks();
}

/// Live work has the docks open, those of what is looked at unfolded; everything else gives the room to its plot.
void MainWindow::enterDocks() {
    const int page = workspace();
    const bool scope = page == kLive && livePage_->currentIndex() == kScope;
    const auto name = scope ? QString("oscilloscope") : QString::number(page);
    std::vector<FoldingDock*> folded;
    if (page == kLive) folded.push_back(scope ? static_cast<FoldingDock*>(devices_) : measurements_);
    hasRoomForDocks_ = width() >= scaledPx(kDocksFrom);
    docks_->enter({page, name, page == kLive && hasRoomForDocks_, folded});
}

/// The keys that follow are meant for the workspace. Not for a field of text in it: there Space would not stop.
void MainWindow::focusWorkspace() {
    const auto* page = pages_->currentWidget();
    for (auto* next = page->nextInFocusChain(); next != page; next = next->nextInFocusChain()) {
        const bool takesText = next->inherits("QLineEdit") || next->inherits("QAbstractSpinBox") ||
                               next->inherits("QPlainTextEdit") || next->inherits("QTextEdit");
        if (!page->isAncestorOf(next) || takesText || !next->isVisible() || !next->isEnabled()) continue;
        if ((next->focusPolicy() & Qt::TabFocus) != 0) return next->setFocus(Qt::ShortcutFocusReason);
    }
    pages_->currentWidget()->setFocus(Qt::ShortcutFocusReason);  // nothing but text: the page itself
}

void MainWindow::showPlotOnly(bool only) {
    buildOthers();
    rail_->setVisible(!only);
    statusBar()->setVisible(!only);
    menuBar()->setVisible(!only);
    for (auto* page : findChildren<TabbedPage*>()) page->setHeadVisible(!only);
    calibrate_->showPlotOnly(only);
    pilot_->showPlotOnly(only);
    live_->showPlotOnly(only);
    for (auto* runner : runners()) runner->showPlotOnly(only);
    docks_->setHidden(DockColumn::Hidden::PlotOnly, only);
    // What had the keys may be hidden: Space must stop.
    if (only) focusWorkspace();
}

void MainWindow::resetLayout() {
    docks_->reset();
    enterDocks();
    for (auto* splitter : findChildren<QSplitter*>()) layOutAnew(*splitter);
    scope_->resetLayout();
    line_->say(tr("Docks and columns are where they were at first."));
}

void MainWindow::showScope() {
    showWorkspace(kLive);
    livePage_->setCurrentIndex(kScope);
}

void MainWindow::noteChange() {
    const auto open = controller_.open();
    // The program's name comes last: Qt adds it to a title that ends otherwise.
    setWindowTitle(open && open->simulated() ? tr("Simulated – Tactoscope") : tr("Tactoscope"));
}

void MainWindow::askToArm() { arming_->ask(ArmDialog::Purpose::Arm); }

/// Lanes, bars and docks show levels and trains as they are delivered.
void MainWindow::noteBlind() {
    const bool blind = pilot_->blind();
    if (blind) showWorkspace(kPilot);
    rail_->keepTo(blind ? std::optional<int>(kPilot) : std::nullopt,
                  tr("Hidden until the session ends: it would show what is delivered."));
    const bool pauses = pilot_->running() && pilot_->participantWindow() != nullptr;
    std::optional<PauseInstead> instead;
    if (pauses)
        instead = {[this](bool pause) { pilot_->pauseSession(pause); }, [this] { return pilot_->sessionPaused(); }};
    safety_->setPauseInstead(std::move(instead));
    docks_->setHidden(DockColumn::Hidden::Blind, blind);
    safety_->setBlind(blind);
}

void MainWindow::checkImpedance() { arming_->ask(ArmDialog::Purpose::CheckImpedance); }

void MainWindow::askForSimulatedBench() { openDialog(new SimulatedBenchDialog(controller_, this)); }

void MainWindow::openSimulatedBench() {
    LiveOrder order;
    order.uris.push_back(*DeviceUri::parse("sim:"));
    order.profile = controller_.profile();
    controller_.openLive(order);
}

void MainWindow::openFile(const QString& path) {
    buildOthers();
    const QFileInfo file(path);
    bool opened = false;
    if (file.isDir() || file.suffix() == "json") {
        opened = live_->openRecording(path);
        if (opened) {
            showWorkspace(kLive);
            livePage_->setCurrentIndex(kTouch);
        }
    } else if (file.suffix() == "tacto") {
        opened = sessions_->openSession(path);
        if (opened) showWorkspace(kSessions);
    } else if (captureFormats()->knowsSuffix(path.toStdString())) {
        opened = scope_->openCaptureFile(path);
        if (opened) showScope();
    } else {
        banner_->complain(tr("%1 is not a recording (a folder or recording.json), session (*.tacto) or capture (%2)")
                              .arg(path, ScopeFiles::captureGlobs()));
    }
    if (opened) rememberRecentFile(path);
}

void MainWindow::chooseFile() {
    FileQuestion question;
    question.title = tr("Open");
    question.filters << tr("Recordings, sessions and captures (*.json *.tacto %1)").arg(ScopeFiles::captureGlobs())
                     << tr("All files (*)");
    askForFile(*this, question, [this](const QString& path) { openFile(path); });
}

void MainWindow::chooseRecording() {
    FileQuestion question;
    question.title = tr("Open a recording: its folder");
    question.wants = FileQuestion::Wants::Folder;
    askForFile(*this, question, [this](const QString& path) { openFile(path); });
}

void MainWindow::closeUnasked() {
    buildOthers();
    closing_->closeUnasked();
}

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

void MainWindow::restore() {
    QSettings settings;
    if (!restoreGeometry(settings.value("geometry").toByteArray())) resize(kWanted);
    keepOnScreen(*this);
    if (!restoreState(settings.value("state").toByteArray())) {
        QTimer::singleShot(0, this, [this] { docks_->reset(); });  // once the window is laid out
    }
    // One that was left with the plot only begins whole.
    rail_->show();
    statusBar()->show();
    // A state that was damaged must not hide STOP.
    if (auto* top = findChild<QToolBar*>("safetyToolBar")) {
        addToolBar(Qt::TopToolBarArea, top);
        top->show();
    }
    showWorkspace(settings.value("workspace", 0).toInt());
}

void MainWindow::showEvent(QShowEvent* event) {
    QMainWindow::showEvent(event);
    if (event->spontaneous()) return;
    QTimer::singleShot(0, this, [this] { keepOnScreen(*this); });  // once the window system has put its frame around it
}

void MainWindow::resizeEvent(QResizeEvent* event) {
    QMainWindow::resizeEvent(event);
    rail_->fit();
    if (docks_ != nullptr && hasRoomForDocks_ != (width() >= scaledPx(kDocksFrom))) enterDocks();
}

/// What is built afterwards does not delay the first picture.
bool MainWindow::event(QEvent* event) {
    if (event->type() == QEvent::Paint && closing_ == nullptr) QTimer::singleShot(0, this, &MainWindow::buildOthers);
    return QMainWindow::event(event);
}

void MainWindow::changeEvent(QEvent* event) {
    QMainWindow::changeEvent(event);
    if (event->type() != QEvent::WindowStateChange || !isMinimized()) return;
    // A STOP that is off the screen is out of reach. A simulated output may go on.
    const auto open = controller_.open();
    const bool virtualOutput = open && (!open->output || open->output->simulated);
    if (controller_.activity() != Activity::Closed && !virtualOutput) controller_.stop("the window was minimised");
}

void MainWindow::closeEvent(QCloseEvent* event) {
    buildOthers();
    const bool ran = closing_->runs();
    controller_.stop("the window closes");  // before anything is asked
    if (!closing_->mayClose(ran)) return event->ignore();
    QSettings settings;
    settings.setValue("geometry", saveGeometry());
    settings.setValue("state", saveState());
    settings.setValue("workspace", workspace());
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
