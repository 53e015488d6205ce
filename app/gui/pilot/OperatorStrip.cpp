#include "app/gui/pilot/OperatorStrip.h"

#include <QHBoxLayout>
#include <QVBoxLayout>

#include "app/gui/pilot/ParticipantStop.h"
#include "app/gui/theme/Building.h"
#include "app/gui/theme/ConfirmButton.h"
#include "app/gui/theme/Labels.h"
#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {
constexpr int kStripStop_px = 37, kStripKeys_px = 12, kStripStopWide = 160;
}

OperatorStrip::OperatorStrip(QWidget* parent)
    : QFrame(parent),
      where_(new ElidedLabel(this)),
      ask_(new OperatorAsk(this)),
      notes_(new SessionNotes(this)),
      break_(new QPushButton(this)) {
    nameWidget(*this, "operatorStrip", tr("Operator"));
    setAutoFillBackground(true);
    setBackgroundRole(QPalette::Base);
    setFrameShape(QFrame::StyledPanel);
    auto* both = new QHBoxLayout(this);
    auto* column = new QVBoxLayout;
    both->addLayout(column, 1);
    auto* stop = new ParticipantStop([this] { emit stopWanted(); }, this);
    stop->setObjectName("operatorStop");
    stop->setOperators();
    stop->setType(scaledPx(kStripStop_px), scaledPx(kStripKeys_px));
    fixWidth(*stop, kStripStopWide);
    both->addWidget(stop);
    auto* row = new QHBoxLayout;
    row->setSpacing(8);
    setTextSize(*where_, TextSize::Body, true);
    row->addWidget(where_, 1);
    break_->setAutoDefault(false);
    connect(break_, &QPushButton::clicked, this, [this] { emit breakWanted(!due_); });
    auto* abort = new ConfirmButton(tr("End the session"), this);
    connect(abort, &QPushButton::clicked, this, &OperatorStrip::abortWanted);
    auto* close = new QPushButton(tr("Close (F2)"), this);
    close->setAutoDefault(false);
    connect(close, &QPushButton::clicked, this, &OperatorStrip::closeWanted);
    for (auto* button : {break_, static_cast<QPushButton*>(abort), close}) row->addWidget(button);
    column->addLayout(row);
    addAll(*column, {ask_, notes_});
    setBreakDue(false);
}

void OperatorStrip::setWhere(const QString& where) { where_->setText(where); }

void OperatorStrip::setBreakDue(bool due) {
    due_ = due;
    break_->setText(due ? tr("End the break") : tr("Break after this trial"));
}

}  // namespace tacto::gui

#include "moc_OperatorStrip.cpp"
