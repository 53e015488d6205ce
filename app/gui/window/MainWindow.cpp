#include "app/gui/window/MainWindow.h"

#include <QApplication>
#include <QCloseEvent>
#include <QFileInfo>
#include <QLabel>
#include <QMimeData>
#include <QPushButton>
#include <QScreen>
#include <QScrollArea>
#include <QSettings>
#include <QStatusBar>
#include <QTabWidget>
#include <QToolBar>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "app/gui/calibrate/CalibrateWorkspace.h"
#include "app/gui/live/LiveWorkspace.h"
#include "app/gui/look/Dialogs.h"
#include "app/gui/runner/ProtocolWorkspace.h"
#include "app/gui/scope/MeasurementSummary.h"
#include "app/gui/scope/ScopeWorkspace.h"
#include "app/gui/sessions/SessionsWorkspace.h"
#include "app/gui/window/ComingWorkspace.h"
#include "app/gui/window/DeviceDock.h"
#include "app/gui/window/ExposureDock.h"
#include "app/gui/window/RecordingLine.h"
#include "app/gui/window/SafetyBar.h"
#include "app/gui/window/SimulatedBenchDialog.h"
#include "app/gui/window/StopKeys.h"
#include "app/gui/window/Tour.h"
#include "app/run/CaptureFormatsList.h"
#include "core/devices/Driver.h"

