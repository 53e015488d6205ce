#include "app/gui/live/Strip.h"

#include <algorithm>
#include <cmath>

#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"
#include "app/report/NumberText.h"
#include "core/acquisition/StreamHealth.h"

namespace tacto::gui {

namespace {

constexpr double kAroundNothing = 0.5;  // half an axis on which all values are one
constexpr double kUnderZero = 0.06;     // share of the height below zero, so that a trace at zero is seen
constexpr double kRoomBelow = 0.1;      // share of the height: an axis from zero has less than that below it

/// The next of 1, 2, 5 times a power of ten at or above `value`.
double stepAbove(double value) {
    if (!(value > 0)) return 1;
    const double decade = std::pow(10, std::floor(std::log10(value)));
    for (const double step : {1.0, 2.0, 5.0, 10.0}) {
        if (step * decade >= value * 0.999) return step * decade;
    }
    return 10 * decade;
}

}  // namespace

double StripTicker::getTickStep(const QCPRange& range) {
    return stepAbove(range.size() / std::max(1, std::min(room_, most_ + 1)));
}

QString StripTicker::getTickLabel(double tick, const QLocale& locale, QChar format, int precision) {
    return QCPAxisTicker::getTickLabel(tick, locale, format, precision).replace('-', QChar(0x2212));
}

QCPRange steadyRange(const QCPRange& before, const QCPRange& wanted) {
    const double step = stepAbove(wanted.size() / 4);
    const QCPRange whole(std::floor(wanted.lower / step) * step, std::ceil(wanted.upper / step) * step);
    const bool fits = before.lower <= wanted.lower && before.upper >= wanted.upper;
    return fits && wanted.size() > 0.4 * before.size() ? before : whole;
}

Strip::Strip(QCustomPlot& plot, int row, const QString& title, const StripAxis& axis)
    : axes_(new QCPAxisRect(&plot)), title_(title), axis_(axis), ticker_(new StripTicker(axis.ticks)) {
    plot.plotLayout()->addElement(row, 0, axes_);  // before its items: they look for it there
    axes_->setMinimumSize(50, 24);
    axes_->setRangeDrag(Qt::Horizontal);
    axes_->setRangeZoom(Qt::Horizontal);
    time().setTickLabels(false);
    time().ticker()->setTickCount(8);
    values().setTicker(ticker_);
    values().setNumberFormat("gb");
    values().setNumberPrecision(4);
    for (auto* each : {&time(), &values()}) each->setLayer("axes");
    watermark_ = addWatermark(*axes_, axis.filled ? WatermarkPlace::InFront : WatermarkPlace::Behind);
    watermark_->setRotation(0);
    hatch_ = new QCPItemRect(&plot);
    for (auto* corner : {hatch_->topLeft, hatch_->bottomRight}) {
        corner->setAxisRect(axes_);
        corner->setAxes(&time(), &values());
        corner->setTypeX(QCPItemPosition::ptPlotCoords);
        corner->setTypeY(QCPItemPosition::ptAxisRectRatio);
    }
    hatch_->setClipAxisRect(axes_);
    hatch_->setPen(Qt::NoPen);
    hatch_->setVisible(false);
    fault_ = new QCPItemLine(&plot);
    for (auto* end : {fault_->start, fault_->end}) {
        end->setAxisRect(axes_);
        end->setAxes(&time(), &values());
        end->setTypeX(QCPItemPosition::ptPlotCoords);
        end->setTypeY(QCPItemPosition::ptAxisRectRatio);
    }
    fault_->setClipAxisRect(axes_);
    fault_->setLayer("axes");  // over what it ended
    fault_->setVisible(false);
    caption_ = new StripCaption(*axes_);
}

QString Strip::scaleText() const {
    constexpr int kDigits = 2;
    const auto range = values().range();
    const bool up = axis_.fromZero && range.lower > -kRoomBelow * range.upper;
    return QObject::tr("%1 %2 to %3")
        .arg(axisTitle(title_, unit_), quantityText(up ? 0 : range.lower, {}, kDigits),
             quantityText(range.upper, {}, kDigits));
}

void Strip::layOut() {
    axes_->setVisible(present_);
    for (const auto side : {QCPAxis::atTop, QCPAxis::atRight}) axes_->axis(side)->setVisible(present_);
    axes_->setSizeConstraintRect(QCPLayoutElement::scrOuterRect);
    const int line = caption_->lineHeight();
    const int below = time().tickLabels() ? 2 : 0;  // lines: the numbers and what they count
    axes_->setMinimumMargins(present_ ? QMargins(4, line + 2, 8, 2) : QMargins());
    axes_->setMinimumSize(present_ ? 50 : 0, present_ ? line * (3 + below) : 0);
    axes_->setMaximumSize(QWIDGETSIZE_MAX, present_ ? QWIDGETSIZE_MAX : 1);
    caption_->setVisible(present_);
    watermark_->setVisible(present_ && simulated_);
    hatch_->setVisible(false);
    fault_->setVisible(false);
}

void Strip::dress() {
    watermark_->setFont(textFont(TextSize::Large, QFont::Bold));
    caption_->dress();
    caption_->setTitle(unit_.isEmpty() ? title_ : QString("%1 (%2)").arg(title_, unit_));
    auto quiet = colours().quiet;
    quiet.setAlpha(90);
    hatch_->setBrush(QBrush(quiet, Qt::BDiagPattern));
    fault_->setPen(QPen(colours().fault, 2));
}

void Strip::markFault(double at_s) {
    fault_->setVisible(present_ && std::isfinite(at_s));
    if (!fault_->visible()) return;
    fault_->start->setCoords(at_s, 0);
    fault_->end->setCoords(at_s, 1);
}

void Strip::thinTicks() {
    constexpr double kLines = 1.15;  // from number to number
    const int room = static_cast<int>(axes_->height() / (kLines * QFontMetrics(values().tickLabelFont()).height()));
    ticker_->setRoom(room);
    values().setTickLabels(room > 0);
}

void Strip::fit(std::span<RollingGraph* const> graphs, const QCPRange& shown) {
    if (!present_) return;
    QCPRange all;
    bool any = false;
    for (const auto* graph : graphs) {
        if (!graph->visible()) continue;
        const auto range = graph->extent(shown);
        if (!range) continue;
        if (any)
            all.expand(*range);
        else
            all = *range;
        any = true;
    }
    if (!any) return;
    if (axis_.fromZero) all.expand(0);
    const double room =
        std::max({0.06 * all.size(), (axis_.least - all.size()) / 2, all.size() > 0 ? 1e-9 : kAroundNothing});
    const bool up = axis_.fromZero && all.lower > -0.05 * all.upper;  // noise about zero is not a sign
    all = up ? QCPRange(0, all.upper + room) : QCPRange(all.lower - room, all.upper + room);
    auto range = steadyRange(up ? QCPRange(0, values().range().upper) : values().range(), all);
    if (up) range.lower = -kUnderZero * range.upper;
    if (range != values().range()) values().setRange(range);
}

void Strip::hatch(const Series* series, double now_s) {
    const bool old =
        present_ && series != nullptr && (series->empty() || now_s - series->newest() > StreamHealth::kStale_s);
    hatch_->setVisible(old);
    if (!old) return;
    hatch_->topLeft->setCoords(series->empty() ? now_s - LiveHistory::kKept_s : series->newest(), 0);
    hatch_->bottomRight->setCoords(now_s, 1);
}

}  // namespace tacto::gui
