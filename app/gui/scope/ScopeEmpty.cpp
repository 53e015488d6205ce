#include "app/gui/scope/ScopeEmpty.h"

#include <QPushButton>
#include <QVBoxLayout>

namespace tacto::gui {

ScopeEmpty::ScopeEmpty(QWidget* parent)
    : EmptyState(tr("The oscilloscope shows and measures what really arrives at the electrodes.\n"
                    "No bench is open, and no capture is loaded."),
                 tr("Open the simulated bench"), parent) {
    auto* open = new QPushButton(tr("Open a capture…"), this);
    open->setToolTip(tr("A CSV file with time_s and a column per channel, as this program saves them."));
    connect(open, &QPushButton::clicked, this, &ScopeEmpty::openClicked);
    auto* column = static_cast<QVBoxLayout*>(layout());
    column->insertWidget(column->count() - 1, open, 0, Qt::AlignCenter);
}

}  // namespace tacto::gui

#include "moc_ScopeEmpty.cpp"
