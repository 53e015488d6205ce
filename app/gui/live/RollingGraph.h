// RollingGraph.h - draws one channel of a Series as a trace: in each pixel column a vertical line from the smallest to
// the largest value, all in one call and without antialiasing, and a joining line if samples are few. NaN and missing
// samples leave a gap: values that were not measured are not drawn.
//
// Thread-safety: the GUI thread; the series must outlive the graph or be removed with show(nullptr, 0).
#pragma once

#include <qcustomplot.h>

#include "app/gui/live/LiveHistory.h"

namespace tacto::gui {

class RollingGraph final : public QCPAbstractPlottable {
    Q_OBJECT
public:
    RollingGraph(QCPAxis* keyAxis, QCPAxis* valueAxis);
    /// Draws a channel; samples further apart than `gap_s` are not joined.
    void show(const Series* series, std::size_t channel, double gap_s = 1e9);
    /// Sets the factor for drawn values, for example for samples in Pa on an axis in kPa.
    void setScale(double scale) { scale_ = scale; }
    /// Draws the trace dashed, if it shares its strip with a solid one. The dashes move with the data.
    void setDashed(bool dashed) { dashed_ = dashed; }
    /// Returns the smallest and largest value within `time`; nothing if there is no value.
    [[nodiscard]] std::optional<QCPRange> extent(const QCPRange& time) const;

    double selectTest(const QPointF&, bool, QVariant* = nullptr) const override { return -1; }
    // The strips set their axis ranges themselves.
    QCPRange getKeyRange(bool& found, QCP::SignDomain) const override { return getValueRange(found, {}, {}); }
    QCPRange getValueRange(bool& found, QCP::SignDomain, const QCPRange&) const override {
        found = false;
        return {};
    }

protected:
    void draw(QCPPainter* painter) override;
    void drawLegendIcon(QCPPainter* painter, const QRectF& rect) const override;

private:
    void addBar(int column, double from, double to);
    const Series* series_ = nullptr;
    std::size_t channel_ = 0;
    double gap_s_ = 1e9;
    double scale_ = 1;
    bool dashed_ = false;
    QVector<QLineF> lines_;  // buffer, reused
    QVector<QRect> bars_;    // buffer, reused
};

}  // namespace tacto::gui
