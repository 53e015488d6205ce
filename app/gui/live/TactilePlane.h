// TactilePlane.h - plot of roughness against pressure: the finger's present point, its trail, and the four conditions.
#pragma once

#include <qcustomplot.h>

#include "app/gui/live/LiveHistory.h"
#include "core/encoding/EncodingProfile.h"

namespace tacto::gui {

class TactilePlane final : public QCustomPlot {
    Q_OBJECT
public:
    explicit TactilePlane(QWidget* parent = nullptr);
    void setConditions(const std::vector<Condition>& conditions);
    /// `calibrated`: the scale of R was measured on this rig.
    void setOrigin(bool simulated, bool calibrated);
    /// Shows the present point, and the fingertip's trail of the last three seconds; NaN: nothing is felt. If driven by
    /// hand there is no trail, as the point is not the fingertip's.
    void show(const Series& frames, double now_s, double roughness, double pressure, bool byHand);
    /// Returns the position of the point; nothing if it is not drawn.
    [[nodiscard]] std::optional<QPointF> point() const;
    [[nodiscard]] QSize sizeHint() const override;

protected:
    void resizeEvent(QResizeEvent* event) override;

private:
    void makeRoomForNames();
    void colour();
    std::vector<Condition> conditions_;
    std::vector<QCPGraph*> marks_;
    std::vector<QCPItemText*> names_;
    QCPCurve* trail_ = nullptr;
    QCPGraph* now_ = nullptr;
    QCPItemText* watermark_ = nullptr;
    QVector<double> t_, r_, p_;  // buffers, reused
};

}  // namespace tacto::gui
