#include "app/gui/scope/screen/Graticule.h"

#include <algorithm>
#include <cmath>

#include "app/gui/scope/model/Viewport.h"
#include "app/gui/theme/Text.h"

namespace tacto::gui {

void RoundTicker::setQuantity(double position, double perCoordinate, double factor) {
    position_ = position;
    perCoordinate_ = perCoordinate;
    factor_ = factor;
}

double RoundTicker::stepOver(const QCPRange& range) const {
    return stepNotBelow(std::max(range.size() / divisions_, least_) * perCoordinate_);
}

/// Writes as many decimals as the step has, so that all numbers of an axis have the same decimals.
QString RoundTicker::written(double quantity, double step) const {
    constexpr int kMaxDecimals = 15;
    const double shownStep = step * factor_;
    int decimals = 0;
    const auto isWhole = [&](double x) { return std::abs(std::round(x) - x) < 1e-6; };
    while (decimals < kMaxDecimals && !isWhole(shownStep * std::pow(10.0, decimals))) ++decimals;
    const double value = std::abs(quantity) < step / 2 ? 0.0 : quantity * factor_;
    return decimalText(value, decimals);
}

QString RoundTicker::widestIn(const QCPRange& range) const {
    const double step = stepOver(range);
    const auto at = [&](double coordinate) {
        return written(std::round((coordinate - position_) * perCoordinate_ / step) * step, step);
    };
    const auto first = at(range.lower), last = at(range.upper);
    return first.size() > last.size() ? first : last;
}

void RoundTicker::generate(const QCPRange& range, const QLocale&, QChar, int, QVector<double>& ticks,
                           QVector<double>* subTicks, QVector<QString>* labels) {
    constexpr double kOnTheEdge = 1e-6;  // share of a step
    ticks.clear();
    if (subTicks != nullptr) subTicks->clear();
    if (labels != nullptr) labels->clear();
    const double step = stepOver(range);
    const double first = std::ceil((range.lower - position_) * perCoordinate_ / step - kOnTheEdge);
    const double last = std::floor((range.upper - position_) * perCoordinate_ / step + kOnTheEdge);
    double lowest = first, highest = last;
    if (numbered_) {
        lowest = std::floor(numbered_->first / step);
        highest = std::ceil(numbered_->second / step);
        if (lowest <= 0 && highest >= 0) {  // a flat line at zero also gets a scale
            lowest = std::min(lowest, -1.0);
            highest = std::max(highest, 1.0);
        }
        if (lowest > last || highest < first) {
            lowest = first;
            highest = last;
        }
    }
    for (double k = first; k <= last; ++k) {
        const bool blank = blank_ || k < lowest || k > highest;
        ticks << std::clamp(k * step / perCoordinate_ + position_, range.lower, range.upper);
        if (labels != nullptr) labels->append(blank ? QString() : written(k * step, step));
    }
}

RecordGround::RecordGround(QCPAxis* keyAxis) : QCPLayerable(keyAxis->parentPlot(), "grid"), keys_(keyAxis) {}

void RecordGround::draw(QCPPainter* painter) {
    const QRectF area(keys_->axisRect()->rect());
    if (records_.empty() || area.isEmpty()) return;  // an empty area was not laid out yet
    const auto range = keys_->range();
    const auto x = [&](double key) {
        return std::clamp(area.left() + (key - range.lower) / range.size() * area.width(), area.left(), area.right());
    };
    painter->setPen(Qt::NoPen);
    double open = area.left();
    const auto hatchTo = [&](double to) {
        if (to - open >= 1)
            painter->fillRect(QRectF(open, area.top(), to - open, area.height()), QBrush(colour_, Qt::BDiagPattern));
    };
    for (const auto& [from, to] : records_) {
        hatchTo(x(from));
        open = std::max(open, x(to));
    }
    hatchTo(area.right());
}

}  // namespace tacto::gui

#include "moc_Graticule.cpp"
