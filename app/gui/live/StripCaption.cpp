#include "app/gui/live/StripCaption.h"

#include <QFontMetricsF>
#include <algorithm>
#include <iterator>

#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {
constexpr double kBefore_px = 2, kBetween_px = 14, kSample_px = 18, kToSample_px = 5, kUnder_px = 2;
constexpr double kNear_px = 8, kShort_px = 12;  // between keys, and of a sample, where room is short
constexpr int kKeysFrom = 132;                  // so that they stand below each other; a longer title moves its own
}  // namespace

StripCaption::StripCaption(QCPAxisRect& below) : QCPAbstractItem(below.parentPlot()), below_(below) {
    setLayer("legend");
    setClipAxisRect(&below);
    setClipToAxisRect(false);  // it stands above the strip, clear of its trace
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
    // Files are drawn at other resolutions than what was laid out.
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

/// The widest that leaves no key out.
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
    // A value that would lie over the title is left out.
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
        if (until > right - kNear_px) break;  // there is no room for it beside the value
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

#include "moc_StripCaption.cpp"
