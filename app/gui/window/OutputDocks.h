// OutputDocks.h - the docks of the output: how far it is from its limits, and what drives it.
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

/// Every limit that holds for what the bench delivers, the nearest first, the unevaluated ones last, with a way to what
/// those lack.
class ExposureDock final : public FoldingDock {
    Q_OBJECT
public:
    ExposureDock(const BenchController& controller, QWidget* parent);
    void refresh(const Telemetry& telemetry);
    /// The limit that is nearest: "39.1 of 40 V".
    [[nodiscard]] QString keyFigure() const override { return nearest_; }

signals:
    void areaWanted();  ///< asks for the electrode's area, which current and power density need

private:
    void putInOrder(std::vector<ExposureRow>& rows) const;
    void build(const std::vector<ExposureRow>& rows);

    const BenchController& controller_;
    QLabel* empty_;
    ElidedLabel* now_;  ///< whether any of it is delivered
    QPushButton* enterArea_;
    QVBoxLayout* column_;
    std::vector<LimitBar*> bars_;
    QStringList titles_;  ///< the titles of the bars
    Instant shownAt_{-1};
    InterlockState shownState_ = InterlockState::Disconnected;
    QString nearest_;
};

/// The drive of the output, in every workspace: off, two sliders, or the fingertip, and what that asks for.
class DriveDock final : public FoldingDock {
    Q_OBJECT
public:
    DriveDock(BenchController& controller, QWidget* parent);
    void refresh(const Telemetry& telemetry);
    /// Puts the focus on what drives now: arrow keys choose from there. This itself chooses nothing.
    void takeFocus();
    [[nodiscard]] QString keyFigure() const override;

private:
    DrivePanel* panel_;
};

}  // namespace tacto::gui
