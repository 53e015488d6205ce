// ExposureDock.h - every limit that holds for what the bench delivers, the nearest first and what was not evaluated
// last, with the way to what it lacks.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QPushButton>
#include <QVBoxLayout>
#include <vector>

#include "app/gui/controller/BenchController.h"
#include "app/gui/theme/ElidedLabel.h"
#include "app/gui/window/FoldingDock.h"
#include "app/gui/window/LimitBar.h"
#include "core/bench/Telemetry.h"

namespace tacto::gui {

class WholeRows;

class ExposureDock final : public FoldingDock {
    Q_OBJECT
public:
    ExposureDock(const BenchController& controller, QWidget* parent);
    void refresh(const Telemetry& telemetry);
    /// The limit that is nearest: "39.1 of 40 V".
    [[nodiscard]] QString keyFigure() const override { return nearest_; }

signals:
    void areaWanted();  ///< of the electrode, which current and power density need

protected:
    void resizeEvent(QResizeEvent* event) override;

private:
    void giveRoom();
    void putInOrder(std::vector<ExposureRow>& rows) const;
    void build(const std::vector<ExposureRow>& rows);

    const BenchController& controller_;
    QLabel* empty_;
    ElidedLabel* now_;  ///< whether any of it is delivered
    QPushButton* enterArea_;
    QVBoxLayout* column_;
    WholeRows* rows_ = nullptr;
    std::vector<LimitBar*> bars_;
    QStringList titles_;  ///< of the bars
    Instant shownAt_{-1};
    InterlockState shownState_ = InterlockState::Disconnected;
    QString nearest_;
};

}  // namespace tacto::gui
