// DriveDock.h - what drives the output, in every workspace: off, two sliders, or the fingertip, and what that asks for.
//
// Thread-safety: the GUI thread.
#pragma once

#include "app/gui/controller/BenchController.h"
#include "app/gui/window/FoldingDock.h"

namespace tacto::gui {

class DrivePanel;

class DriveDock final : public FoldingDock {
    Q_OBJECT
public:
    DriveDock(BenchController& controller, QWidget* parent);
    void refresh(const Telemetry& telemetry);
    /// To what drives now: arrows choose from there. Choosing is not done by this.
    void takeFocus();
    [[nodiscard]] QString keyFigure() const override;

private:
    DrivePanel* panel_;
};

}  // namespace tacto::gui