namespace tacto::gui {

namespace {

constexpr int kFrame_ms = 33;
constexpr int kRecentFiles = 8;
constexpr int kStackedLines = 50;
constexpr QSize kWanted(1440, 900);  // where the screen is large enough

enum LiveTab { kTouch, kScope };
enum Page { kLive, kCalibrate, kSafetyCheck, kSeparability, kPilot, kSessions, kProtocols };

/// What a simulated stimulator drives. What is connected to a real one only the operator can say.
QString knownLoad(const SessionAbout& about) {
    for (const auto& device : about.devices) {
        const auto uri = DeviceUri::parse(device.uri);
        if (device.role != "stimulator" || !uri || uri->scheme != "sim") continue;
        const auto load = std::ranges::find(uri->parameters, "load", [](const auto& p) { return p.first; });
        return QString::fromStdString(load == uri->parameters.end() ? kDefaultLoad : load->second);
    }
    return {};
}

/// The page, with scroll bars where there is less room than it needs: no page makes the window larger than the screen.
QScrollArea* scrolling(QWidget* page, QWidget* parent) {
    auto* area = new QScrollArea(parent);
    area->setFrameShape(QFrame::NoFrame);
    area->setWidgetResizable(true);
    area->setFocusPolicy(Qt::NoFocus);
    area->setMinimumSize(1, 1);
    area->setWidget(page);
    return area;
}

}  // namespace

MainWindow::MainWindow(BenchDesk::MakeRegistry makeRegistry) : desk_(std::move(makeRegistry)) {
    setWindowTitle(tr("Tactoscope"));
    setAcceptDrops(true);
    setDockOptions(AnimatedDocks | AllowNestedDocks | AllowTabbedDocks);
    applyTextSize(QSettings().value("textSize", 100).toInt());  // before anything measures its text
    new StopKeys([this](const char* by) { desk_.stop(by); }, this);

    safety_ = new SafetyBar(desk_, calibrations_, this);
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
    auto* layout = new QVBoxLayout(centre);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    banner_ = new QFrame(centre);
    banner_->setObjectName("banner");
    banner_->setFrameShape(QFrame::StyledPanel);
    auto* bannerRow = new QHBoxLayout(banner_);
    bannerText_ = new QLabel(banner_);
    bannerText_->setObjectName("bannerText");
    bannerText_->setWordWrap(true);
    bannerText_->setTextInteractionFlags(Qt::TextSelectableByMouse);
    bannerRow->addWidget(bannerText_, 1);
    auto* dismiss = new QPushButton(tr("Dismiss"), banner_);
    dismiss->setAutoDefault(false);
    connect(dismiss, &QPushButton::clicked, banner_, &QWidget::hide);
    bannerRow->addWidget(dismiss);
    banner_->hide();
    layout->addWidget(banner_);
    pages_ = new QStackedWidget(centre);
    layout->addWidget(pages_, 1);
    setCentralWidget(centre);
    line_ = new RecordingLine(desk_, *statusBar());
    if (const auto added = addedLimitsText(desk_.limits()); !added.empty()) {
        auto* limits = new QLabel(QString::fromStdString(added), this);
        limits->setObjectName("added-limits");
        statusBar()->addPermanentWidget(limits);
    }

    buildPages();
    buildNavigation();
    buildDocks();
    buildMenus();
    buildTour();
    connect(safety_, &SafetyBar::armRequested, this, &MainWindow::askToArm);
    connect(&desk_, &BenchDesk::changed, this, &MainWindow::noteChange);
    connect(&desk_, &BenchDesk::failed, this, &MainWindow::complain);
    connect(&desk_, &BenchDesk::armed, this, [this] {
        saidArmed_ = true;
        line_->say(tr("Armed."));
    });
    connect(&desk_, &BenchDesk::checked, this, [this](double ohms) {
        line_->say(std::isnan(ohms) ? tr("This stimulator does not measure the impedance. Disarmed.")
                                    : tr("Impedance %1. Disarmed.").arg(quantityText(ohms, "ohm", 4)));
    });
    restore();
    connect(&frame_, &QTimer::timeout, this, &MainWindow::tick);
    frame_.start(kFrame_ms);
    noteChange();
}

MainWindow::~MainWindow() {
    // Hiding is told to the workspaces, and they ask the desk: it is a member, and gone when Qt would hide the window.
    hide();
}

void MainWindow::buildPages() {
    livePage_ = new QTabWidget(pages_);
    livePage_->setObjectName("livePage");
    livePage_->setDocumentMode(true);
    live_ = new LiveWorkspace(desk_, livePage_);
    scope_ = new ScopeWorkspace(desk_, livePage_);
    livePage_->addTab(scrolling(live_, livePage_), tr("&Touch"));
    livePage_->addTab(scrolling(scope_, livePage_), tr("&Oscilloscope"));
    pages_->addWidget(livePage_);
    calibrate_ = new CalibrateWorkspace(desk_, calibrations_, pages_);
    pages_->addWidget(scrolling(calibrate_, pages_));
    safetyCheck_ = new ProtocolWorkspace(desk_, "load-safety", pages_);
    pages_->addWidget(scrolling(safetyCheck_, pages_));
    separability_ = new ProtocolWorkspace(desk_, "separability", pages_);
    pages_->addWidget(scrolling(separability_, pages_));
    pages_->addWidget(new ComingWorkspace(
        tr("Pilot"), tr("For operators: thresholds and identification with three to five volunteers."),
        {tr("Consent, accepted levels and the ramp that approaches them"),
         tr("Threshold and identification protocols with breaks and stopping rules"),
         tr("Participants by pseudonym, trials as data")},
        tr("Nothing in this version can be armed for a person."), pages_));
    sessions_ = new SessionsWorkspace(desk_, pages_);
    pages_->addWidget(scrolling(sessions_, pages_));
    protocols_ = new ProtocolWorkspace(desk_, QString(), pages_);
    pages_->addWidget(scrolling(protocols_, pages_));
    for (auto* runner : calibrate_->runners())
        connect(runner, &ProtocolWorkspace::attentionWanted, this, [this] { showWorkspace(kCalibrate); });
    connect(safetyCheck_, &ProtocolWorkspace::attentionWanted, this, [this] { showWorkspace(kSafetyCheck); });
    connect(separability_, &ProtocolWorkspace::attentionWanted, this, [this] { showWorkspace(kSeparability); });
    connect(protocols_, &ProtocolWorkspace::attentionWanted, this, [this] { showWorkspace(kProtocols); });
    connect(live_, &LiveWorkspace::refusedRecording, this, &MainWindow::complain);
    connect(scope_, &ScopeWorkspace::openBenchWanted, this, &MainWindow::openSimulatedBench);
    connect(sessions_, &SessionsWorkspace::captureChosen, this, [this](std::shared_ptr<const Capture> capture) {
        scope_->show(std::move(capture));
        showScope();
    });
    connect(sessions_, &SessionsWorkspace::recordingReady, this, [this](const QString& folder) {
        if (!live_->openRecording(folder)) return;
        showWorkspace(kLive);
        livePage_->setCurrentIndex(kTouch);
    });
}

void MainWindow::buildNavigation() {
    auto* bar = new QToolBar(tr("Workspaces"), this);
    bar->setObjectName("workspaces");
    bar->setMovable(false);
    bar->setFloatable(false);
    bar->toggleViewAction()->setEnabled(false);
    bar->setContextMenuPolicy(Qt::PreventContextMenu);
    bar->setToolButtonStyle(Qt::ToolButtonTextOnly);
    navigation_ = new QActionGroup(this);
    const std::pair<QString, QString> names[] = {
        {tr("Live"), tr("Touch, drive by hand, replay, and the oscilloscope")},
        {tr("Calibrate"), tr("What the stimulator really delivers, and until when that holds")},
        {tr("Safety check"), tr("Limits on resistor loads")},
        {tr("Separability"), tr("Can an oscilloscope tell the four conditions apart?")},
        {tr("Pilot"), tr("Sessions with volunteers")},
        {tr("Sessions"), tr("Everything that was recorded")},
        {tr("Protocols"), tr("Every protocol script, shipped and the lab's own")},
    };
    int index = 0;
    for (const auto& [name, tip] : names) {
        auto* action = bar->addAction(name);
        action->setCheckable(true);
        action->setShortcut(QKeySequence(Qt::CTRL | static_cast<Qt::Key>(Qt::Key_1 + index)));
        action->setToolTip(tr("%1 (%2)").arg(tip, action->shortcut().toString(QKeySequence::NativeText)));
        navigation_->addAction(action);
        connect(action, &QAction::triggered, this, [this, index] { showWorkspace(index); });
        auto* button = qobject_cast<QToolButton*>(bar->widgetForAction(action));
        button->setObjectName("workspaceButton");
        button->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
        button->setFocusPolicy(Qt::TabFocus);
        button->setAccessibleName(name);
        ++index;
    }
    addToolBar(Qt::LeftToolBarArea, bar);
}

void MainWindow::buildDocks() {
    devices_ = new DeviceDock(desk_, calibrations_, this);
    exposure_ = new ExposureDock(this);
    measurements_ = new QDockWidget(tr("Measurements"), this);
    measurements_->setObjectName("measurementDock");
    summary_ = new MeasurementSummary(measurements_);
    measurements_->setWidget(summary_);
    for (auto* dock : {static_cast<QDockWidget*>(devices_), measurements_, static_cast<QDockWidget*>(exposure_)})
        addDockWidget(Qt::RightDockWidgetArea, dock);
    connect(scope_, &ScopeWorkspace::captureShown, summary_, &MeasurementSummary::take);
    connect(measurements_, &QDockWidget::visibilityChanged, scope_, &ScopeWorkspace::setWatched);
    for (auto* protocol : runners())
        connect(protocol, &ProtocolWorkspace::captured, summary_, &MeasurementSummary::measure);
    connect(devices_, &DeviceDock::simulatedBenchRequested, this, &MainWindow::askForSimulatedBench);
    connect(devices_, &DeviceDock::recordingRequested, this, &MainWindow::chooseRecording);
    connect(devices_, &DeviceDock::checkRequested, this, &MainWindow::checkImpedance);
}

std::array<ProtocolWorkspace*, 5> MainWindow::runners() const {
    const auto [stimulator, sensor] = calibrate_->runners();
    return {stimulator, sensor, safetyCheck_, separability_, protocols_};
}

void MainWindow::tick() {
    const auto telemetry = desk_.telemetry();
    safety_->refresh(telemetry);
    sayState(telemetry);
    sayFault(telemetry);
    devices_->refresh(telemetry);
    if (exposure_->isVisible()) exposure_->refresh(telemetry);
    line_->refresh();
    const bool live = workspace() == kLive;
    live_->refresh(telemetry, live && livePage_->currentIndex() == kTouch);
    const bool measured = measurements_->isVisible();
    if (measured || (live && livePage_->currentIndex() == kScope)) scope_->refresh(telemetry);
    if (measured) summary_->refresh(telemetry);
    // One of them takes what a run says: the one it was started from, told apart by themselves.
    for (auto* protocol : runners()) protocol->refresh(telemetry);
}

void MainWindow::showWorkspace(int index) {
    if (index < 0 || index >= pages_->count()) return;
    pages_->setCurrentIndex(index);
    navigation_->actions().at(index)->setChecked(true);
}

void MainWindow::showScope() {
    showWorkspace(kLive);
    livePage_->setCurrentIndex(kScope);
}

void MainWindow::noteChange() {
    const auto open = desk_.open();
    setWindowTitle(open && open->simulated() ? tr("Tactoscope – simulated") : tr("Tactoscope"));
    if (desk_.activity() == Activity::Live && open) {
        line_->say(tr("Open. Recording to %1").arg(QString::fromStdString(open->session.filename().string())));
        banner_->hide();
        if (std::exchange(loadOf_, open->session) != open->session) load_ = knownLoad(open->about);
    }
}

/// The last message must not say "Armed." when that is over.
void MainWindow::sayState(const Telemetry& telemetry) {
    const auto state = telemetry.state;
    const bool live = state == InterlockState::Checking || state == InterlockState::Armed ||
                      state == InterlockState::Delivering || state == InterlockState::Paused;
    if (live || !std::exchange(saidArmed_, false)) return;
    const auto reason = QString::fromUtf8(telemetry.reason.c_str());
    if (state == InterlockState::Disconnected)
        line_->say(tr("No stimulator is open. Output is off."));
    else if (state == InterlockState::Disarmed)
        line_->say(reason.isEmpty() ? tr("Disarmed. Output is off.") : tr("Disarmed: %1. Output is off.").arg(reason));
}

/// In the second frame: the state is there at once, its reason with the control loop's next step.
void MainWindow::sayFault(const Telemetry& telemetry) {
    if (telemetry.state != InterlockState::Faulted) {
        if (std::exchange(faultedFrames_, 0) > 0 && bannerText_->text() == faultText_) banner_->hide();
        return;
    }
    if (++faultedFrames_ != 2) return;
    complain(tr("Fault: %1").arg(QString::fromUtf8(telemetry.reason.c_str())));
    faultText_ = bannerText_->text();
}

void MainWindow::complain(const QString& what) {
    const auto state = desk_.telemetry().state;
    const bool off =
        state == InterlockState::Disconnected || state == InterlockState::Disarmed || state == InterlockState::Faulted;
    auto text = what;
    if (!text.isEmpty()) text[0] = text[0].toUpper();
    if (!text.endsWith('.')) text += '.';
    if (off && !text.contains(tr("Output is off"))) text += tr(" Output is off.");
    bannerText_->setText("⚠  " + text);
    banner_->show();
    line_->say(text, true);
}

void MainWindow::askToArm() {
    if (desk_.activity() != Activity::Live) {
        return complain(tr("Nothing to arm: no bench is open. Open the simulated bench (Ctrl+B)"));
    }
    askToConfirm(ArmDialog::Purpose::Arm);
}

void MainWindow::checkImpedance() {
    const auto open = desk_.open();
    if (desk_.activity() != Activity::Live || !open || !open->source)
        return complain(tr("No impedance to check: no stimulator is open. Open the simulated bench (Ctrl+B)"));
    askToConfirm(ArmDialog::Purpose::CheckImpedance);
}

void MainWindow::askToConfirm(ArmDialog::Purpose purpose) {
    auto* dialog = new ArmDialog(desk_, purpose, load_, this);
    connect(dialog, &QDialog::accepted, this, [this, dialog] { load_ = dialog->load(); });
    // What it asks about is the bench that is open now: with another bench or profile the question is void.
    connect(&desk_, &BenchDesk::changed, dialog, &QDialog::reject);
    openDialog(dialog);
}

void MainWindow::askForSimulatedBench() { openDialog(new SimulatedBenchDialog(desk_, this)); }

void MainWindow::openSimulatedBench() {
    LiveOrder order;
    order.uris.push_back(*DeviceUri::parse("sim:"));
    order.profile = desk_.profile();
    desk_.openLive(order);
}

void MainWindow::openFile(const QString& path) {
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
        complain(tr("%1 is no recording (a folder or recording.json), session (*.tacto) or capture (%2)")
                     .arg(path, ScopeWorkspace::captureGlobs()));
    }
    if (opened) remember(path);
}

