#include "app/gui/window/Workspaces.h"

#include <QAbstractButton>
#include <QDir>
#include <QFileInfo>
#include <QSettings>
#include <QTableView>
#include <algorithm>
#include <functional>
#include <iterator>

#include "app/gui/calibrate/CalibrateWorkspace.h"
#include "app/gui/live/LiveWorkspace.h"
#include "app/gui/pilot/PilotWorkspace.h"
#include "app/gui/runner/ProtocolWorkspace.h"
#include "app/gui/scope/ScopeFiles.h"
#include "app/gui/scope/ScopeWorkspace.h"
#include "app/gui/sessions/SessionsWorkspace.h"
#include "app/gui/theme/Pages.h"
#include "app/gui/theme/PlotPicture.h"
#include "app/gui/theme/TabbedPage.h"
#include "app/gui/theme/TableText.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"
#include "app/run/AllDrivers.h"
#include "app/run/CaptureFormatsList.h"
#include "core/exchange/recordings/OpenRecording.h"

namespace tacto::gui {

namespace {

/// Makes a workspace inside its page.
template <typename Workspace, typename... Arguments>
Workspace* makeIn(ScrollingPage& page, Arguments&&... arguments) {
    auto* workspace = new Workspace(std::forward<Arguments>(arguments)..., page.viewport());
    page.hold(workspace);
    return workspace;
}

QString wholePath(const QString& path) { return QDir::cleanPath(QFileInfo(path).absoluteFilePath()); }

/// Moves the file to the head of the recent ones, or takes it out of them.
void rememberRecentFile(const QString& path, bool opens) {
    constexpr qsizetype kMaxFiles = 8;
    auto files = QSettings().value("recent").toStringList();
    const auto absolute = wholePath(path);
    files.removeAll(absolute);
    if (opens) files.prepend(absolute);
    QSettings().setValue("recent", QStringList(files.mid(0, kMaxFiles)));
}

template <class T>
T* shownIn(const QWidget& page, const std::function<bool(const T&)>& suits) {
    for (auto* each : page.findChildren<T*>())
        if (suits(*each)) return each;
    return nullptr;
}

bool canBePressed(const QWidget& widget) { return widget.isVisible() && widget.isEnabled(); }

}  // namespace

QStringList recentFiles() {
    auto files = QSettings().value("recent").toStringList();
    files.removeIf([](const QString& path) { return !QFileInfo::exists(path); });
    return files;
}

Workspaces::Workspaces(BenchController& controller, CalibrationBook& calibrations, QWidget* parent)
    : QStackedWidget(parent), controller_(controller), calibrations_(calibrations) {
    for (int page = kLive; page <= kProtocols; ++page) addWidget(new ScrollingPage(this));
    livePage_ = makeOn<TabbedPage>(kLive);
    livePage_->setObjectName("livePage");
    auto* touch = new ScrollingPage(livePage_->room());
    live_ = makeIn<LiveWorkspace>(*touch, controller_);
    livePage_->addTab(touch, tr("&Touch"), live_->tools());
    auto* oscilloscope = new ScrollingPage(livePage_->room());
    scope_ = makeIn<ScopeWorkspace>(*oscilloscope, controller_);
    livePage_->addTab(oscilloscope, tr("&Oscilloscope"), scope_->tools());
    connect(livePage_, &TabbedPage::currentChanged, this, &Workspaces::shown);
    connect(live_, &LiveWorkspace::refusedRecording, this, &Workspaces::complained);
    connect(live_, &LiveWorkspace::markWanted, this, &Workspaces::markWanted);
    connect(live_, &LiveWorkspace::plotOnlyWanted, this, &Workspaces::plotOnlyWanted);
    connect(scope_, &ScopeWorkspace::markWanted, this, &Workspaces::markWanted);
    connect(scope_, &ScopeWorkspace::plotOnlyWanted, this, &Workspaces::plotOnlyWanted);
    connect(scope_, &ScopeWorkspace::openBenchWanted, this, &Workspaces::simulatedBenchWanted);
    connectFiles();
}

/// A file counts as opened once its content is shown, which for all kinds is later than it is asked for.
void Workspaces::connectFiles() {
    // What a run recorded is a file of the operator like one that was opened; a study's sessions stay in the study.
    connect(&controller_, &BenchController::finished, this, [](const std::shared_ptr<const FinishedRun>& run) {
        const auto& session = run->result.session;
        if (!session.empty() && (!run->order.out.empty() || session.parent_path() == userSessionsFolder()))
            rememberRecentFile(qtext(session.string()), true);
    });
    connect(&controller_, &BenchController::changed, this, [this] {
        const auto open = controller_.open();
        recording_.clear();
        if (!open) return;
        for (const auto& device : open->about.devices) {
            const auto uri = DeviceUri::parse(device.uri);
            if (uri && uri->scheme == "recording") recording_ = qtext(uri->path);
        }
        noteOpened(recording_);
    });
    connect(scope_, &ScopeWorkspace::captureShown, this, [this](const ShownPtr& shown) {
        const auto isOf = [&](const QString& path) {
            return !path.isEmpty() && shown->source.startsWith(QFileInfo(path).fileName());
        };
        if (isOf(asked_))
            capture_ = asked_;
        else if (!isOf(capture_))
            capture_.clear();
        noteOpened(capture_);
    });
    connect(scope_, &ScopeWorkspace::fileAsked, this, &Workspaces::noteAsked);
}

void Workspaces::noteAsked(const QString& path) {
    asked_ = path;
    rememberRecentFile(path, false);  // until it is open
}

void Workspaces::noteOpened(const QString& path) {
    if (asked_.isEmpty() || path.isEmpty() || wholePath(path) != wholePath(asked_)) return;
    rememberRecentFile(path, true);
    asked_.clear();
}

template <typename Workspace, typename... Arguments>
Workspace* Workspaces::makeOn(int page, Arguments&&... arguments) {
    return makeIn<Workspace>(*static_cast<ScrollingPage*>(widget(page)), std::forward<Arguments>(arguments)...);
}

void Workspaces::make(int page) {
    const auto makeRunner = [&](ProtocolWorkspace*& runner, const QString& protocol) {
        if (runner != nullptr) return;
        runner = makeOn<ProtocolWorkspace>(page, controller_, protocol);
        addRunner(*runner, page);
    };
    if (page == kSafetyCheck) makeRunner(safetyCheck_, "load-safety");
    if (page == kSeparability) makeRunner(separability_, "separability");
    if (page == kProtocols) makeRunner(protocols_, {});
    if (page == kCalibrate && calibrate_ == nullptr) {
        calibrate_ = makeOn<CalibrateWorkspace>(page, controller_, calibrations_);
        for (auto* runner : calibrate_->runners()) addRunner(*runner, page);
    }
    if (page == kPilot && pilot_ == nullptr) {
        pilot_ = makeOn<PilotWorkspace>(page, controller_);
        pilot_->setButtonDevices(buttonDevices());
        connect(pilot_, &PilotWorkspace::attentionWanted, this, [this] { showPage(kPilot); });
        emit pilotMade();
    }
    if (page == kSessions && sessions_ == nullptr) {
        sessions_ = makeOn<SessionsWorkspace>(page, controller_);
        connectSessions();
    }
    if (plotOnly_) showPlotOnly(true);
}

void Workspaces::addRunner(ProtocolWorkspace& runner, int page) {
    connect(&runner, &ProtocolWorkspace::attentionWanted, this, [this, page] { showPage(page); });
    connect(&runner, &ProtocolWorkspace::profileChangeWanted, live_, [this] { live_->editProfile(); });
    connect(&runner, &ProtocolWorkspace::sessionWanted, this, &Workspaces::openFile);
    connect(&runner, &ProtocolWorkspace::safetyCheckWanted, this, [this] { showPage(kSafetyCheck); });
    connect(&runner, &ProtocolWorkspace::liveWanted, this, [this] { showPage(kLive); });
    connect(&runner, &ProtocolWorkspace::plotOnlyWanted, this, &Workspaces::plotOnlyWanted);
    connect(&runner, &ProtocolWorkspace::captured, this, &Workspaces::captured);
}

void Workspaces::connectSessions() {
    connect(sessions_, &SessionsWorkspace::sessionShown, this, &Workspaces::noteOpened);
    connect(sessions_, &SessionsWorkspace::captureChosen, this, [this](std::shared_ptr<const Capture> capture) {
        scope_->show(std::move(capture));
        showLive(kScope);
    });
    connect(sessions_, &SessionsWorkspace::recordingReady, this, [this](const QString& folder) {
        if (live_->openRecording(folder)) showLive(kTouch);
    });
}

std::vector<ProtocolWorkspace*> Workspaces::runners() const {
    std::vector<ProtocolWorkspace*> all{safetyCheck_, separability_, protocols_};
    std::erase(all, nullptr);
    if (calibrate_ != nullptr) std::ranges::copy(calibrate_->runners(), std::back_inserter(all));
    return all;
}

void Workspaces::showPage(int page) {
    if (page < 0 || page >= count() || (pilot_ != nullptr && pilot_->blind() && page != kPilot)) return;
    make(page);
    setCurrentIndex(page);
    emit shown();
}

void Workspaces::showLive(LiveTab tab) {
    showPage(kLive);
    livePage_->setCurrentIndex(tab);
}

bool Workspaces::showsScope() const { return currentIndex() == kLive && livePage_->currentIndex() == kScope; }

void Workspaces::takeFocus() {
    auto* page = currentWidget();
    for (auto* next = page->nextInFocusChain(); next != page; next = next->nextInFocusChain()) {
        // In a list of choices, such as the sessions' filters, an arrow would change a setting.
        const bool takesKeys = next->inherits("QLineEdit") || next->inherits("QAbstractSpinBox") ||
                               next->inherits("QPlainTextEdit") || next->inherits("QTextEdit") ||
                               next->inherits("QComboBox");
        if (!page->isAncestorOf(next) || takesKeys || !next->isVisible() || !next->isEnabled()) continue;
        if ((next->focusPolicy() & Qt::TabFocus) != 0) return next->setFocus(Qt::ShortcutFocusReason);
    }
    page->setFocus(Qt::ShortcutFocusReason);  // without any control the page itself takes the focus
}

void Workspaces::showPlotOnly(bool only) {
    plotOnly_ = only;
    for (auto* page : findChildren<TabbedPage*>()) page->setHeadVisible(!only);
    if (calibrate_ != nullptr) calibrate_->showPlotOnly(only);
    if (pilot_ != nullptr) pilot_->showPlotOnly(only);
    live_->showPlotOnly(only);
    for (auto* runner : runners()) runner->showPlotOnly(only);
}

void Workspaces::refresh(const Telemetry& telemetry, bool measured, bool inSight) {
    letYield(*this, telemetry.state == InterlockState::Faulted);  // makes room for Reset
    live_->refresh(telemetry, inSight && currentIndex() == kLive && !showsScope());
    if (measured || showsScope()) scope_->refresh(telemetry);
    // Only the workspace that started the run takes its reports; each recognises its own run.
    for (auto* protocol : runners()) protocol->refresh();
    if (pilot_ != nullptr) pilot_->refresh(telemetry);
}

void Workspaces::openFile(const QString& path) {
    const QFileInfo file(path);
    noteAsked(path);
    if (!file.exists() && path.contains(QChar::ReplacementCharacter)) {
        emit complained(tr("The name of %1 is not UTF-8. Rename it first.").arg(path));
    } else if (file.isDir() || file.suffix() == "json" || isSignalName(path.toStdString())) {
        if (live_->openRecording(path)) showLive(kTouch);
    } else if (file.suffix() == "tacto") {
        make(kSessions);
        if (sessions_->openSession(path)) showPage(kSessions);
    } else if (captureFormats()->knowsSuffix(path.toStdString())) {
        static_cast<void>(scope_->openCaptureFile(path));
        showLive(kScope);  // shows the capture, or why it was not opened
    } else {
        emit complained(
            tr("%1 is not a recording (a folder, recording.json, EDF, BDF or XDF), session (*.tacto) or capture (%2)")
                .arg(path, ScopeFiles::captureGlobs()));
    }
}

QString Workspaces::file() const {
    if (currentIndex() == kSessions && sessions_ != nullptr) return sessions_->file();
    if (showsScope() && !capture_.isEmpty()) return capture_;
    return recording_;
}

PictureTools* Workspaces::pictures() const {
    return shownIn<PictureTools>(*currentWidget(), [](const auto& tools) { return canBePressed(tools.save()); });
}

/// The first plot in sight of a page that has no picture tools.
QCustomPlot* Workspaces::plot() const {
    return shownIn<QCustomPlot>(*currentWidget(), [](const auto& plot) {
        return canBePressed(plot) &&
               plot.template findChild<QAction*>(kSavePlot, Qt::FindDirectChildrenOnly) != nullptr;
    });
}

bool Workspaces::hasPicture() const {
    return showsScope() ? scope_->hasPicture() : pictures() != nullptr || plot() != nullptr;
}

void Workspaces::askSavePicture() {
    if (showsScope()) return scope_->askSavePicture();
    if (auto* tools = pictures()) return tools->save().click();
    if (auto* shown = plot()) shown->findChild<QAction*>(kSavePlot, Qt::FindDirectChildrenOnly)->trigger();
}

std::optional<QString> Workspaces::savePicture(const QString& path) const {
    if (showsScope()) return scope_->savePicture(path);
    if (const auto* tools = pictures()) return gui::savePicture(tools->picture(), path);
    auto* shown = plot();
    return shown == nullptr ? std::nullopt : gui::savePicture(*shown, path);
}

ProtocolWorkspace* Workspaces::shownRunner() const {
    const auto all = runners();
    const auto shown = std::ranges::find_if(all, &QWidget::isVisible);
    return shown == all.end() ? nullptr : *shown;
}

QString Workspaces::report() const {
    if (currentIndex() == kSessions && sessions_ != nullptr) return sessions_->writtenReport();
    const auto* runner = shownRunner();
    return runner == nullptr ? QString() : runner->report();
}

namespace {

QAbstractButton* exportButtonOf(const QWidget& page) {
    return shownIn<QAbstractButton>(page, [](const auto& button) {
        return canBePressed(button) && (button.objectName() == "exportSession" || button.objectName() == "exportStudy");
    });
}

QTableView* tableOn(const QWidget& page) {
    return shownIn<QTableView>(page, [](const auto& table) {
        return table.isVisible() && table.model() != nullptr && table.model()->rowCount() > 0;
    });
}

}  // namespace

bool Workspaces::canExport() const {
    if (showsScope() && scope_->hasPicture()) return true;
    return exportButtonOf(*currentWidget()) != nullptr || tableOn(*currentWidget()) != nullptr;
}

void Workspaces::askExport() {
    if (showsScope() && scope_->hasPicture()) return scope_->askSaveData();
    if (auto* button = exportButtonOf(*currentWidget())) return button->click();
    if (auto* table = tableOn(*currentWidget())) TableCopies::askSave(*table, textOf(*table));
}

bool Workspaces::canClose() const {
    return shownIn<QAbstractButton>(*currentWidget(),
                                    [](const auto& button) {
                                        return canBePressed(button) && button.objectName() == "closeStudy";
                                    }) != nullptr ||
           controller_.activity() == Activity::Live;
}

void Workspaces::closeFile() {
    auto* study = currentWidget()->findChild<QAbstractButton*>("closeStudy");
    if (study != nullptr && canBePressed(*study)) return study->click();
    controller_.close();
}

}  // namespace tacto::gui

#include "moc_Workspaces.cpp"
