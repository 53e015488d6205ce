#include "app/gui/scope/ScopeEmpty.h"

#include <QPushButton>
#include <QVBoxLayout>

namespace tacto::gui {

ScopeEmpty::ScopeEmpty(QWidget* parent)
    : EmptyState(tr("The oscilloscope shows and measures what really arrives at the electrodes.\n"
                    "No bench is open, and no capture is loaded."),
                 tr("Open the simulated bench"), parent),
      problem_(new TroubleLine("scopeProblem", this)) {
    auto* open = new QPushButton(tr("Open a capture…"), this);
    open->setToolTip(tr("As this program, an oscilloscope or sigrok saved it: CSV, ISF, WAV or .sr."));
    connect(open, &QPushButton::clicked, this, &ScopeEmpty::openClicked);
    auto* column = static_cast<QVBoxLayout*>(layout());
    column->insertWidget(column->count() - 1, open, 0, Qt::AlignCenter);
    problem_->setAlignment(Qt::AlignCenter);
    column->insertWidget(column->count() - 1, problem_);
}

void ScopeEmpty::setProblem(const QString& problem) { problem_->say(problem); }

}  // namespace tacto::gui

#include "moc_ScopeEmpty.cpp"
