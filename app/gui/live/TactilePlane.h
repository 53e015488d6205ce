// TactilePlane.h - roughness by pressure: where the finger is now, where it came from, and the four conditions.
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
    /// `calibrated`: R's scale was measured on this rig.
    void setOrigin(bool simulated, bool calibrated);
    /// The point of now, and the fingertip's trail of the last three seconds; NaN: nothing is felt. By hand there is
    /// no trail: the point is not the fingertip's.
    void show(const Series& frames, double now_s, double roughness, double pressure, bool byHand);
    /// Where the point is; nothing when it is not drawn.
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
    QVector<double> t_, r_, p_;  // reused
};

}  // namespace tacto::gui
