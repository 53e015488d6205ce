#include "app/gui/calibrate/CalibrateWorkspace.h"

#include <QHBoxLayout>
#include <QTabBar>
#include <QVBoxLayout>

#include "app/gui/calibrate/CalibrationCard.h"
#include "app/gui/calibrate/CalibrationHistory.h"
#include "app/gui/runner/ProtocolWorkspace.h"

namespace tacto::gui {

namespace {

constexpr int kToolsRight = 16;

/// As high as the window leaves it: a page whose labels wrap would ask for all that its plot likes to have, and what
/// stands below the plot would be out of sight.
class PageTabs final : public QTabWidget {
public:
    using QTabWidget::QTabWidget;
    [[nodiscard]] bool hasHeightForWidth() const override { return false; }
};

/// At the right of the row of tabs, as high as they are.
class TabTools final : public QWidget {
public:
    explicit TabTools(QTabWidget* tabs) : QWidget(tabs), tabs_(tabs) {
        setObjectName("tabTools");
        setAttribute(Qt::WA_StyledBackground);
    }
    [[nodiscard]] QSize sizeHint() const override {
        return {QWidget::sizeHint().width(), tabs_->tabBar()->sizeHint().height()};
    }

private:
    QTabWidget* tabs_;
};

}  // namespace

CalibrateWorkspace::CalibrateWorkspace(BenchController& controller, CalibrationBook& book, QWidget* parent)
    : QWidget(parent), controller_(controller), book_(book) {
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    tabs_ = new PageTabs(this);
    tabs_->setObjectName("calibratePages");
    tabs_->setDocumentMode(true);
    tabs_->setWhatsThis(tr("The pages of this workspace. The left and right arrow keys change the page."));
    runner_ = new ProtocolWorkspace(controller_, "stimulator-calibration", tabs_);
    sensor_ = new ProtocolWorkspace(controller_, "sensor-calibration", tabs_);
    stored_ = new QWidget(tabs_);
    auto* inner = new QVBoxLayout(stored_);
    card_ = new CalibrationCard(book_, stored_);
    inner->addWidget(card_);
    history_ = new CalibrationHistory(stored_);
    inner->addWidget(history_, 1);
    tabs_->addTab(runner_, tr("&Guided run"));
    tabs_->setTabToolTip(0, tr("Levels up and down, read from the oscilloscope; fit, uncertainty and verdict"));
    tabs_->addTab(sensor_, tr("Fingertip se&nsor"));
    tabs_->setTabToolTip(1, tr("Rest, weights and reference surfaces: what R and the forces mean on this rig"));
    tabs_->addTab(stored_, tr("S&tored calibrations"));
    tabs_->setTabToolTip(2, tr("The state of the calibration today, and everything stored before"));
    auto* tools = new TabTools(tabs_);
    auto* row = new QHBoxLayout(tools);
    row->setContentsMargins(0, 0, kToolsRight, 0);
    row->addWidget(&runner_->plotKind());
    tabs_->setCornerWidget(tools);
    setTabOrder(tabs_->tabBar(), &runner_->plotKind());
    column->addWidget(tabs_, 1);
    for (int page = 0; page < tabs_->count(); ++page) tabKeys_.add(tabs_->tabText(page));
    for (auto* runner : runners())
        connect(runner, &ProtocolWorkspace::attentionWanted, this, [this, runner] { tabs_->setCurrentWidget(runner); });
    connect(card_, &CalibrationCard::calibrateWanted, this, [this] { prepare("full"); });
    connect(card_, &CalibrationCard::checkWanted, this, [this] { prepare("check"); });
    const auto showHistory = [this] { history_->list(book_, card_->shown()); };
    connect(card_, &CalibrationCard::stimulatorChosen, this, showHistory);
    connect(&book_, &CalibrationBook::changed, this, showHistory);
    connect(&controller_, &BenchController::changed, this, &CalibrateWorkspace::showReady);
    connect(&controller_, &BenchController::finished, this, &CalibrateWorkspace::showReady);
    connect(runner_, &ProtocolWorkspace::readyChanged, this, &CalibrateWorkspace::showReady);
    // A calibration is made to be kept: here the form says so from the start.
    connect(runner_, &ProtocolWorkspace::declaredAnew, this, [this] {
        runner_->set("store", "true");
        showReady();
    });
    showHistory();
    showReady();
}

/// A run is started where its settings stand, by its own button.
void CalibrateWorkspace::prepare(const QString& mode) {
    tabs_->setCurrentWidget(runner_);
    runner_->set("mode", mode);
    runner_->goTo(kSettings);
}

void CalibrateWorkspace::showPlotOnly(bool only) {
    tabs_->tabBar()->setVisible(!only);
    tabKeys_.setEnabled(only);
}

void CalibrateWorkspace::showReady() {
    const bool busy = controller_.activity() == Activity::Running || controller_.activity() == Activity::Opening;
    card_->setReady(runner_->ready() && !busy);
}

}  // namespace tacto::gui

#include "moc_CalibrateWorkspace.cpp"
