#include "app/gui/scope/screen/MaskGraph.h"

#include <algorithm>
#include <cmath>

namespace tacto::gui {

namespace {

TracePtr traceOf(const std::vector<float>& samples, const CaptureMask& mask) {
    return makeTrace({}, {}, {}, std::make_shared<const std::vector<float>>(samples), mask.rate_hz(), mask.start_s(),
                     0);
}

}  // namespace

MaskGraph::MaskGraph(QCPAxis* keyAxis, QCPAxis* valueAxis, const CaptureMask& mask, std::size_t channel)
    : QCPAbstractPlottable(keyAxis, valueAxis),
      lane_(channelKey(mask.channels()[channel].name)),
      low_(traceOf(mask.channels()[channel].low, mask)),
      high_(traceOf(mask.channels()[channel].high, mask)) {
    setSelectable(QCP::stNone);
    setAntialiased(false);
}

void MaskGraph::setScale(double perDivision, double position) {
    perDivision_ = perDivision;
    position_ = position;
}

void MaskGraph::setColours(const QColor& band, const QColor& edge) {
    band_ = band;
    edge_ = edge;
}

double MaskGraph::selectTest(const QPointF&, bool, QVariant*) const { return -1; }

QCPRange MaskGraph::getKeyRange(bool& found, QCP::SignDomain) const {
    found = low_->size() > 0;
    return {low_->start_s, low_->end_s()};
}

QCPRange MaskGraph::getValueRange(bool& found, QCP::SignDomain, const QCPRange&) const {
    found = false;  // the traces say what is shown
    return {};
}

void MaskGraph::draw(QCPPainter* painter) {
    const QRectF area(mKeyAxis->axisRect()->rect());
    const auto keys = mKeyAxis->range(), values = mValueAxis->range();
    if (area.isEmpty() || low_->size() == 0) return;
    const double perPixel = keys.size() / area.width();
    const auto y = [&](float value) {
        const double height = static_cast<double>(value) / perDivision_ + position_;
        const double at = area.bottom() - (height - values.lower) / values.size() * area.height();
        return std::clamp(at, area.top(), area.bottom());
    };
    const auto size = static_cast<double>(low_->size());
    QPolygonF top, bottom;
    // Joins what belongs together: a gap in the reference ends one piece and begins another.
    const auto flush = [&] {
        if (top.size() > 1) {
            QPolygonF whole = top;
            for (auto i = bottom.size(); i-- > 0;) whole << bottom[i];
            painter->setPen(Qt::NoPen);
            painter->setBrush(band_);
            painter->drawPolygon(whole);
            QPen dashed(edge_, 1);
            dashed.setDashPattern({8, 4});
            painter->setPen(dashed);
            painter->drawPolyline(top);
            painter->drawPolyline(bottom);
        }
        top.clear();
        bottom.clear();
    };
    const int columns = static_cast<int>(area.width());
    for (int column = 0; column <= columns; ++column) {
        const double from = (keys.lower + (column - 0.5) * perPixel - low_->start_s) * low_->rate_hz;
        const double to = from + perPixel * low_->rate_hz;
        const auto first = static_cast<std::size_t>(std::clamp(std::floor(from), 0.0, size));
        const auto last = static_cast<std::size_t>(std::clamp(std::ceil(to), 0.0, size));
        const auto low = low_->pyramid.over(first, last), high = high_->pyramid.over(first, last);
        if (first >= last || low.empty() || high.empty()) {
            flush();
            continue;
        }
        top << QPointF(area.left() + column, y(high.high));
        bottom << QPointF(area.left() + column, y(low.low));
    }
    flush();
}

void MaskGraph::drawLegendIcon(QCPPainter* painter, const QRectF& rect) const { painter->fillRect(rect, band_); }

}  // namespace tacto::gui

#include "moc_MaskGraph.cpp"
