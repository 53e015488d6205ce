// RollingGraph.h - one channel of a Series as a trace: per pixel column the smallest and largest value, drawn as
// one-pixel verticals in one call, without antialiasing; a line where samples are few. NaN leaves a gap.
//
// Thread-safety: the GUI thread; the series outlives the graph or is taken away with show(nullptr, 0).
#pragma once

#include <qcustomplot.h>

#include "app/gui/live/LiveHistory.h"

namespace tacto::gui {

class RollingGraph final : public QCPAbstractPlottable {
    Q_OBJECT
public:
    RollingGraph(QCPAxis* keyAxis, QCPAxis* valueAxis);
    void show(const Series* series, std::size_t channel);
    /// Values are drawn times this: an axis in kPa of samples in Pa.
    void setScale(double scale) { scale_ = scale; }
    /// Smallest and largest value from `from_s` on; nothing when there is none.
    [[nodiscard]] std::optional<QCPRange> extent(double from_s) const;

    double selectTest(const QPointF&, bool, QVariant* = nullptr) const override { return -1; }
    QCPRange getKeyRange(bool& found, QCP::SignDomain = QCP::sdBoth) const override;
    QCPRange getValueRange(bool& found, QCP::SignDomain = QCP::sdBoth, const QCPRange& = QCPRange()) const override;

protected:
    void draw(QCPPainter* painter) override;
    void drawLegendIcon(QCPPainter* painter, const QRectF& rect) const override;

private:
    const Series* series_ = nullptr;
    std::size_t channel_ = 0;
    double scale_ = 1;
    QVector<QLineF> lines_;
};

}  // namespace tacto::gui
