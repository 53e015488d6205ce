#include "app/gui/window/LimitBarRow.h"

#include <algorithm>

namespace tacto::gui {

namespace {
constexpr int kGap = 16;
constexpr double kStaysFor = 0.2;  // of the limit
}  // namespace

LimitBarRow::LimitBarRow(const QStringList& titles, QWidget* parent) : QWidget(parent) {
    for (const auto& title : titles) bars_.push_back(new LimitBar(title, this));
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Preferred);
}

QSize LimitBarRow::sizeHint() const {
    const auto one = bars_.front()->sizeHint();
    return {int(bars_.size()) * (one.width() + kGap) - kGap, one.height()};
}

void LimitBarRow::resizeEvent(QResizeEvent*) { arrange(); }

int LimitBarRow::oneBarWidth() const { return bars_.front()->minimumSizeHint().width(); }

void LimitBarRow::arrange() {
    const auto one = bars_.front()->sizeHint();
    const auto room = contentsRect();
    auto fit = std::min(bars_.size(), std::size_t((room.width() + kGap) / (one.width() + kGap)));
    if (fit == 0 && room.width() >= oneBarWidth()) fit = 1;
    std::vector<LimitBar*> nearest = bars_;
    // A share that is not a number (no value yet, no limit) comes last; among equals the order of the row holds.
    std::stable_sort(nearest.begin(), nearest.end(), [this](const auto* a, const auto* b) {
        const auto rank = [this](const LimitBar* bar) {
            if (std::isnan(bar->share())) return -1.0;
            return bar->share() + (std::ranges::find(seen_, bar) != seen_.end() ? kStaysFor : 0);
        };
        return rank(a) > rank(b);
    });
    nearest.resize(fit);
    seen_ = nearest;
    const int wide = fit > 0 ? (room.width() + kGap) / int(fit) - kGap : 0;
    int left = room.left();
    for (auto* bar : bars_) {
        const bool seen = std::find(nearest.begin(), nearest.end(), bar) != nearest.end();
        bar->setVisible(seen);
        if (!seen) continue;
        bar->setGeometry(left, (height() - one.height()) / 2, wide, one.height());
        left += wide + kGap;
    }
}

}  // namespace tacto::gui
