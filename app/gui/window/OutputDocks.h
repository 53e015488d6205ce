// OutputDocks.h - two docks about the output: its distance from the limits, and what drives it.
#pragma once

#include <QPushButton>
#include <QVBoxLayout>
#include <vector>

#include "app/gui/controller/BenchController.h"
#include "app/gui/theme/Labels.h"
#include "app/gui/window/FoldingDock.h"
#include "app/gui/window/LimitBar.h"
#include "core/bench/Telemetry.h"

namespace tacto::gui {

class DrivePanel;

/// All limits that apply to the output: the nearest first, unevaluated ones last, with a button to enter what those
/// lack.
class ExposureDock final : public FoldingDock {
    Q_OBJECT
public:
    ExposureDock(const BenchController& controller, QWidget* parent);
    void refresh(const Telemetry& telemetry);
    /// The nearest limit: "39.1 of 40 V".
    [[nodiscard]] QString keyFigure() const override { return nearest_; }

signals:
    void areaWanted();  ///< asks for the electrode's area, which current density and power density need

private:
    void putInOrder(std::vector<ExposureRow>& rows) const;
    void build(const std::vector<ExposureRow>& rows);

    const BenchController& controller_;
    QLabel* empty_;
    ElidedLabel* now_;  ///< says whether any of this is delivered now
    QPushButton* enterArea_;
    QVBoxLayout* column_;
    std::vector<LimitBar*> bars_;
    QStringList titles_;  ///< the titles of the bars
    Instant shownAt_{-1};
    InterlockState shownState_ = InterlockState::Disconnected;
    QString nearest_;
};

/// What drives the output, in every workspace: off, two sliders or the fingertip; and what is asked of the output.
class DriveDock final : public FoldingDock {
    Q_OBJECT
public:
    DriveDock(BenchController& controller, QWidget* parent);
    void refresh(const Telemetry& telemetry);
    /// Focuses the selected drive, so that arrow keys can choose another. Does not change the drive.
    void takeFocus();
    [[nodiscard]] QString keyFigure() const override;

private:
    DrivePanel* panel_;
};

}  // namespace tacto::gui
