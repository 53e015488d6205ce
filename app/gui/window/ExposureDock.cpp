#include "app/gui/window/ExposureDock.h"

namespace tacto::gui {

ExposureDock::ExposureDock(QWidget* parent) : QDockWidget(tr("Exposure"), parent), table_(new ExposureTable(this)) {
    setObjectName("exposureDock");
    table_->setAccessibleName(tr("Exposure against limits"));
    table_->setToolTip(
        tr("Worst case over the permitted load range, exposure of the last 5 s included. Hatched: not "
           "evaluated, and never a pass."));
    setWidget(table_);
}

void ExposureDock::refresh(const Telemetry& telemetry) {
    const auto rows = telemetry.exposure();
    if (telemetry.at == shownAt_ && table_->rowCount() == int(rows.size())) return;
    shownAt_ = telemetry.at;
    table_->show(rows);
}

}  // namespace tacto::gui
