#include "app/gui/window/Menus.h"

#include <QActionGroup>
#include <QMenu>
#include <QMenuBar>
#include <QMessageBox>
#include <QSettings>

#include "app/gui/calibrate/CertificateDialog.h"
#include "app/gui/theme/Dialogs.h"
#include "app/gui/window/DockColumn.h"
#include "app/gui/window/FileMenu.h"
#include "app/gui/window/HelpWindow.h"
#include "app/gui/window/MainWindow.h"
#include "app/gui/window/RecordingLine.h"
#include "app/gui/window/SafetyBar.h"
#include "app/gui/window/StateWords.h"
#include "app/gui/window/StopButton.h"
#include "app/gui/window/Workspaces.h"
#include "core/base/ProgramVersion.h"

namespace tacto::gui {

Menus::Menus(MainWindow& window, const QActionGroup& workspaces, DockColumn& docks, RecordingLine& line)
    : QObject(&window), window_(window), line_(line) {
    new FileMenu(window_, *window_.findChild<Workspaces*>(), line_);
    addBench();
    addView(workspaces, docks);
    addHelp();
    // The menus' keys also work while the menu bar is hidden.
    for (const auto* menu : window_.menuBar()->actions()) {
        for (auto* action : menu->menu()->actions())
            if (!action->shortcut().isEmpty()) window_.addAction(action);
    }
}

void Menus::addBench() {
    auto* bench = window_.menuBar()->addMenu(tr("&Bench"));
    auto* controller = &window_.controller();
    bench->addAction(tr("Open &simulated bench"), QKeySequence(Qt::CTRL | Qt::Key_B), &window_,
                     &MainWindow::openSimulatedBench);
    bench->addAction(tr("Simulated bench with &faults…"), &window_, &MainWindow::askForSimulatedBench);
    auto* close = bench->addAction(tr("&Close"), controller, &BenchController::close);
    bench->addAction(tr("Oscilloscope cer&tificates…"), &window_,
                     [this] { openDialog(new CertificateDialog(window_.controller(), &window_)); });
    bench->addSeparator();
    auto* arm =
        bench->addAction(tr("&Arm…"), QKeySequence(Qt::CTRL | Qt::SHIFT | Qt::Key_A), &window_, &MainWindow::askToArm);
    auto* disarm = bench->addAction(tr("&Disarm"), controller, &BenchController::disarm);
    auto* pause = bench->addAction(tr("&Pause"), &window_, [this] { window_.safetyBar().holdOutput(true); });
    auto* resume = bench->addAction(tr("Res&ume"), &window_, [this] { window_.safetyBar().holdOutput(false); });
    auto* reset = bench->addAction(tr("&Reset fault"), &window_, [this] { window_.safetyBar().resetFault(); });
    auto* check = bench->addAction(tr("Check &impedance"), &window_, &MainWindow::checkImpedance);
    bench->setToolTipsVisible(true);
    // The entries follow the output's state at the time the menu opens.
    const auto follow = [=, this](bool opens) {
        const auto activity = controller->activity();
        const auto state = controller->telemetry().state;
        const auto grave = SafetyBar::whyNoReset(controller->telemetry());
        const auto closed = activity == Activity::Closed ? tr("No bench is open.") : QString();
        const auto taken = activity == Activity::Running ? tr("A run has the bench.") : closed;
        const auto unless = [opens](const QString& first, bool possible, const QString& why) {
            return opens && first.isEmpty() && !possible ? why : first;
        };
        const std::pair<QAction*, QString> whyNot[] = {
            {close, taken},
            {arm, taken},
            {check, taken},
            {disarm, unless(closed, isOn(state), tr("The output is not armed."))},
            {pause, unless(closed, window_.safetyBar().canHold(true), tr("Nothing is delivered."))},
            {resume, unless(closed, window_.safetyBar().canHold(false), tr("Nothing is paused."))},
            {reset, unless(unless(taken, state == InterlockState::Faulted, tr("There is no fault.")), grave.isEmpty(),
                           grave)}};
        for (const auto& [action, why] : whyNot) {
            action->setEnabled(why.isEmpty());
            action->setToolTip(why);
        }
    };
    connect(bench, &QMenu::aboutToShow, this, [follow] { follow(true); });
    connect(bench, &QMenu::aboutToHide, this, [follow] { follow(false); });
    connect(controller, &BenchController::changed, this, [follow, bench] { follow(bench->isVisible()); });
    follow(false);
    bench->addSeparator();
    auto* mark = bench->addAction(tr("&Mark this moment…"), QKeySequence(Qt::CTRL | Qt::Key_M), &window_,
                                  &MainWindow::markMoment);
    mark->setAutoRepeat(false);
    mark->setShortcutContext(Qt::ApplicationShortcut);  // works in any window, because the moment passes quickly
    bench->addAction(tr("&Operator and sample…"), &window_, [this] { window_.askForDay(false); });
    bench->addSeparator();
    bench->addAction(tr("STOP (Esc)"), &window_, [controller] { controller->stop("operator (menu)"); });
}

void Menus::addView(const QActionGroup& workspaces, DockColumn& docks) {
    auto* view = window_.menuBar()->addMenu(tr("&View"));
    for (auto* action : workspaces.actions()) view->addAction(action);
    view->addSeparator();
    view->addAction(docks.toggle());
    for (auto* dock : docks.docks())
        view->addAction(dock->windowTitle(), &docks, [&docks, dock] { docks.show(*dock); });
    view->addAction(tr("&Messages"), &line_, &RecordingLine::showLog);
    view->addSeparator();
    addLooks(*view);
    auto* plotOnly = view->addAction(tr("Plot &only"), QKeySequence(Qt::Key_F11), &window_, &MainWindow::showPlotOnly);
    plotOnly->setCheckable(true);
    plotOnly->setObjectName("plotOnly");
    view->addAction(tr("&Full screen"), QKeySequence(Qt::SHIFT | Qt::Key_F11), &window_,
                    [this] { window_.setWindowState(window_.windowState() ^ Qt::WindowFullScreen); });
    auto* above = view->addAction(tr("STOP above other windows"), &window_, &MainWindow::showSmallStop);
    above->setObjectName("smallStopShown");
    above->setCheckable(true);
    if (!SmallStop::staysAbove()) {
        above->setEnabled(false);
        above->setText(tr("STOP above other windows (not on Wayland)"));
    }
    view->addAction(tr("Reset la&yout"), &window_, &MainWindow::resetLayout);
}

/// Theme and text size; each has a tick at what is set.
void Menus::addLooks(QMenu& view) {
    auto* size = new QMenu(tr("&Text size"), &view);
    auto *themes = new QActionGroup(this), *sizes = new QActionGroup(this);
    const auto add = [this](QMenu& menu, QActionGroup& group, const QString& text, bool set, auto task) {
        auto* action = menu.addAction(text, &window_, task);
        action->setCheckable(true);
        action->setChecked(set);
        group.addAction(action);
        return action;
    };
    for (const auto& [text, theme] : {std::pair(tr("&Light"), Theme::Light), {tr("&Dark"), Theme::Dark}}) {
        auto* action = add(view, *themes, text, false, [this, theme] { window_.setTheme(theme); });
        connect(&view, &QMenu::aboutToShow, action, [action, theme] { action->setChecked(currentTheme() == theme); });
    }
    view.addMenu(size);
    const int now = QSettings().value("textSize", MainWindow::kUsualText).toInt();
    for (const int percent : {MainWindow::kUsualText, 125, 150, 200})
        add(*size, *sizes, tr("%1 %").arg(percent), percent == now, [this, percent] {
            window_.setTextPercent(percent);
            line_.say(tr("Text at %1 %.").arg(percent));
        });
}

void Menus::addHelp() {
    auto* help = window_.menuBar()->addMenu(tr("&Help"));
    const auto open = [this](const QString& page) { openGuide(window_.controller().limits(), page, &window_); };
    help->addAction(tr("&Guide"), QKeySequence(Qt::Key_F1), &window_,
                    [this, open] { open(guidePageOf(*window_.findChild<Workspaces*>())); });
    help->addAction(tr("&Explain what has the focus"), QKeySequence(Qt::SHIFT | Qt::Key_F1), &window_,
                    [this] { explainFocus(&window_); });
    help->addAction(tr("&Keys"), QKeySequence(Qt::Key_Question), &window_, [open] { open("keys.md"); });
    help->addAction(tr("&Definitions and limits"), &window_, [open] { open("definitions.md"); });
    help->addAction(tr("&Tour"), &window_, &MainWindow::beginTour);
    help->addSeparator();
    help->addAction(tr("&About Tactoscope"), this, &Menus::showAbout);
}

void Menus::showAbout() {
    openDialog(new QMessageBox(
        QMessageBox::NoIcon, tr("About Tactoscope"),
        tr("<h3>Tactoscope %1</h3><p>A desktop bench for tactile-feedback stimulation.</p><p><b>Not a medical "
           "device.</b> A research bench, not certified. Its drivers for hardware "
           "have been tried on emulated devices only.</p>"
           "<p>GPL-3.0-or-later</p>")
            .arg(programVersion().version),
        QMessageBox::Close, &window_));
}

}  // namespace tacto::gui

#include "moc_Menus.cpp"
