// The menus of MainWindow, and what only they do.
#include <QApplication>
#include <QMenuBar>
#include <QMessageBox>
#include <QSettings>

#include "app/gui/calibrate/CertificateDialog.h"
#include "app/gui/live/LiveWorkspace.h"
#include "app/gui/look/Dialogs.h"
#include "app/gui/window/DeviceDock.h"
#include "app/gui/window/ExposureDock.h"
#include "app/gui/window/HelpWindow.h"
#include "app/gui/window/MainWindow.h"
#include "app/gui/window/RecordingLine.h"
#include "app/gui/window/Tour.h"
#include "app/scripting/ProtocolLibrary.h"

namespace tacto::gui {

void MainWindow::buildMenus() {
    auto* file = menuBar()->addMenu(tr("&File"));
    file->addAction(tr("&Open…"), QKeySequence::Open, this, &MainWindow::chooseFile);
    file->addAction(tr("Open &recording folder…"), this, &MainWindow::chooseRecording);
    file->addAction(tr("Open the &example recording"), this, [this] {
        if (const auto resources = resourcesFolder())
            openFile(QString::fromStdString((*resources / "examples" / "linen-slide").string()));
    });
    recent_ = file->addMenu(tr("Re&cent"));
    connect(recent_, &QMenu::aboutToShow, this, &MainWindow::fillRecent);
    file->addSeparator();
    file->addAction(tr("&Quit"), QKeySequence(Qt::CTRL | Qt::Key_Q), this, &QWidget::close);
    buildBenchMenu();
    buildViewMenu();
    buildHelpMenu();
}

void MainWindow::fillRecent() {
    recent_->clear();
    const auto files = QSettings().value("recent").toStringList();
    for (const auto& path : files) recent_->addAction(path, this, [this, path] { openFile(path); });
    if (files.isEmpty()) recent_->addAction(tr("nothing yet"))->setEnabled(false);
}

void MainWindow::buildBenchMenu() {
    auto* bench = menuBar()->addMenu(tr("&Bench"));
    bench->addAction(tr("Open &simulated bench"), QKeySequence(Qt::CTRL | Qt::Key_B), this,
                     &MainWindow::openSimulatedBench);
    bench->addAction(tr("Simulated bench with &faults…"), this, &MainWindow::askForSimulatedBench);
    bench->addAction(tr("&Close"), &desk_, &BenchDesk::close);
    bench->addAction(tr("Oscilloscope cer&tificates…"), this,
                     [this] { openDialog(new CertificateDialog(desk_, this)); });
    bench->addSeparator();
    bench->addAction(tr("&Arm…"), QKeySequence(Qt::CTRL | Qt::SHIFT | Qt::Key_A), this, &MainWindow::askToArm);
    bench->addAction(tr("&Disarm"), &desk_, &BenchDesk::disarm);
    bench->addAction(tr("&Pause"), &desk_, &BenchDesk::pause);
    bench->addAction(tr("Res&ume"), &desk_, &BenchDesk::resume);
    bench->addAction(tr("&Reset fault"), &desk_, &BenchDesk::resetFault);
    bench->addAction(tr("Check &impedance"), this, &MainWindow::checkImpedance);
    bench->addSeparator();
    bench->addAction(tr("STOP (Esc)"), this, [this] { desk_.stop("operator (menu)"); });
}

void MainWindow::setTheme(Theme theme) {
    applyTheme(theme);
    QSettings().setValue("theme", theme == Theme::Dark ? "dark" : "light");
}

void MainWindow::buildViewMenu() {
    auto* view = menuBar()->addMenu(tr("&View"));
    for (auto* action : navigation_->actions()) view->addAction(action);
    view->addSeparator();
    view->addAction(devices_->toggleViewAction());
    view->addAction(measurements_->toggleViewAction());
    view->addAction(exposure_->toggleViewAction());
    view->addAction(tr("&Messages"), line_, &RecordingLine::showLog);
    view->addSeparator();
    view->addAction(tr("&Light"), this, [this] { setTheme(Theme::Light); });
    view->addAction(tr("&Dark"), this, [this] { setTheme(Theme::Dark); });
    auto* size = view->addMenu(tr("&Text size"));
    for (const int percent : {100, 125, 150, 200})
        size->addAction(tr("%1 %").arg(percent), this, [this, percent] {
            QSettings().setValue("textSize", percent);
            applyTextSize(percent);
            line_->say(tr("Text at %1 %. Everything has its best place when the window is opened again.").arg(percent));
        });
    view->addAction(tr("&Full screen"), QKeySequence(Qt::Key_F11), this,
                    [this] { setWindowState(windowState() ^ Qt::WindowFullScreen); });
}

void MainWindow::buildHelpMenu() {
    auto* help = menuBar()->addMenu(tr("&Help"));
    help->addAction(tr("&Explain what has the focus"), QKeySequence(Qt::Key_F1), this, [this] { explainFocus(this); });
    help->addAction(tr("&Keys"), QKeySequence(Qt::Key_Question), this, [this] { openDialog(makeShortcutSheet(this)); });
    help->addAction(tr("&Definitions and limits"), this, [this] { openDialog(makeHelpWindow(desk_.limits(), this)); });
    help->addAction(tr("&Tour"), this, &MainWindow::beginTour);
    help->addSeparator();
    help->addAction(tr("&About Tactoscope"), this, [this] {
        auto* about = new QMessageBox(
            QMessageBox::NoIcon, tr("About Tactoscope"),
            tr("<h3>Tactoscope %1</h3><p>A desktop bench for tactile-feedback stimulation.</p><p><b>Not a medical "
               "device.</b> A research bench, not certified. Its drivers for hardware "
               "have been tried on emulated devices only.</p>"
               "<p>GPL-3.0-or-later</p>")
                .arg(TACTOSCOPE_VERSION),
            QMessageBox::Close, this);
        openDialog(about);
    });
}

void MainWindow::buildTour() {
    std::vector<TourStep> steps{
        {tr("Welcome"),
         tr("This bench turns what a fingertip feels into pulse trains: texture into amplitude, pressure into the "
            "interval. The tour runs on simulated devices and cannot touch anybody. Esc switches the output off at any "
            "time, here too."),
         "",
         {}},
        {tr("Open the simulated bench"),
         tr("A fingertip, a stimulator on 1 kΩ and an oscilloscope. What is present and what is open stands in the "
            "Devices dock at the right."),
         tr("&Open it"), [this] { openSimulatedBench(); }},
        {tr("Slide over a surface"),
         tr("Acceleration, force and taxels become roughness R and pressure P: the point in the tactile plane."),
         tr("&Slide over P120"),
         [this] {
             showWorkspace(0);
             desk_.present("P120", 50, 1);
         }},
        {tr("Arm, in two steps"),
         tr("The first opens a question, the second measures the load with one small pulse. Then let the fingertip "
            "drive. The bars at the top show how far each limit is."),
         tr("&Arm…"), [this] { askToArm(); }},
        {tr("Run a protocol"),
         tr("Separability asks whether an oscilloscope can tell the four conditions apart, and writes a report. Every "
            "run is in Sessions."),
         tr("&Show it"), [this] { showWorkspace(3); }},
    };
    tour_ = new Tour(std::move(steps), this);
    connect(tour_, &Tour::ended, this, [] { QSettings().setValue("tourDone", true); });
}

void MainWindow::beginTour() { tour_->begin(); }

}  // namespace tacto::gui
