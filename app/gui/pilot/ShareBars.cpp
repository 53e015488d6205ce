#include "app/gui/pilot/ShareBars.h"

#include <QPainter>
#include <algorithm>
#include <cmath>

#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {
constexpr int kShareGap = 8;
}

std::vector<double> blockShares(int block, int blocks, int trial, int trials) {
    std::vector<double> shares(std::size_t(std::max(0, blocks)), 0.0);
    for (int i = 0; i < blocks; ++i) {
        if (i + 1 < block) shares[std::size_t(i)] = 1;
        if (i + 1 != block || trials < blocks || trial < 1) continue;
        const double each = double(trials) / blocks;
        shares[std::size_t(i)] = std::clamp((trial - 1 - i * each) / each, 0.0, 1.0);
    }
    return shares;
}

ShareBars::ShareBars(QWidget* parent) : QWidget(parent) {}

void ShareBars::setShares(const std::vector<double>& shares) {
    if (shares == shares_) return;
    shares_ = shares;
    update();
}

void ShareBars::paintEvent(QPaintEvent* /*event*/) {
    if (shares_.empty()) return;
    QPainter painter(this);
    const auto& c = colours();
    const auto count = double(shares_.size());
    const double each = (width() - kShareGap * (count - 1)) / count;
    for (std::size_t i = 0; i < shares_.size(); ++i) {
        const QRectF bar(std::round(double(i) * (each + kShareGap)) + 0.5, 0.5, std::floor(each) - 1, height() - 1);
        painter.setPen(QPen(c.line, 1));
        painter.setBrush(c.sunken);
        painter.drawRect(bar);
        painter.setPen(Qt::NoPen);
        painter.setBrush(c.bar);
        const QRectF inside = bar.adjusted(-0.5, -0.5, 0.5, 0.5);
        painter.drawRect(QRectF(inside.topLeft(), QSizeF(inside.width() * shares_[i], inside.height())));
    }
}

}  // namespace tacto::gui

#include "moc_ShareBars.cpp"
