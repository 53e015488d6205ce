#include "app/gui/scope/screen/EnvelopeGraph.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "app/gui/theme/PlotLegend.h"

namespace tacto::gui {

namespace {

constexpr double kMinPerPixel = 2;      ///< samples; with fewer the samples themselves are drawn
constexpr double kDotsFrom = 4;         ///< least distance between samples with dots, in pixels
constexpr int kBlock = 16;              ///< columns
constexpr double kManyPixels = 60'000;  ///< pixels in vertical lines, above which filling rows is faster

std::size_t indexAt(double at, std::size_t size) {
    return static_cast<std::size_t>(std::clamp(std::ceil(at), 0.0, static_cast<double>(size)));
}

/// Clips a line to a rectangle (Liang and Barsky); returns false if no part is inside.
bool clipLine(QLineF& line, const QRectF& area) {
    double from = 0, to = 1;
    const double dx = line.dx(), dy = line.dy();
    const auto cut = [&](double towards, double distance) {
        if (towards == 0) return distance >= 0;
        const double at = distance / towards;
        if (towards < 0)
            from = std::max(from, at);
        else
            to = std::min(to, at);
        return from <= to;
    };
    if (!cut(-dx, line.x1() - area.left()) || !cut(dx, area.right() - line.x1()) || !cut(-dy, line.y1() - area.top()) ||
        !cut(dy, area.bottom() - line.y1())) {
        return false;
    }
    line = QLineF(line.x1() + from * dx, line.y1() + from * dy, line.x1() + to * dx, line.y1() + to * dy);
    return true;
}

}  // namespace

EnvelopeGraph::Screen EnvelopeGraph::screenOf(const QCPPainter& painter) const {
    Screen screen;
    screen.area = QRectF(mKeyAxis->axisRect()->rect());
    if (painter.modes().testFlag(QCPPainter::pmVectorized)) {
        screen.pixel = 0.5;
    } else {
        const double ratio = painter.device()->devicePixelRatioF();
        screen.pixel = 1 / ratio;
        screen.thickness = std::max(1.0, std::round(ratio));
    }
    const auto keys = mKeyAxis->range();
    screen.xPerKey = screen.area.width() / keys.size();
    screen.xOfKey0 = screen.area.left() - keys.lower * screen.xPerKey;
    const auto divisions = mValueAxis->range();
    const double perDivision = screen.area.height() / divisions.size();
    screen.yOfZero = screen.area.bottom() - (position_ - divisions.lower) * perDivision;
    screen.yPerUnit = -perDivision / perDivision_;
    return screen;
}

void EnvelopeGraph::draw(QCPPainter* painter) {
    gapColumns_ = 0;
    clippedColumns_ = 0;
    drewSamples_ = false;
    if (!mKeyAxis || !mValueAxis) return;
    const auto screen = screenOf(*painter);
    lines_.clear();
    tallPixels_ = 0;
    gaps_.clear();
    clips_.clear();
    painter->setAntialiasing(false);
    QPen pen(mPen.color(), 1);
    // At 200 % a pen of width 1 has two pixels, which Qt draws as slow polygons; two flat hairlines look the same.
    if (screen.thickness > 1) pen.setCosmetic(true);
    if (painter->modes().testFlag(QCPPainter::pmVectorized)) pen.setWidthF(0.75);
    for (const auto& span : spans_) {
        if (!span.trace || span.trace->size() == 0) continue;
        const double pixelsPerSample = screen.xPerKey / span.trace->rate_hz;
        if (pixelsPerSample * kMinPerPixel <= screen.pixel) {
            drawColumns(span, screen);
        } else {
            painter->setPen(pen);
            drawSamples(*painter, span, screen, pixelsPerSample);
        }
    }
    if (tallPixels_ > kManyPixels && !painter->modes().testFlag(QCPPainter::pmVectorized)) fillTall(*painter, screen);
    painter->setPen(pen);
    painter->drawLines(lines_);
    if (marked_) drawMarks(*painter, screen);
}

void EnvelopeGraph::addVertical(double x, double top, double bottom, const Screen& screen) {
    const auto& area = screen.area;
    if (bottom < area.top() || top > area.bottom()) return;
    const double y1 = std::round(std::max(top, area.top()) / screen.pixel) * screen.pixel;
    const double y2 = std::round(std::min(bottom, area.bottom()) / screen.pixel) * screen.pixel +
                      (screen.thickness - 1) * screen.pixel;
    // A flat stretch becomes one line instead of a point per column.
    if (y1 == y2 && !lines_.isEmpty()) {
        auto& last = lines_.last();
        if (last.y1() == y1 && last.y2() == y1 && last.x2() + screen.pixel * 1.5 > x && last.x2() < x) {
            last.setP2({x, y1});
            return;
        }
    }
    lines_.append(QLineF(x, y1, x, y2));
    tallPixels_ += (y2 - y1) / screen.pixel;
}

void EnvelopeGraph::fillTall(QCPPainter& painter, const Screen& screen) {
    const auto device = [&](double length) { return static_cast<int>(std::lround(length / screen.pixel)); };
    const int width = device(screen.area.width()) + 1, height = device(screen.area.height()) + 1;
    // Uses whole blocks, so that the compiler can fill them with vector instructions.
    const int blocks = (width + kBlock - 1) / kBlock;
    if (canvas_.width() != blocks * kBlock || canvas_.height() != height) {
        canvas_ = QImage(blocks * kBlock, height, QImage::Format_ARGB32_Premultiplied);
    }
    constexpr std::int32_t kNone = std::numeric_limits<std::int32_t>::max();
    const auto columns = static_cast<std::size_t>(canvas_.width());
    tops_.assign(columns, kNone);
    bottoms_.assign(columns, -1);
    int top = height, bottom = -1;
    // The image holds one vertical per column. Flat lines, and further lines in the same column, are drawn as lines.
    lines_.removeIf([&](const QLineF& line) {
        const int x = device(line.x1() - screen.area.left());
        if (line.x1() != line.x2() || x < 0 || x >= width) return false;
        auto& its = tops_[static_cast<std::size_t>(x)];
        if (its != kNone) return false;
        its = std::max(0, device(line.y1() - screen.area.top()));
        const int end = std::min(height - 1, device(line.y2() - screen.area.top()));
        bottoms_[static_cast<std::size_t>(x)] = end;
        top = std::min(top, its);
        bottom = std::max(bottom, end);
        return true;
    });
    if (top > bottom) return;
    const auto colour = qPremultiply(mPen.color().rgba());
    for (int y = top; y <= bottom; ++y) {
        auto* row = reinterpret_cast<QRgb*>(canvas_.scanLine(y));
        const auto* from = tops_.data();
        const auto* to = bottoms_.data();
        for (int block = 0; block < blocks; ++block, row += kBlock, from += kBlock, to += kBlock) {
            std::array<QRgb, kBlock> pixels;  // a local block cannot overlap other memory
            for (std::size_t x = 0; x < kBlock; ++x) {
                pixels[x] = (0U - static_cast<QRgb>((from[x] <= y) & (y <= to[x]))) & colour;
            }
            std::copy(pixels.begin(), pixels.end(), row);
        }
    }
    const QRectF target(screen.area.left(), screen.area.top() + top * screen.pixel, width * screen.pixel,
                        (bottom - top + 1) * screen.pixel);
    painter.drawImage(target, canvas_, QRectF(0, top, width, bottom - top + 1));
}

void EnvelopeGraph::noteGap(double fromX, double toX) {
    if (!gaps_.empty() && gaps_.back().right() >= fromX - 1e-6 && gaps_.back().left() <= fromX) {
        gaps_.back().setRight(std::max(gaps_.back().right(), toX));
    } else {
        gaps_.emplace_back(fromX, 0, toX - fromX, 0);
    }
}

void EnvelopeGraph::drawColumns(const TraceSpan& span, const Screen& screen) {
    const auto& trace = *span.trace;
    const std::size_t n = trace.size();
    const double perPixel = trace.rate_hz / screen.xPerKey;
    const double atLeft = ((screen.area.left() - screen.xOfKey0) / screen.xPerKey - span.key_s) * trace.rate_hz;
    const double first = std::max(0.0, std::floor(-atLeft / (perPixel * screen.pixel)));
    const double count = screen.area.width() / screen.pixel;
    const bool ranged = trace.low < trace.high;
    std::size_t from = indexAt(atLeft + first * perPixel * screen.pixel, n);
    for (double column = first; column < count; ++column) {
        const std::size_t to = indexAt(atLeft + (column + 1) * perPixel * screen.pixel, n);
        if (to <= from) {
            if (from >= n) break;
            continue;
        }
        // Starts at the last sample of the previous column, so that an edge between two columns is drawn.
        const auto seen = trace.pyramid.over(from > 0 ? from - 1 : 0, to);
        const bool missing = seen.gap && trace.pyramid.over(from, to).gap;
        from = to;
        const double x = screen.area.left() + column * screen.pixel;
        if (missing) {
            ++gapColumns_;
            noteGap(x, x + screen.pixel);
        }
        if (seen.empty()) continue;
        const double high = static_cast<double>(seen.high), low = static_cast<double>(seen.low);
        addVertical(x, screen.y(high), screen.y(low), screen);
        if (ranged && (high >= trace.high || low <= trace.low)) {
            ++clippedColumns_;
            if (high >= trace.high) clips_.emplace_back(x, screen.y(trace.high) - 4, screen.pixel, 3);
            if (low <= trace.low) clips_.emplace_back(x, screen.y(trace.low) + 2, screen.pixel, 3);
        }
    }
}

void EnvelopeGraph::drawSamples(QCPPainter& painter, const TraceSpan& span, const Screen& screen,
                                double pixelsPerSample) {
    const auto& trace = *span.trace;
    const auto& samples = *trace.samples;
    const double x0 = screen.xOfKey0 + span.key_s * screen.xPerKey;
    const double atLeft = (screen.area.left() - x0) / pixelsPerSample;
    const double atRight = (screen.area.right() - x0) / pixelsPerSample;
    if (atRight < -1 || atLeft > static_cast<double>(samples.size())) return;
    drewSamples_ = true;
    const std::size_t first = indexAt(std::floor(atLeft), samples.size());
    const std::size_t last = indexAt(std::ceil(atRight) + 1, samples.size());
    const auto xOf = [&](std::size_t i) { return x0 + static_cast<double>(i) * pixelsPerSample; };
    const bool ranged = trace.low < trace.high;
    const bool dots = pixelsPerSample >= kDotsFrom * screen.pixel;
    QVector<QRectF> squares;
    for (std::size_t i = first; i < last; ++i) {
        const double x = xOf(i);
        if (std::isnan(samples[i])) {
            ++gapColumns_;
            const double left = std::max(i > 0 ? xOf(i - 1) : x, screen.area.left());
            const double right = std::min(xOf(i + 1), screen.area.right());
            if (left < right) noteGap(left, right);
            continue;
        }
        const double value = static_cast<double>(samples[i]);
        const double y = screen.y(value);
        const bool joined = i + 1 < samples.size() && !std::isnan(samples[i + 1]);
        QLineF line(x, y, joined ? xOf(i + 1) : x, joined ? screen.y(static_cast<double>(samples[i + 1])) : y);
        if (clipLine(line, screen.area)) {
            lines_.append(line);
            if (screen.thickness > 1) lines_.append(line.translated(0, screen.pixel));
        }
        if (!screen.area.contains(x, y)) continue;
        if (dots) squares.append(QRectF(x - 1, y - 1, 3, 3));
        if (ranged && (value >= trace.high || value <= trace.low)) {
            ++clippedColumns_;
            const double width = std::max(1.0, pixelsPerSample);
            clips_.emplace_back(x - width / 2, value >= trace.high ? y - 4 : y + 2, width, 3);
        }
    }
    if (squares.isEmpty()) return;
    painter.save();
    painter.setPen(Qt::NoPen);
    painter.setBrush(mPen.color());
    painter.drawRects(squares);
    painter.restore();
}

void EnvelopeGraph::drawMarks(QCPPainter& painter, const Screen& screen) const {
    auto quiet = mPen.color();
    quiet.setAlpha(90);
    painter.setPen(Qt::NoPen);
    for (auto gap : gaps_) {
        gap.setTop(screen.area.top());
        gap.setBottom(screen.area.bottom());
        // A gap narrower than the hatch lines is filled, or it would be invisible.
        painter.fillRect(gap, gap.width() < 6 ? QBrush(quiet) : QBrush(quiet, Qt::BDiagPattern));
    }
    for (const auto& clip : clips_) {
        if (screen.area.intersects(clip)) painter.fillRect(clip.intersected(screen.area), clipColour_);
    }
}

void EnvelopeGraph::drawLegendIcon(QCPPainter* painter, const QRectF& rect) const {
    drawLineIcon(*painter, rect, mPen);
}

namespace {

TracePtr traceOf(const std::vector<float>& samples, const CaptureMask& mask) {
    return makeTrace({}, {}, {}, std::make_shared<const std::vector<float>>(samples), mask.rate_hz(), mask.start_s(),
                     0);
}

}  // namespace

MaskGraph::MaskGraph(QCPAxis* keyAxis, QCPAxis* valueAxis, const CaptureMask& mask, std::size_t channel)
    : ChannelPlottable(keyAxis, valueAxis),
      lane_(channelKey(mask.channels()[channel].name)),
      low_(traceOf(mask.channels()[channel].low, mask)),
      high_(traceOf(mask.channels()[channel].high, mask)) {}

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
    // Closes the present piece of the band; a gap in the reference separates two pieces.
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

#include "moc_EnvelopeGraph.cpp"
