#include "app/gui/scope/Graticule.h"

#include <algorithm>
#include <cmath>

namespace tacto::gui {

namespace {

/// As few decimals as show every number of a row as it is, to a two-hundredth of their step.
int decimalsFor(const QVector<double>& values, double step) {
    for (int decimals = 0; decimals < 9; ++decimals) {
        const double scale = std::pow(10.0, decimals);
        const bool enough = std::all_of(values.begin(), values.end(), [&](double v) {
            return std::abs(std::round(v * scale) / scale - v) < std::abs(step) / 200;
        });
        if (enough) return decimals;
    }
    return 9;
}

}  // namespace

void GraticuleTicker::setQuantity(double position, double perCoordinate, double factor) {
    position_ = position;
    perCoordinate_ = perCoordinate;
    factor_ = factor;
}

void GraticuleTicker::generate(const QCPRange& range, const QLocale&, QChar, int, QVector<double>& ticks,
                               QVector<double>* subTicks, QVector<QString>* labels) {
    ticks.clear();
    QVector<double> values;
    for (int i = 0; i <= divisions_; ++i) {
        const double at = range.lower + range.size() * i / divisions_;
        ticks << at;
        values << (at - position_) * perCoordinate_ * factor_;
    }
    if (subTicks != nullptr) subTicks->clear();
    if (labels == nullptr) return;
    labels->clear();
    const double step = std::abs(range.size() / divisions_ * perCoordinate_ * factor_);
    const int decimals = decimalsFor(values, step);
    // Where not every division has a number, zero has one.
    const auto isZero = [&](double v) { return std::abs(v) < step / 400; };
    const auto zero = std::find_if(values.begin(), values.end(), isZero) - values.begin();
    const int first = zero <= divisions_ ? static_cast<int>(zero) % every_ : 0;
    for (int i = 0; i <= divisions_; ++i) {
        if (blank_ || i % every_ != first) {
            labels->append(QString());
            continue;
        }
        const double value = isZero(values[i]) ? 0.0 : values[i];
        labels->append(QString::number(value, 'f', decimals).replace('-', QChar(0x2212)));
    }
}

RecordGround::RecordGround(QCPAxis* keyAxis) : QCPLayerable(keyAxis->parentPlot(), "grid"), keys_(keyAxis) {}

void RecordGround::draw(QCPPainter* painter) {
    const QRectF area(keys_->axisRect()->rect());
    if (records_.empty() || area.isEmpty()) return;  // empty: not laid out yet
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
