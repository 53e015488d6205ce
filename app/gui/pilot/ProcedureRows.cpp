#include "app/gui/pilot/ProcedureRows.h"

#include "app/gui/theme/Text.h"

namespace tacto::gui {

ProcedureRows::ProcedureRows(const QString& name, QWidget& parent)
    : QObject(&parent), protocol_(new QComboBox(&parent)), method_(new QComboBox(&parent)) {
    protocol_->setObjectName(name + "Protocol");
    protocol_->addItem(tr("the whole session"), "pilot-identification");
    protocol_->addItem(tr("thresholds alone"), "pilot-thresholds");
    protocol_->setToolTip(tr(
        "Thresholds, training, test and ratings; or only the first part: what is just felt, and what is too strong."));
    method_->setObjectName(name + "Method");
    method_->addItem(tr("QUEST+"), "quest");
    method_->addItem(tr("weighted staircase"), "staircase");
    method_->setToolTip(tr("How the level that is just felt is found after the ascending limits."));
    connect(protocol_, &QComboBox::currentIndexChanged, this, &ProcedureRows::changed);
}

void ProcedureRows::addTo(QFormLayout& form) {
    form.addRow(tr("What is run"), protocol_);
    form.addRow(tr("Detection by"), method_);
}

void ProcedureRows::writeTo(PilotStart& start) const {
    start.protocol = protocol_->currentData().toString().toStdString();
    start.method = method_->currentData().toString().toStdString();
}

void ProcedureRows::follow(const UnfinishedOffer& offer) {
    if (offer.goesOn()) protocol_->setCurrentIndex(protocol_->findData(qtext(offer.offered()->protocol)));
    for (auto* box : {protocol_, method_}) box->setEnabled(!offer.goesOn());
}

void ProcedureRows::setMethod(const QString& method) { method_->setCurrentIndex(method_->findData(method)); }

}  // namespace tacto::gui

#include "moc_ProcedureRows.cpp"
