#include "app/gui/window/Workspaces.h"

#include <QFileInfo>

#include "app/gui/calibrate/CalibrateWorkspace.h"
#include "app/gui/live/LiveWorkspace.h"
#include "app/gui/pilot/PilotWorkspace.h"
#include "app/gui/runner/ProtocolWorkspace.h"
#include "app/gui/scope/ScopeFiles.h"
#include "app/gui/scope/ScopeWorkspace.h"
#include "app/gui/sessions/SessionsWorkspace.h"
#include "app/gui/theme/ScrollingPage.h"
#include "app/gui/theme/TabbedPage.h"
#include "app/gui/theme/Theme.h"
#include "app/gui/window/RecentFiles.h"
#include "app/run/AllDrivers.h"
#include "app/run/CaptureFormatsList.h"

namespace tacto::gui {

namespace {

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

}  // namespace

Workspaces::Workspaces(BenchController& controller, CalibrationBook& calibrations, QWidget* parent)
    : QStackedWidget(parent),
      controller_(controller),
      calibrations_(calibrations),
      livePage_(addPage<TabbedPage>(*this)) {
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
}

void Workspaces::complete() {
    if (isComplete()) return;
    calibrate_ = addPage<CalibrateWorkspace>(*this, controller_, calibrations_);
    safetyCheck_ = addPage<ProtocolWorkspace>(*this, controller_, "load-safety");
    separability_ = addPage<ProtocolWorkspace>(*this, controller_, "separability");
    pilot_ = addPage<PilotWorkspace>(*this, controller_);
    pilot_->setButtonDevices(buttonDevices());
    connect(pilot_, &PilotWorkspace::attentionWanted, this, [this] { showPage(kPilot); });
    sessions_ = addPage<SessionsWorkspace>(*this, controller_);
    protocols_ = addPage<ProtocolWorkspace>(*this, controller_, QString());
    connectRunners();
    connectSessions();
    emit completed();
}

void Workspaces::connectRunners() {
    for (auto* runner : calibrate_->runners())
        connect(runner, &ProtocolWorkspace::attentionWanted, this, [this] { showPage(kCalibrate); });
    connect(safetyCheck_, &ProtocolWorkspace::attentionWanted, this, [this] { showPage(kSafetyCheck); });
    connect(separability_, &ProtocolWorkspace::attentionWanted, this, [this] { showPage(kSeparability); });
    connect(protocols_, &ProtocolWorkspace::attentionWanted, this, [this] { showPage(kProtocols); });
    for (auto* runner : runners()) {
        connect(runner, &ProtocolWorkspace::profileChangeWanted, live_, [this] { live_->editProfile(); });
        connect(runner, &ProtocolWorkspace::sessionWanted, this, &Workspaces::openFile);
        connect(runner, &ProtocolWorkspace::safetyCheckWanted, this, [this] { showPage(kSafetyCheck); });
        connect(runner, &ProtocolWorkspace::liveWanted, this, [this] { showPage(kLive); });
        connect(runner, &ProtocolWorkspace::plotOnlyWanted, this, &Workspaces::plotOnlyWanted);
        connect(runner, &ProtocolWorkspace::captured, this, &Workspaces::captured);
    }
}

void Workspaces::connectSessions() {
    connect(sessions_, &SessionsWorkspace::captureChosen, this, [this](std::shared_ptr<const Capture> capture) {
        scope_->show(std::move(capture));
        showLive(kScope);
    });
    connect(sessions_, &SessionsWorkspace::recordingReady, this, [this](const QString& folder) {
        if (live_->openRecording(folder)) showLive(kTouch);
    });
}

std::array<ProtocolWorkspace*, 5> Workspaces::runners() const {
    const auto [stimulator, sensor] = calibrate_->runners();
    return {stimulator, sensor, safetyCheck_, separability_, protocols_};
}

void Workspaces::showPage(int page) {
    if (page != kLive) complete();
    if (page < 0 || page >= count() || (pilot_ != nullptr && pilot_->blind() && page != kPilot)) return;
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
        const bool takesText = next->inherits("QLineEdit") || next->inherits("QAbstractSpinBox") ||
                               next->inherits("QPlainTextEdit") || next->inherits("QTextEdit");
        if (!page->isAncestorOf(next) || takesText || !next->isVisible() || !next->isEnabled()) continue;
        if ((next->focusPolicy() & Qt::TabFocus) != 0) return next->setFocus(Qt::ShortcutFocusReason);
    }
    page->setFocus(Qt::ShortcutFocusReason);  // nothing but text: the page itself
}

void Workspaces::showPlotOnly(bool only) {
    complete();
    for (auto* page : findChildren<TabbedPage*>()) page->setHeadVisible(!only);
    calibrate_->showPlotOnly(only);
    pilot_->showPlotOnly(only);
    live_->showPlotOnly(only);
    for (auto* runner : runners()) runner->showPlotOnly(only);
}

void Workspaces::refresh(const Telemetry& telemetry, bool measured) {
    letYield(*this, telemetry.state == InterlockState::Faulted);  // to Reset
    live_->refresh(telemetry, currentIndex() == kLive && !showsScope());
    if (measured || showsScope()) scope_->refresh(telemetry);
    if (!isComplete()) return;  // nothing runs where there is no page for it
    // One of them takes what a run says: the one it was started from, told apart by themselves.
    for (auto* protocol : runners()) protocol->refresh();
    pilot_->refresh(telemetry);
}

void Workspaces::openFile(const QString& path) {
    complete();
    const QFileInfo file(path);
    bool opened = false;
    if (file.isDir() || file.suffix() == "json") {
        opened = live_->openRecording(path);
        if (opened) showLive(kTouch);
    } else if (file.suffix() == "tacto") {
        opened = sessions_->openSession(path);
        if (opened) showPage(kSessions);
    } else if (captureFormats()->knowsSuffix(path.toStdString())) {
        opened = scope_->openCaptureFile(path);
        showLive(kScope);  // which also says why not
    } else {
        emit complained(tr("%1 is not a recording (a folder or recording.json), session (*.tacto) or capture (%2)")
                            .arg(path, ScopeFiles::captureGlobs()));
    }
    if (opened) rememberRecentFile(path);
}

}  // namespace tacto::gui

#include "moc_Workspaces.cpp"
