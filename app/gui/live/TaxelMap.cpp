#include "app/gui/live/TaxelMap.h"

#include <QPainter>
#include <algorithm>
#include <cmath>
#include <utility>

#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {

constexpr int kCellPad = 5, kCellHigh = 32, kCellsApart = 4;
constexpr double kFull = 0.55;  // share of the pressure colour in a full cell, low enough to keep numbers readable

}  // namespace

QSize TaxelMap::gridFor(std::size_t n) {
    const int count = int(std::max<std::size_t>(1, n));
    const int across = count <= 3 ? count : count == 8 ? 4 : int(std::ceil(std::sqrt(double(count))));
    return {across, (count + across - 1) / across};
}

TaxelMap::TaxelMap(QWidget* parent) : QWidget(parent) {
    setAccessibleName(tr("Taxels"));
    setToolTip(
        tr("Pressure on each taxel above the least it has shown; more is bluer, up to the largest value seen. "
           "Hatched: the values are old."));
    setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Maximum);
}

QSize TaxelMap::roomFor(int cellHeight) const {
    const auto grid = gridFor(values_.empty() ? kUsualTaxels : values_.size());
    return {QFontMetrics(textFont(TextSize::Small)).horizontalAdvance("8.88 kPa ") * grid.width(),
            captionHeight() + grid.height() * cellHeight};
}

int TaxelMap::captionHeight() const {
    return simulated_ ? QFontMetrics(textFont(TextSize::Small, QFont::Bold)).ascent() + 2 : 0;
}

QSize TaxelMap::sizeHint() const { return roomFor(scaledPx(kCellHigh + kCellsApart)); }

QSize TaxelMap::minimumSizeHint() const {
    return roomFor(QFontMetrics(textFont(TextSize::Small)).height() + kCellPad + kCellsApart);
}

void TaxelMap::show(std::span<const float> values, const QString& unit) {
    values_.resize(values.size());
    if (rest_.size() != values.size()) {
        rest_.assign(values.begin(), values.end());
        most_ = 0;
        updateGeometry();
    }
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (values[i] < rest_[i] || std::isnan(rest_[i])) rest_[i] = values[i];
        values_[i] = values[i] - rest_[i];
        if (values_[i] > most_) most_ = values_[i];
    }
    unit_ = unit;
    update();
}

void TaxelMap::setStale(bool stale) {
    if (stale == stale_) return;
    stale_ = stale;
    update();
}

void TaxelMap::setSimulated(bool simulated) {
    if (std::exchange(simulated_, simulated) == simulated) return;
    updateGeometry();
    update();
}

void TaxelMap::clear() {
    values_.clear();
    rest_.clear();
    most_ = 0;
    stale_ = false;
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
    const int columns = gridFor(values_.size()).width(), rows = gridFor(values_.size()).height();
    const double w = double(width() + kCellsApart) / columns - kCellsApart;
    const int top = captionHeight();
    const double h = double(height() - top + kCellsApart) / rows - kCellsApart;
    const auto cellOf = [&](std::size_t i) {
        // The outermost cells end at the edges of the widget.
        const int column = int(i) % columns, row = int(i) / columns;
        return QRectF(column * (w + kCellsApart), top + row * (h + kCellsApart), w, h);
    };
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(Qt::NoPen);
    std::vector<QColor> grounds;
    for (std::size_t i = 0; i < values_.size(); ++i) {
        const float value = values_[i];
        const double share = most_ > 0 && std::isfinite(value) ? std::clamp(double(value / most_), 0.0, 1.0) : 0;
        // The colours run from the background to the pressure colour, in even steps of lightness in both themes.
        const QColor from = palette().color(QPalette::Midlight), to = c.voltage;
        const auto mix = [&](int a, int b) { return int(a + (b - a) * share * kFull); };
        grounds.emplace_back(mix(from.red(), to.red()), mix(from.green(), to.green()), mix(from.blue(), to.blue()));
        painter.setBrush(grounds.back());
        painter.drawRoundedRect(cellOf(i), 2, 2);
    }
    if (simulated_) {
        painter.setFont(textFont(TextSize::Small, QFont::Bold));
        painter.setPen(c.quiet);
        painter.drawText(QRect(0, 0, width(), top), Qt::AlignRight | Qt::AlignVCenter, tr("SIMULATED"));
    }
    painter.setFont(textFont(TextSize::Small));
    for (std::size_t i = 0; i < values_.size(); ++i) {
        const auto cell = cellOf(i);
        const float value = values_[i];
        const auto& ground = grounds[i];
        painter.setPen(contrast(ground, c.base) > contrast(ground, c.text) ? c.base : c.text);
        // The number has its unit if both fit; otherwise only the tool tip shows the unit.
        const bool counts = unit_ == "count" && std::isfinite(value);
        const auto number = counts ? QString::number(std::lround(value)) : quantityText(double(value), unit_, 2);
        const auto width = painter.fontMetrics().horizontalAdvance(number);
        painter.drawText(cell, Qt::AlignCenter,
                         width <= int(cell.width()) ? number : number.section(QChar(0x202f), 0, 0));
    }
    if (!stale_) return;
    auto veil = c.quiet;
    veil.setAlpha(150);
    painter.fillRect(rect().adjusted(0, top, 0, 0), QBrush(veil, Qt::BDiagPattern));
}

}  // namespace tacto::gui

#include "moc_TaxelMap.cpp"
