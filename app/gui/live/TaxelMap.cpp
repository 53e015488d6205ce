#include "app/gui/live/TaxelMap.h"

#include <QPainter>
#include <cmath>

#include "app/gui/look/Look.h"

namespace tacto::gui {

namespace {

/// Two rows for eight, as on the fingertip; else about square.
int columnsFor(std::size_t n) {
    if (n <= 3) return int(std::max<std::size_t>(1, n));
    if (n == 8) return 4;
    return int(std::ceil(std::sqrt(double(n))));
}

}  // namespace

TaxelMap::TaxelMap(QWidget* parent) : QWidget(parent) {
    setAccessibleName(tr("Taxels"));
    setToolTip(tr("Pressure on each taxel above its rest; darker is more. The scale grows to the largest value seen."));
    setMinimumHeight(fontMetrics().height() * 5);
}

QSize TaxelMap::sizeHint() const {
    return {fontMetrics().horizontalAdvance("8.88 kPa ") * 4, fontMetrics().height() * 6};
}

void TaxelMap::show(std::span<const float> values, const QString& unit) {
    if (rest_.size() != values.size()) {
        rest_.assign(values.begin(), values.end());
        most_ = 0;
    }
    values_.resize(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (values[i] < rest_[i] || std::isnan(rest_[i])) rest_[i] = values[i];
        values_[i] = values[i] - rest_[i];
        if (values_[i] > most_) most_ = values_[i];
    }
    unit_ = unit;
    update();
}

void TaxelMap::clear() {
    values_.clear();
    rest_.clear();
    most_ = 0;
    update();
}

void TaxelMap::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    const auto& c = colours();
    if (values_.empty()) {
        painter.setPen(c.quiet);
        painter.drawText(rect(), Qt::AlignCenter | Qt::TextWordWrap, tr("No taxels"));
        return;
    }
    const int columns = columnsFor(values_.size());
    const int rows = int((values_.size() + std::size_t(columns) - 1) / std::size_t(columns));
    const double w = double(width()) / columns, h = double(height()) / rows;
    auto small = font();
    small.setPointSizeF(small.pointSizeF() * 0.85);
    painter.setFont(small);
    for (std::size_t i = 0; i < values_.size(); ++i) {
        const QRectF cell((int(i) % columns) * w + 1, (int(i) / columns) * h + 1, w - 2, h - 2);
        const float value = values_[i];
        const double share = most_ > 0 && std::isfinite(value) ? std::clamp(double(value / most_), 0.0, 1.0) : 0;
        // From the ground to the pressure colour: even steps in lightness in both themes.
        const QColor from = palette().color(QPalette::Midlight), to = c.voltage;
        const auto mix = [&](int a, int b) { return int(a + (b - a) * share); };
        painter.setPen(Qt::NoPen);
        painter.setBrush(QColor(mix(from.red(), to.red()), mix(from.green(), to.green()), mix(from.blue(), to.blue())));
        painter.drawRect(cell);
        painter.setPen(share > 0.55 ? c.base : c.text);
        const auto text = std::isfinite(value) ? quantityText(double(value), unit_, 2) : QString("–");
        if (painter.fontMetrics().horizontalAdvance(text) <= int(cell.width()))
            painter.drawText(cell, Qt::AlignCenter, text);
    }
}

}  // namespace tacto::gui
