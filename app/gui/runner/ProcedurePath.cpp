#include "app/gui/runner/ProcedurePath.h"

#include <QVBoxLayout>

#include "app/gui/runner/ProcedurePages.h"
#include "app/gui/runner/ProtocolHead.h"
#include "app/gui/runner/RunPanel.h"
#include "app/gui/runner/StepList.h"
#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {

constexpr int kPathWidth = 240, kPathPad = 16;

}  // namespace

ProcedurePath::ProcedurePath(bool chooses, QWidget* parent)
    : QWidget(parent),
      head_(new ProtocolHead(chooses, this)),
      steps_(new StepList({tr("Wiring"), tr("Known reference"), tr("Settings"), tr("Run"), tr("Result"), tr("Sign")},
                          this)),
      panel_(new RunPanel(this)) {
    setObjectName("path");
    setFixedWidth(scaledPx(kPathWidth));
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, kPathPad / 2, 0, kPathPad / 2);
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

void ProcedurePath::showRun() {
    panel_->setLeading(true);
    panel_->begin();
    steps_->setState(kSettings, StepList::State::Done);
    steps_->setState(kRun, StepList::State::UnderWay);
    steps_->setOutOfReach(kRun, {});
    steps_->setState(kResult, StepList::State::ToDo);
    steps_->setOutOfReach(kResult, tr("There is no result yet: the run goes on."));
    for (const auto step : {kRun, kResult}) steps_->setNote(step, {});
}

void ProcedurePath::showEnd(bool early) {
    panel_->end(early);
    panel_->setLeading(false);
    steps_->setState(kRun, early ? StepList::State::Troubled : StepList::State::Done);
    steps_->setState(kResult, StepList::State::Done);
    steps_->setOutOfReach(kResult, {});
}

void ProcedurePath::resizeEvent(QResizeEvent* event) {
    QWidget::resizeEvent(event);
    steps_->fit();
}

}  // namespace tacto::gui
