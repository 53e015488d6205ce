#include "app/gui/window/DriveDock.h"

#include <QAbstractButton>

#include "app/gui/live/DrivePanel.h"

namespace tacto::gui {

DriveDock::DriveDock(BenchController& controller, QWidget* parent)
    : FoldingDock(tr("Drive"), "drive", "driveDock", parent), panel_(new DrivePanel(controller, this)) {
    setContent(panel_, Room::First);
    connect(&controller, &BenchController::changed, panel_, &DrivePanel::begin);
}

void DriveDock::refresh(const Telemetry& telemetry) { panel_->refresh(telemetry); }

void DriveDock::takeFocus() {
    for (auto* button : panel_->findChildren<QAbstractButton*>()) {
        if (button->isChecked() && button->isVisible()) return button->setFocus(Qt::ShortcutFocusReason);
    }
}

QString DriveDock::keyFigure() const { return panel_->headline(); }

}  // namespace tacto::gui

#include "moc_DriveDock.cpp"
