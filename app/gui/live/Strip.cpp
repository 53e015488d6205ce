#include "app/gui/live/Strip.h"

#include <QFontMetricsF>
#include <algorithm>
#include <cmath>
#include <iterator>

#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"
#include "app/report/NumberText.h"
#include "core/acquisition/StreamHealth.h"

namespace tacto::gui {

namespace {

constexpr double kAroundNothing = 0.5;  // half the span of an axis if all values are equal
constexpr double kUnderZero = 0.06;     // share of the height below zero, so that a trace at zero is visible
constexpr double kRoomBelow = 0.1;      // share of the height; an axis from zero has less room below

/// Returns the smallest of 1, 2, 5 times a power of ten that is at least `value`.
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

void placeAcross(QCPItemPosition& position, QCPAxisRect& axes) {
    position.setAxisRect(&axes);
    position.setAxes(axes.axis(QCPAxis::atBottom), axes.axis(QCPAxis::atLeft));
    position.setTypeX(QCPItemPosition::ptPlotCoords);
    position.setTypeY(QCPItemPosition::ptAxisRectRatio);
}

Strip::Strip(QCustomPlot& plot, int row, const QString& title, const StripAxis& axis)
    : axes_(new QCPAxisRect(&plot)), title_(title), axis_(axis), ticker_(new StripTicker(axis.ticks)) {
    plot.plotLayout()->addElement(row, 0, axes_);  // must precede its items, which look for it in the layout
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
    for (auto* corner : {hatch_->topLeft, hatch_->bottomRight}) placeAcross(*corner, *axes_);
    hatch_->setClipAxisRect(axes_);
    hatch_->setPen(Qt::NoPen);
    hatch_->setVisible(false);
    fault_ = new QCPItemLine(&plot);
    for (auto* end : {fault_->start, fault_->end}) placeAcross(*end, *axes_);
    fault_->setClipAxisRect(axes_);
    fault_->setLayer("axes");  // draws the fault's line over the traces that the fault ended
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
    const int below = time().tickLabels() ? 2 : 0;  // number of lines: the tick numbers and the axis title
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
    constexpr double kLines = 1.15;  // distance between tick numbers, in lines
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
    const bool up = axis_.fromZero && all.lower > -0.05 * all.upper;  // noise around zero counts as zero
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

namespace {
constexpr double kBefore_px = 2, kBetween_px = 14, kSample_px = 18, kToSample_px = 5, kUnder_px = 2;
constexpr double kNear_px = 8, kShort_px = 12;  // gap between keys and length of a sample, if short of room
constexpr int kKeysFrom = 132;                  // aligns the keys of all strips; a longer title moves its own keys
}  // namespace

StripCaption::StripCaption(QCPAxisRect& below) : QCPAbstractItem(below.parentPlot()), below_(below) {
    setLayer("legend");
    setClipAxisRect(&below);
    setClipToAxisRect(false);  // the text is above the strip, clear of its trace
}

void StripCaption::dress() {
    font_ = textFont(TextSize::Small);
    strong_ = textFont(TextSize::Small, QFont::Bold);
    layOut(title_, strong_);
    layOut(value_, describes_ ? font_ : strong_);
    for (auto& each : keys_) {
        layOut(each.words, font_);
        layOut(each.brief, font_);
    }
}

int StripCaption::lineHeight() const { return QFontMetrics(strong_).height(); }

void StripCaption::setTitle(const QString& text) { set(title_, text, strong_); }

void StripCaption::setValue(const QString& text, bool describes) {
    if (std::exchange(describes_, describes) != describes) layOut(value_, describes ? font_ : strong_);
    set(value_, text, describes ? font_ : strong_);
}

void StripCaption::setKey(std::size_t index, const QString& text, const QString& brief) {
    set(key(index).words, text, font_);
    set(key(index).brief, brief, font_);
}

void StripCaption::setSample(std::size_t index, const QPen& line, const QCPScatterStyle& mark) {
    key(index).line = line;
    key(index).mark = mark;
}

StripCaption::Key& StripCaption::key(std::size_t index) {
    if (keys_.size() <= index) keys_.resize(index + 1);
    return keys_[index];
}

void StripCaption::set(Words& words, const QString& text, const QFont& font) {
    if (words.text.text() == text) return;
    words.text.setTextFormat(Qt::PlainText);
    words.text.setText(text);
    layOut(words, font);
}

void StripCaption::layOut(Words& words, const QFont& font) {
    words.text.prepare(QTransform(), font);
    words.width = QFontMetricsF(font).horizontalAdvance(words.text.text());
}

void StripCaption::write(QCPPainter& painter, const Words& words, const QFont& font, double x) const {
    const QFontMetricsF metrics(font);
    const double top = below_.top() - kUnder_px - metrics.height();
    painter.setFont(font);
    // Files are drawn at another resolution than the prepared text.
    if (painter.modes().testFlag(QCPPainter::pmVectorized))
        painter.drawText(QPointF(x, top + metrics.ascent()), words.text.text());
    else
        painter.drawStaticText(QPointF(x, top), words.text);
}

const StripCaption::Words& StripCaption::wordsOf(const Key& key, bool brief) {
    return brief && !key.brief.text.text().isEmpty() ? key.brief : key.words;
}

double StripCaption::endOf(const Setting& setting) const {
    double end = setting.from;
    for (const auto& each : keys_)
        if (!each.words.text.text().isEmpty())
            end += setting.sample + kToSample_px + wordsOf(each, setting.brief).width + setting.between;
    return end - setting.between;
}

/// Returns the widest setting that leaves out no key.
StripCaption::Setting StripCaption::settingFor(double title, double until) const {
    const double aligned = std::max(below_.left() + double(scaledPx(kKeysFrom)), title + kBetween_px);
    const Setting all[] = {{aligned, kSample_px, kBetween_px, false},
                           {title + kBetween_px, kSample_px, kBetween_px, false},
                           {title + kBetween_px, kShort_px, kNear_px, false},
                           {title + kBetween_px, kShort_px, kNear_px, true}};
    const auto* fits = std::ranges::find_if(all, [&](const Setting& each) { return endOf(each) <= until; });
    return fits != std::end(all) ? *fits : all[3];
}

void StripCaption::draw(QCPPainter* painter) {
    const auto& c = colours();
    const double middle = below_.top() - kUnder_px - QFontMetricsF(font_).height() / 2;
    const double title = below_.left() + kBefore_px;
    // A value that would overlap the title is left out.
    const double end = below_.left() + below_.width();
    const bool hasValue = end - value_.width >= title + title_.width + kBetween_px;
    const double right = hasValue ? end - value_.width : end;
    painter->setPen(c.text);
    write(*painter, title_, strong_, title);
    const auto setting = settingFor(title + title_.width, right - kNear_px);
    double x = setting.from;
    for (const auto& each : keys_) {
        if (each.words.text.text().isEmpty()) continue;
        const auto& words = wordsOf(each, setting.brief);
        const double until = x + setting.sample + kToSample_px + words.width;
        if (until > right - kNear_px) break;  // no room next to the value
        painter->setPen(each.line);
        painter->drawLine(QPointF(x, middle), QPointF(x + setting.sample, middle));
        if (!each.mark.isNone()) {
            each.mark.applyTo(painter, each.line);
            each.mark.drawShape(painter, x + setting.sample / 2, middle);
        }
        painter->setBrush(Qt::NoBrush);
        painter->setPen(c.quiet);
        write(*painter, words, font_, x + setting.sample + kToSample_px);
        x = until + setting.between;
    }
    if (!hasValue) return;
    painter->setPen(describes_ ? c.quiet : c.text);
    write(*painter, value_, describes_ ? font_ : strong_, right);
}

}  // namespace tacto::gui

#include "moc_Strip.cpp"
