#include "app/gui/theme/MarkLines.h"

#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {

constexpr int kWordChars = 24;
constexpr int kWordPad = 3;

/// Attaches a position to the plot: its time is the plot's, its height runs from 0 at the top to 1 at the bottom.
void putInto(QCPItemPosition& position, QCPAxisRect& rect) {
    position.setAxisRect(&rect);
    position.setAxes(rect.axis(QCPAxis::atBottom), rect.axis(QCPAxis::atLeft));
    position.setTypeX(QCPItemPosition::ptPlotCoords);
    position.setTypeY(QCPItemPosition::ptAxisRectRatio);
}

}  // namespace

void MarkLines::make(Drawn& drawn, std::size_t lines) {
    while (drawn.lines.size() < lines) drawn.lines.push_back(new QCPItemStraightLine(&plot_));
    if (drawn.word == nullptr) {
        drawn.word = new QCPItemText(&plot_);
        drawn.word->setPositionAlignment(Qt::AlignLeft | Qt::AlignTop);
        drawn.word->setPadding(QMargins(kWordPad, 0, kWordPad, 0));
    }
    colour(drawn);
}

void MarkLines::draw(const std::vector<PlotMark>& marks, const std::vector<QCPAxisRect*>& rects) {
    std::size_t used = 0;
    for (const auto& mark : marks) {
        if (rects.empty() || !rects.front()->axis(QCPAxis::atBottom)->range().contains(mark.t_s)) continue;
        if (used == drawn_.size()) drawn_.emplace_back();
        auto& drawn = drawn_[used++];
        if (drawn.lines.size() < rects.size()) make(drawn, rects.size());
        for (std::size_t i = 0; i < drawn.lines.size(); ++i) {
            auto* line = drawn.lines[i];
            line->setVisible(i < rects.size());
            if (i >= rects.size()) continue;
            for (auto* point : {line->point1, line->point2}) putInto(*point, *rects[i]);
            line->setClipAxisRect(rects[i]);
            line->point1->setCoords(mark.t_s, 0);
            line->point2->setCoords(mark.t_s, 1);
        }
        auto* word = drawn.word;
        putInto(*word->position, *rects.front());
        word->setClipAxisRect(rects.front());
        word->position->setCoords(mark.t_s, 0);
        const QFontMetrics metrics(word->font());
        word->setText(metrics.elidedText(qtext(mark.word), Qt::ElideRight, metrics.averageCharWidth() * kWordChars));
        // The word stands at the left of its line if it would leave the plot at the right.
        const double end = rects.front()->axis(QCPAxis::atBottom)->coordToPixel(mark.t_s) +
                           metrics.horizontalAdvance(word->text()) + 2 * kWordPad;
        word->setPositionAlignment((end > rects.front()->right() ? Qt::AlignRight : Qt::AlignLeft) | Qt::AlignTop);
        word->setVisible(true);
    }
    for (; used < drawn_.size(); ++used) {
        for (auto* line : drawn_[used].lines) line->setVisible(false);
        drawn_[used].word->setVisible(false);
    }
}

void MarkLines::colour() {
    for (const auto& drawn : drawn_) colour(drawn);
}

void MarkLines::colour(const Drawn& drawn) const {
    const auto& c = colours();
    for (auto* line : drawn.lines) line->setPen(QPen(c.text, 1, Qt::DashLine));
    drawn.word->setFont(textFont(TextSize::Small, QFont::DemiBold));
    drawn.word->setColor(c.base);
    drawn.word->setBrush(QBrush(c.text));
}

QStringList MarkLines::words() const {
    QStringList words;
    for (const auto& drawn : drawn_)
        if (drawn.word->visible()) words << drawn.word->text();
    return words;
}

}  // namespace tacto::gui