void MainWindow::chooseFile() {
    FileQuestion question;
    question.title = tr("Open");
    question.filters << tr("Recordings, sessions and captures (*.json *.tacto %1)").arg(ScopeWorkspace::captureGlobs())
                     << tr("All files (*)");
    askForFile(*this, question, [this](const QString& path) { openFile(path); });
}

void MainWindow::chooseRecording() {
    FileQuestion question;
    question.title = tr("Open a recording: its folder");
    question.wants = FileQuestion::Wants::Folder;
    askForFile(*this, question, [this](const QString& path) { openFile(path); });
}

void MainWindow::remember(const QString& path) {
    QSettings settings;
    auto files = settings.value("recent").toStringList();
    const auto absolute = QFileInfo(path).absoluteFilePath();
    files.removeAll(absolute);
    files.prepend(absolute);
    while (files.size() > kRecentFiles) files.removeLast();
    settings.setValue("recent", files);
}

void MainWindow::restore() {
    QSettings settings;
    setTheme(settings.value("theme").toString() == "dark" ? Theme::Dark : Theme::Light);
    if (!restoreGeometry(settings.value("geometry").toByteArray())) resize(kWanted);
    stayOnScreen();
    if (!restoreState(settings.value("state").toByteArray())) {
        // Once the window is laid out: room for the exposure table's four columns.
        QTimer::singleShot(0, this, [this] {
            resizeDocks({devices_, measurements_, exposure_}, {width() / 4, width() / 4, width() / 4}, Qt::Horizontal);
            // The devices with their buttons first, then the limits.
            resizeDocks({devices_, measurements_, exposure_}, {height() / 2, height() / 6, height() / 4}, Qt::Vertical);
            // Three above each other where there is room, else as tabs.
            if (height() < fontMetrics().height() * kStackedLines) tabifyDockWidget(measurements_, exposure_);
        });
    }
    // A state that was damaged must not hide STOP.
    if (auto* top = findChild<QToolBar*>("safetyToolBar")) {
        addToolBar(Qt::TopToolBarArea, top);
        top->show();
    }
    showWorkspace(settings.value("workspace", 0).toInt());
}

