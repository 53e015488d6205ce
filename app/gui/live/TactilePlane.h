// TactilePlane.h - roughness by pressure: where the finger is now, where it came from, and the four conditions.
//
// Thread-safety: the GUI thread.
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
    void setSimulated(bool simulated);
    /// The trail of the last three seconds, and the point of now; NaN: nothing is felt.
    void show(const Series& frames, double now_s, double roughness, double pressure);
    [[nodiscard]] QSize sizeHint() const override;

protected:
    void changeEvent(QEvent* event) override;

private:
    void colour();
    std::vector<Condition> conditions_;
    std::vector<QCPGraph*> marks_;
    std::vector<QCPItemText*> names_;
    QCPCurve* trail_ = nullptr;
    QCPGraph* now_ = nullptr;
    QCPItemText* watermark_ = nullptr;
};

}  // namespace tacto::gui
