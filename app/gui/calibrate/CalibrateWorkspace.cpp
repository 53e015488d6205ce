#include "app/gui/calibrate/CalibrateWorkspace.h"

#include "app/gui/calibrate/CalibrationCard.h"
#include "app/gui/calibrate/CalibrationHistory.h"
#include "app/gui/runner/ProtocolWorkspace.h"
#include "app/gui/theme/Building.h"
#include "app/gui/theme/Pages.h"
#include "app/gui/theme/TabbedPage.h"

namespace tacto::gui {

CalibrateWorkspace::CalibrateWorkspace(BenchController& controller, CalibrationBook& book, QWidget* parent)
    : QWidget(parent), controller_(controller), book_(book) {
    auto* column = columnIn(*this, 0);
    tabs_ = new TabbedPage(this);
    tabs_->setObjectName("calibratePages");
    runner_ = new ProtocolWorkspace(controller_, "stimulator-calibration", tabs_->room());
    sensor_ = new ProtocolWorkspace(controller_, "sensor-calibration", tabs_->room());
    auto* stored = new ScrollingPage(tabs_->room());
    stored->hold(buildStored(stored->viewport()));
    auto* tools = new QWidget(tabs_);
    auto* row = rowIn(*tools, -1, {0, 0, 8, 0});
    row->addStretch();
    row->addWidget(&runner_->plotKind());
    tabs_->addTab(runner_, tr("&Guided run"), tools);
    tabs_->addTab(sensor_, tr("Fingertip se&nsor"));
    tabs_->addTab(stored, tr("Over &time"));
    auto& bar = tabs_->bar();
    bar.setTabToolTip(kGuided, tr("Levels up and down, read from the oscilloscope; fit, uncertainty and verdict"));
    bar.setTabToolTip(kFingertip, tr("Rest, weights and reference surfaces: what R and the forces mean on this rig"));
    bar.setTabToolTip(kOverTime, tr("The state of the calibration today, and everything stored before"));
    column->addWidget(tabs_, 1);
    for (auto* runner : runners())
        connect(runner, &ProtocolWorkspace::attentionWanted, this,
                [this, runner] { tabs_->setCurrentIndex(runner == sensor_ ? kFingertip : kGuided); });
    connect(card_, &CalibrationCard::calibrateWanted, this, [this] { prepare("full"); });
    connect(card_, &CalibrationCard::checkWanted, this, [this] { prepare("check"); });
    const auto showHistory = [this] { history_->list(book_, card_->shown()); };
    connect(card_, &CalibrationCard::stimulatorChosen, this, showHistory);
    connect(&book_, &CalibrationBook::changed, this, showHistory);
    connect(&controller_, &BenchController::changed, this, &CalibrateWorkspace::showReady);
    connect(&controller_, &BenchController::finished, this, &CalibrateWorkspace::showReady);
    connect(runner_, &ProtocolWorkspace::readyChanged, this, &CalibrateWorkspace::showReady);
    // A calibration is normally stored, so the form proposes storing it.
    connect(runner_, &ProtocolWorkspace::declaredAnew, this, [this] {
        runner_->propose("store", "true");
        showReady();
    });
    showHistory();
    showReady();
}

QWidget* CalibrateWorkspace::buildStored(QWidget* in) {
    auto* stored = new QWidget(in);
    auto* column = new QVBoxLayout(stored);
    card_ = new CalibrationCard(book_, stored);
    column->addWidget(card_);
    history_ = new CalibrationHistory(stored);
    column->addWidget(history_, 1);
    return stored;
}

/// Opens the settings; the operator then starts the run with the button there.
void CalibrateWorkspace::prepare(const QString& mode) {
    tabs_->setCurrentIndex(kGuided);
    runner_->propose("mode", mode);
    runner_->goTo(kSettings);
}

void CalibrateWorkspace::showPlotOnly(bool only) { tabs_->setHeadVisible(!only); }

void CalibrateWorkspace::showReady() {
    const bool busy = controller_.activity() == Activity::Running || controller_.activity() == Activity::Opening;
    card_->setReady(runner_->ready() && !busy);
}

}  // namespace tacto::gui

#include "moc_CalibrateWorkspace.cpp"
