#include "app/gui/runner/ProcedurePath.h"

#include <utility>

#include "app/gui/runner/LimitMatrixView.h"
#include "app/gui/runner/ProtocolHead.h"
#include "app/gui/runner/RunPanel.h"
#include "app/gui/runner/StepList.h"
#include "app/gui/runner/WiringPanel.h"
#include "app/gui/theme/Building.h"
#include "app/gui/theme/FieldForm.h"
#include "app/gui/theme/Pages.h"
#include "app/gui/theme/Theme.h"
#include "app/gui/theme/ToolRow.h"
#include "app/report/NumberText.h"
#include "app/report/TableContent.h"

namespace tacto::gui {

namespace {

constexpr int kPathWidth = 240, kPathPad = 16;
constexpr int kMinColumn = 480;     // of a column with head, six steps, a sentence and Run
constexpr int kMaxRoomDivisor = 3;  // the column takes at most 1/kMaxRoomDivisor of the width

}  // namespace

ProcedurePath::ProcedurePath(bool chooses, QWidget* parent)
    : QWidget(parent),
      head_(new ProtocolHead(chooses, this)),
      steps_(new StepList({tr("Wiring"), tr("Known reference"), tr("Settings"), tr("Run"), tr("Result"), tr("Sign")},
                          this)),
      legend_(new CellLegend(this)),
      panel_(new RunPanel(this)) {
    setObjectName("path");
    setAttribute(Qt::WA_StyledBackground);
    legend_->hide();
    layDown();
    onEvent(*this, QEvent::Resize, [this] { steps_->fit(); });
}

void ProcedurePath::layDown() {
    setMinimumHeight(0);
    setFixedWidth(scaledPx(kPathWidth));
    setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Preferred);
    auto* column = columnIn(*this, -1, {0, kPathPad / 2, 0, kPathPad / 2});
    const auto addPadded = [&](QWidget* part) {
        auto* padded = new QVBoxLayout;
        padded->setContentsMargins(kPathPad, 0, kPathPad, 0);
        padded->addWidget(part);
        column->addLayout(padded);
    };
    addPadded(head_);
    column->addWidget(steps_);
    column->addStretch();
    addPadded(panel_);
}

/// Places head, steps and controls in one line, or in two if too long; a head with a chooser has its own line. The
/// obstacle to a run is shown below.
void ProcedurePath::layAcross() {
    setMinimumWidth(0);
    setMaximumWidth(QWIDGETSIZE_MAX);
    setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Fixed);
    auto* rows = columnIn(*this, 0, {0, 0, kPathPad, 0});
    auto* controls = new QHBoxLayout;
    controls->setSpacing(kPathPad);
    auto* line = new TurningRow(
        [this, controls] { return steps_->minimumSizeHint().width() + kPathPad + controls->minimumSize().width(); });
    line->setSpacing(0);
    connect(line, &TurningRow::turned, this,
            [controls](bool beside) { controls->setContentsMargins(kPathPad, 0, 0, beside ? 0 : kPathPad / 2); });
    controls->setContentsMargins(kPathPad, 0, 0, 0);
    const auto padded = [&](QWidget* part) {
        auto* inset = new QHBoxLayout;
        inset->setContentsMargins(kPathPad, 0, 0, 0);
        inset->addWidget(part);
        rows->addLayout(inset);
    };
    line->addWidget(steps_);
    if (head_->chooses()) {
        padded(head_);
        controls->addStretch(1);
    } else {
        controls->addWidget(head_, 1);
    }
    controls->addWidget(panel_);
    line->addLayout(controls, 1);
    rows->addLayout(line);
    padded(&panel_->words());
}

bool ProcedurePath::fit(QSize room) {
    const bool low = room.height() < scaledPx(kMinColumn);
    const bool across = low || scaledPx(kPathWidth) * kMaxRoomDivisor > room.width();
    if (std::exchange(across_, across) != across) {
        delete layout();
        head_->setAcross(across);
        steps_->setAcross(across);
        panel_->setAcross(across);
        across ? layAcross() : layDown();
    } else if (!across) {
        setFixedWidth(scaledPx(kPathWidth));
    }
    return across;
}