/// STOP is in the window's corner: no part of the window may lie beyond the screen, whatever it was when it was left.
void MainWindow::stayOnScreen() {
    if (isMaximized() || isFullScreen()) return;
    const auto room = screen()->availableGeometry();
    // Before the window is shown its frame is not known; the second call, then, takes it off.
    const auto frame = frameGeometry().size() - geometry().size();
    resize(size().boundedTo(room.size() - frame));
    auto place = frameGeometry();
    place.moveRight(std::min(place.right(), room.right()));
    place.moveBottom(std::min(place.bottom(), room.bottom()));
    place.moveLeft(std::max(place.left(), room.left()));
    place.moveTop(std::max(place.top(), room.top()));
    if (place.topLeft() != frameGeometry().topLeft()) move(place.topLeft());
}

void MainWindow::showEvent(QShowEvent* event) {
    QMainWindow::showEvent(event);
    if (event->spontaneous()) return;
    QTimer::singleShot(0, this, &MainWindow::stayOnScreen);  // once the window system has put its frame around it
}

void MainWindow::changeEvent(QEvent* event) {
    QMainWindow::changeEvent(event);
    if (event->type() != QEvent::WindowStateChange || !isMinimized()) return;
    // A STOP that is off the screen is out of reach. A simulated output may go on.
    const auto open = desk_.open();
    const bool virtualOutput = open && (!open->output || open->output->simulated);
    if (desk_.activity() != Activity::Closed && !virtualOutput) desk_.stop("the window was minimised");
}

void MainWindow::closeEvent(QCloseEvent* event) {
    desk_.stop("the window closes");
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
