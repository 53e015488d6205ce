#include "app/gui/calibrate/CalibrateWorkspace.h"

#include <QVBoxLayout>

#include "app/gui/calibrate/CalibrationCard.h"
#include "app/gui/calibrate/CalibrationHistory.h"
#include "app/gui/runner/ProtocolWorkspace.h"

namespace tacto::gui {

CalibrateWorkspace::CalibrateWorkspace(BenchDesk& desk, CalibrationBook& book, QWidget* parent)
    : QWidget(parent), desk_(desk), book_(book) {
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(2);
    card_ = new CalibrationCard(book_, this);
    column->addWidget(card_);
    tabs_ = new QTabWidget(this);
    tabs_->setObjectName("calibratePages");
    tabs_->setDocumentMode(true);
    runner_ = new ProtocolWorkspace(desk_, "stimulator-calibration", tabs_);
    sensor_ = new ProtocolWorkspace(desk_, "sensor-calibration", tabs_);
    history_ = new CalibrationHistory(tabs_);
    tabs_->addTab(runner_, tr("&Guided run"));
    tabs_->setTabToolTip(0, tr("Levels up and down, read from the oscilloscope; fit, uncertainty and verdict"));
    tabs_->addTab(sensor_, tr("Fingertip se&nsor"));
    tabs_->setTabToolTip(1, tr("Rest, weights and reference surfaces: what R and the forces mean on this rig"));
    tabs_->addTab(history_, tr("S&tored calibrations"));
    column->addWidget(tabs_, 1);
    for (auto* runner : runners())
        connect(runner, &ProtocolWorkspace::attentionWanted, this, [this, runner] { tabs_->setCurrentWidget(runner); });
    connect(card_, &CalibrationCard::calibrateWanted, this, [this] { run("full"); });
    connect(card_, &CalibrationCard::checkWanted, this, [this] { run("check"); });
    const auto showHistory = [this] { history_->list(book_, card_->shown()); };
    connect(card_, &CalibrationCard::stimulatorChosen, this, showHistory);
    connect(&book_, &CalibrationBook::changed, this, showHistory);
    connect(&desk_, &BenchDesk::changed, this, &CalibrateWorkspace::showReady);
    connect(&desk_, &BenchDesk::finished, this, &CalibrateWorkspace::showReady);
    connect(runner_, &ProtocolWorkspace::readyChanged, this, &CalibrateWorkspace::showReady);
    // A calibration is made to be kept: here the form says so from the start.
    connect(runner_, &ProtocolWorkspace::declaredAnew, this, [this] {
        runner_->set("store", "true");
        showReady();
    });
    showHistory();
    showReady();
}

void CalibrateWorkspace::run(const QString& mode) {
    tabs_->setCurrentWidget(runner_);
    runner_->set("mode", mode);
    runner_->runAsked();
    showReady();
}

void CalibrateWorkspace::showReady() {
    const bool busy = desk_.activity() == Activity::Running || desk_.activity() == Activity::Opening;
    card_->setReady(runner_->ready() && !busy);
}

}  // namespace tacto::gui
