// RollingGraph.h - one channel of a Series as a trace: per pixel column the smallest and largest value, drawn as
// one-pixel verticals in one call, without antialiasing; a line where samples are few. NaN and missing samples leave a
// gap: what was not measured is not drawn.
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
    /// Samples further apart than `gap_s` are not joined.
    void show(const Series* series, std::size_t channel, double gap_s = 1e9);
    /// Values are drawn times this: an axis in kPa of samples in Pa.
    void setScale(double scale) { scale_ = scale; }
    /// A dashed trace, for one that shares its strip with a solid one. The dashes move with the data.
    void setDashed(bool dashed) { dashed_ = dashed; }
    /// Smallest and largest value in the time; nothing without a value.
    [[nodiscard]] std::optional<QCPRange> extent(const QCPRange& time) const;

    double selectTest(const QPointF&, bool, QVariant* = nullptr) const override { return -1; }
    // The strips say what their axes show.
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
    QVector<QLineF> lines_;  // reused
    QVector<QRect> bars_;    // reused
};

}  // namespace tacto::gui
