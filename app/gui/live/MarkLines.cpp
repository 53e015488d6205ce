#include "app/gui/live/MarkLines.h"

#include <algorithm>

#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {

constexpr int kWordChars = 24;
constexpr int kWordPad = 3;

}  // namespace

MarkLines::Drawn MarkLines::make() {
    Drawn drawn;
    for (const auto& strip : strips_) {
        auto* line = new QCPItemStraightLine(&plot_);
        for (auto* point : {line->point1, line->point2}) {
            point->setAxisRect(&strip.axes());
            point->setAxes(&strip.time(), &strip.values());
            point->setTypeX(QCPItemPosition::ptPlotCoords);
            point->setTypeY(QCPItemPosition::ptAxisRectRatio);
        }
        line->setClipAxisRect(&strip.axes());
        drawn.lines.push_back(line);
    }
    drawn.word = new QCPItemText(&plot_);
    drawn.word->setPositionAlignment(Qt::AlignLeft | Qt::AlignTop);
    drawn.word->setPadding(QMargins(kWordPad, 0, kWordPad, 0));
    colour(drawn);
    return drawn;
}

void MarkLines::draw(const std::vector<LiveMark>& marks, const QCPRange& time) {
    std::size_t used = 0;
    const auto top = std::ranges::find_if(strips_, [](const Strip& strip) { return strip.present(); });
    for (const auto& mark : marks) {
        if (!time.contains(mark.t_s) || top == strips_.end()) continue;
        if (used == drawn_.size()) drawn_.push_back(make());
        auto& drawn = drawn_[used++];
        std::size_t i = 0;
        for (const auto& strip : strips_) {
            auto* line = drawn.lines[i++];
            line->point1->setCoords(mark.t_s, 0);
            line->point2->setCoords(mark.t_s, 1);
            line->setVisible(strip.present());
        }
        auto* word = drawn.word;
        word->position->setAxisRect(&top->axes());
        word->position->setAxes(&top->time(), &top->values());
        word->position->setTypeX(QCPItemPosition::ptPlotCoords);
        word->position->setTypeY(QCPItemPosition::ptAxisRectRatio);
        word->setClipAxisRect(&top->axes());
        word->position->setCoords(mark.t_s, 0);
        const QFontMetrics metrics(word->font());
        word->setText(metrics.elidedText(qtext(mark.word), Qt::ElideRight, metrics.averageCharWidth() * kWordChars));
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
