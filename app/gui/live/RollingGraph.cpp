#include "app/gui/live/RollingGraph.h"

#include <algorithm>
#include <cmath>

#include "app/gui/theme/PlotLegend.h"

namespace tacto::gui {

namespace {

constexpr double kDash_px = 5;

/// Returns the pixel at `place`, like floor() but without a function call on plain x86-64. Limits far-off places.
int columnAt(double place) {
    constexpr int kMaxPixel = 1 << 20;
    return static_cast<int>(std::clamp(place, -double(kMaxPixel), double(kMaxPixel)) + kMaxPixel) - kMaxPixel;
}

}  // namespace

RollingGraph::RollingGraph(QCPAxis* keyAxis, QCPAxis* valueAxis) : QCPAbstractPlottable(keyAxis, valueAxis) {
    setAntialiased(false);
}

void RollingGraph::show(const Series* series, std::size_t channel, double gap_s) {
    series_ = series;
    channel_ = channel;
    gap_s_ = gap_s;
}

std::optional<QCPRange> RollingGraph::extent(const QCPRange& time) const {
    if (series_ == nullptr) return std::nullopt;
    float low = std::numeric_limits<float>::infinity(), high = -low;
    const auto stride = series_->channels();
    for (const auto& piece : series_->pieces(series_->firstFrom(time.lower), series_->firstFrom(time.upper))) {
        const float* value = piece.values + channel_;
        for (std::size_t i = 0; i < piece.size; ++i, value += stride) {
            if (*value < low) low = *value;
            if (*value > high) high = *value;
        }
    }
    if (!(low <= high)) return std::nullopt;
    return QCPRange(double(low) * scale_, double(high) * scale_);
}

void RollingGraph::draw(QCPPainter* painter) {
    if (series_ == nullptr || series_->empty() || !mKeyAxis || !mValueAxis) return;
    const auto keys = mKeyAxis->range();
    std::size_t first = series_->firstFrom(keys.lower);
    if (first > 0) --first;  // the line to the first sample begins outside
    const double x0 = mKeyAxis->coordToPixel(keys.lower);
    const double perSecond = (mKeyAxis->coordToPixel(keys.upper) - x0) / keys.size();
    const double y0 = mValueAxis->coordToPixel(0);
    const double perUnit = (mValueAxis->coordToPixel(1) - y0) * scale_;
    lines_.clear();
    bars_.clear();
    int column = std::numeric_limits<int>::min();
    float low = 0, high = 0, last = 0;
    double lastTime = 0;
    bool begun = false;
    const auto isDash = [&](double t) { return !dashed_ || static_cast<long long>(t * perSecond / kDash_px) % 2 == 0; };
    const auto flush = [&] {
        if (begun && isDash(lastTime)) addBar(column, y0 + perUnit * double(low), y0 + perUnit * double(high));
    };
    const auto take = [&](double t, float value) {
        if (std::isnan(value) || (begun && t - lastTime > gap_s_)) {
            flush();
            begun = false;
            column = std::numeric_limits<int>::min();
            if (std::isnan(value)) return;
        }
        const int x = columnAt(x0 + (t - keys.lower) * perSecond);
        if (begun && x == column) {
            low = std::min(low, value);
            high = std::max(high, value);
        } else {
            flush();
            if (begun && x > column + 1) {
                // With few samples, a line crosses the columns between two samples.
                if (isDash(t))
                    lines_.append(
                        QLineF(column + 0.5, y0 + perUnit * double(last), x + 0.5, y0 + perUnit * double(value)));
                low = high = value;
            } else {
                low = begun ? std::min(last, value) : value;
                high = begun ? std::max(last, value) : value;
            }
            column = x;
            begun = true;
        }
        last = value;
        lastTime = t;
    };
    const auto stride = series_->channels();
    for (const auto& piece : series_->pieces(first, series_->size())) {
        for (std::size_t i = 0; i < piece.size && piece.times[i] <= keys.upper; ++i)
            take(piece.times[i], piece.values[i * stride + channel_]);
    }
    flush();
    painter->setAntialiasing(false);
    auto pen = mPen;
    pen.setWidth(1);
    painter->setPen(pen);
    painter->drawLines(lines_);
    painter->setPen(Qt::NoPen);
    painter->setBrush(pen.color());
    painter->drawRects(bars_);
}

/// Adds a bar one pixel wide between two levels; equal neighbours are joined into one bar.
void RollingGraph::addBar(int column, double from, double to) {
    const int top = columnAt(std::min(from, to)), bottom = columnAt(std::max(from, to));
    if (!bars_.isEmpty()) {
        auto& before = bars_.last();
        if (before.right() + 1 == column && before.top() == top && before.bottom() == bottom)
            return before.setRight(column);
    }
    bars_.append(QRect(column, top, 1, bottom - top + 1));
}

void RollingGraph::drawLegendIcon(QCPPainter* painter, const QRectF& rect) const { drawLineIcon(*painter, rect, mPen); }

}  // namespace tacto::gui

#include "moc_RollingGraph.cpp"
