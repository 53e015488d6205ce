#include "app/gui/live/StripCaption.h"

#include <QFontMetricsF>

namespace tacto::gui {

namespace {
constexpr double kBefore_px = 2, kBetween_px = 8, kUnder_px = 1;
}

StripCaption::StripCaption(QCPAxisRect& below) : QCPAbstractItem(below.parentPlot()), below_(below) {
    setLayer("legend");
    setClipAxisRect(&below);
    setClipToAxisRect(false);  // it stands above the strip, clear of its trace
}

void StripCaption::setFont(const QFont& font) {
    font_ = font;
    for (auto& its : words_) layOut(its);
}

void StripCaption::setWord(std::size_t index, const QString& text) {
    auto& its = word(index);
    if (its.text.text() == text) return;
    its.text.setText(text);
    layOut(its);
}

void StripCaption::setColour(std::size_t index, const QColor& colour) { word(index).colour = colour; }

StripCaption::Word& StripCaption::word(std::size_t index) {
    while (words_.size() <= index) {
        words_.emplace_back();
        words_.back().text.setTextFormat(Qt::PlainText);
    }
    return words_[index];
}

void StripCaption::layOut(Word& word) const {
    word.text.prepare(QTransform(), font_);
    word.width = QFontMetricsF(font_).horizontalAdvance(word.text.text());
}

void StripCaption::draw(QCPPainter* painter) {
    const QFontMetricsF metrics(font_);
    const double top = below_.top() - kUnder_px - metrics.height();
    double x = below_.left() + kBefore_px;
    painter->setFont(font_);
    for (const auto& word : words_) {
        if (word.text.text().isEmpty()) continue;
        painter->setPen(word.colour);
        // Files are drawn at other resolutions than what was laid out.
        if (painter->modes().testFlag(QCPPainter::pmVectorized))
            painter->drawText(QPointF(x, top + metrics.ascent()), word.text.text());
        else
            painter->drawStaticText(QPointF(x, top), word.text);
        x += word.width + kBetween_px;
    }
}

}  // namespace tacto::gui
