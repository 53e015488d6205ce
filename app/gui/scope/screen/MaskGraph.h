// MaskGraph.h - the band of a mask around one channel, behind its trace: filled, with dashed edges.
//
// Drawn from the extremes of each pixel column, so that a long record costs a screenful. Scales as EnvelopeGraph's.
//
// Thread-safety: the GUI thread.
#pragma once

#include <qcustomplot.h>

#include "app/gui/scope/model/Trace.h"

namespace tacto::gui {

class MaskGraph final : public QCPAbstractPlottable {
    Q_OBJECT
public:
    /// `channel` as the mask has it.
    MaskGraph(QCPAxis* keyAxis, QCPAxis* valueAxis, const CaptureMask& mask, std::size_t channel);
    /// The lane that it belongs to.
    [[nodiscard]] const QString& lane() const noexcept { return lane_; }
    void setScale(double perDivision, double position);
    void setColours(const QColor& band, const QColor& edge);

    double selectTest(const QPointF& pos, bool onlySelectable, QVariant* details) const override;
    QCPRange getKeyRange(bool& found, QCP::SignDomain domain) const override;
    QCPRange getValueRange(bool& found, QCP::SignDomain domain, const QCPRange& keys) const override;

protected:
    void draw(QCPPainter* painter) override;
    void drawLegendIcon(QCPPainter* painter, const QRectF& rect) const override;

private:
    QString lane_;
    TracePtr low_, high_;
    double perDivision_ = 1;
    double position_ = 0;
    QColor band_, edge_;
};

}  // namespace tacto::gui