void ProcedurePath::showNoRun(bool hasReference) {
    steps_->setStepVisible(kReference, hasReference);
    for (const auto step : {kRun, kResult, kSign}) {
        steps_->setState(step, StepList::State::ToDo);
        steps_->setNote(step, {});
    }
    steps_->setOutOfReach(kRun, tr("Nothing has run yet: press Run."));
    steps_->setOutOfReach(kResult, tr("There is no result yet: press Run."));
    panel_->setLeading(true);
}

void ProcedurePath::showSetup(FieldForm& form, const WiringPanel& wiring, bool declared, bool begun,
                              const std::set<Step>& seen) {
    using State = StepList::State;
    const auto state = [&](Step step, bool troubled) {
        return troubled ? State::Troubled : begun || seen.contains(step) ? State::Done : State::ToDo;
    };
    steps_->setState(kWiring, state(kWiring, !wiring.refused().isEmpty()));
    steps_->setNote(kWiring, wiring.devices() == "sim:" ? tr("simulated bench") : wiring.devices());
    steps_->setState(kReference, state(kReference, form.refused(true) > 0));
    const auto load = form.text("reference").isEmpty() ? form.text("load") : form.text("reference");
    bool isNumber = false;
    const double ohms = load.toDouble(&isNumber);
    steps_->setNote(kReference, isNumber ? settingText(ohms, "ohm") : loadText(load));
    const int refused = form.refused(false);
    const bool troubled = refused > 0 || !declared;
    steps_->setState(kSettings, troubled ? State::Troubled : begun ? State::Done : State::UnderWay);
    steps_->setNote(kSettings, refused > 0 ? tr("%1 to fix").arg(refused) : declared ? form.summary() : QString());
}

void ProcedurePath::showRun() {
    panel_->setLeading(true);
    panel_->begin();
    steps_->setState(kSettings, StepList::State::Done);
    steps_->setState(kRun, StepList::State::UnderWay);
    steps_->setOutOfReach(kRun, {});
    steps_->setState(kResult, StepList::State::ToDo);
    steps_->setOutOfReach(kResult, tr("There is no result yet: the run is not finished."));
    for (const auto step : {kRun, kResult}) steps_->setNote(step, {});
}

void ProcedurePath::showEnd(bool early, std::optional<Seconds> benchTime) {
    panel_->end(early, benchTime);
    panel_->setLeading(false);
    steps_->setState(kRun, early ? StepList::State::Troubled : StepList::State::Done);
    steps_->setState(kResult, StepList::State::Done);
    steps_->setOutOfReach(kResult, {});
}

void ProcedurePath::showLegend(bool legend) {
    legendWanted_ = legend;
    fitLegend();
}

/// Places the legend between the steps and the Run button, in no layout, so that the page does not grow higher.
void ProcedurePath::fitLegend() {
    const int top = steps_->geometry().bottom() + 1 + kPathPad / 2, high = legend_->sizeHint().height();
    const bool fits = !across_ && panel_->geometry().top() - top >= high;
    legend_->setGeometry(kPathPad, top, width() - 2 * kPathPad, high);
    legend_->setVisible(legendWanted_ && fits);
}

/// Wrapped text may need more height than the layout's minimum: the page then scrolls, and nothing is cut.
bool ProcedurePath::event(QEvent* event) {
    const bool done = QWidget::event(event);
    const auto* parts = layout();  // null while the layout is replaced
    if (parts != nullptr && (event->type() == QEvent::LayoutRequest || event->type() == QEvent::Resize))
        setMinimumHeight(across_ ? wholeHeightAt(*parts, width()) : leastHeightAt(*parts, width()));
    if (event->type() == QEvent::LayoutRequest || event->type() == QEvent::Resize) fitLegend();
    return done;
}

}  // namespace tacto::gui

#include "moc_ProcedurePath.cpp"
