// EnvelopeGraph.h - draws a trace of any length as fast as one screenful: for each pixel column a vertical line between
// the extremes from the pyramid; with fewer than two samples per pixel the samples themselves, as a line with dots.
//
// A few vertical lines are drawn with one drawLines(). A screen full of them (noise) is filled row by row into an
// image: Qt needs 3 ms for such lines, because they jump through memory, and the image a third of 1 ms.
//
// The key axis is in seconds from the zero of each span; the value axis is in divisions: a sample x is drawn at x /
// perDivision + position. Nothing is antialiased, no pen is wider than a pixel, and nothing is drawn outside the axes
// (an SVG would show it). Missing samples leave a hatched gap; samples at the limits of the input's range are marked.
#pragma once

#include <QImage>
#include <cstdint>
#include <qcustomplot.h>
#include <vector>

#include "app/gui/scope/model/Trace.h"

namespace tacto::gui {

/// Base of everything drawn for a channel in divisions: a sample x is drawn at x / perDivision + position. Ignores
/// clicks and does not influence the range of the axes, which the view sets.
class ChannelPlottable : public QCPAbstractPlottable {
public:
    ChannelPlottable(QCPAxis* keyAxis, QCPAxis* valueAxis) : QCPAbstractPlottable(keyAxis, valueAxis) {
        setSelectable(QCP::stNone);
        setAntialiased(false);
    }
    void setScale(double perDivision, double position) {
        perDivision_ = perDivision;
        position_ = position;
    }
    double selectTest(const QPointF&, bool, QVariant*) const override { return -1; }
    QCPRange getKeyRange(bool& found, QCP::SignDomain) const override { return getValueRange(found, {}, {}); }
    QCPRange getValueRange(bool& found, QCP::SignDomain, const QCPRange&) const override {
        found = false;
        return {};
    }

protected:
    double perDivision_ = 1;
    double position_ = 0;
};

class EnvelopeGraph final : public ChannelPlottable {
    Q_OBJECT
public:
    using ChannelPlottable::ChannelPlottable;

    void setSpans(std::vector<TraceSpan> spans) { spans_ = std::move(spans); }
    [[nodiscard]] const std::vector<TraceSpan>& spans() const noexcept { return spans_; }
    /// Hatches gaps and marks clipping; off for older captures in the background.
    void setMarked(bool marked) { marked_ = marked; }
    void setClipColour(const QColor& colour) { clipColour_ = colour; }

    /// For tests: how many columns of the last drawing had missing samples, and how many had clipped samples.
    [[nodiscard]] int gapColumns() const noexcept { return gapColumns_; }
    [[nodiscard]] int clippedColumns() const noexcept { return clippedColumns_; }
    [[nodiscard]] bool drewSamples() const noexcept { return drewSamples_; }

protected:
    void draw(QCPPainter* painter) override;
    void drawLegendIcon(QCPPainter* painter, const QRectF& rect) const override;

private:
    /// Conversion for this drawing: value to y and key to x in the painter's units; `pixel` is one pixel of the device.
    struct Screen {
        QRectF area;
        double pixel = 1;
        double thickness = 1;  ///< device pixels that a flat line covers
        double xOfKey0 = 0, xPerKey = 1;
        double yOfZero = 0, yPerUnit = -1;
        [[nodiscard]] double y(double value) const { return yOfZero + yPerUnit * value; }
    };
    [[nodiscard]] Screen screenOf(const QCPPainter& painter) const;
    void drawColumns(const TraceSpan& span, const Screen& screen);
    void drawSamples(QCPPainter& painter, const TraceSpan& span, const Screen& screen, double pixelsPerSample);
    void addVertical(double x, double top, double bottom, const Screen& screen);
    void fillTall(QCPPainter& painter, const Screen& screen);
    void noteGap(double fromX, double toX);
    void drawMarks(QCPPainter& painter, const Screen& screen) const;

    std::vector<TraceSpan> spans_;
    bool marked_ = true;
    QColor clipColour_;
    // Buffers for the present drawing; they are members so that a frame allocates no memory.
    QVector<QLineF> lines_;
    double tallPixels_ = 0;  ///< pixels of the device in vertical lines
    std::vector<std::int32_t> tops_, bottoms_;
    QImage canvas_;
    std::vector<QRectF> gaps_;
    std::vector<QRectF> clips_;
    int gapColumns_ = 0;
    int clippedColumns_ = 0;
    bool drewSamples_ = false;
};

/// The band of a mask around one channel, behind its trace: filled, with dashed edges. Drawn from the extremes of each
/// pixel column, so that a long record takes no longer than a screenful.
class MaskGraph final : public ChannelPlottable {
    Q_OBJECT
public:
    /// `channel` is the index in the mask.
    MaskGraph(QCPAxis* keyAxis, QCPAxis* valueAxis, const CaptureMask& mask, std::size_t channel);
    /// The key of the lane to which this band belongs.
    [[nodiscard]] const QString& lane() const noexcept { return lane_; }
    void setColours(const QColor& band, const QColor& edge) {
        band_ = band;
        edge_ = edge;
    }

protected:
    void draw(QCPPainter* painter) override;
    void drawLegendIcon(QCPPainter* painter, const QRectF& rect) const override;

private:
    QString lane_;
    TracePtr low_, high_;
    QColor band_, edge_;
};

}  // namespace tacto::gui
