#include "app/gui/pilot/PhaseBar.h"

#include <QPainter>
#include <array>
#include <cmath>

#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {

constexpr std::array kPhases{QT_TRANSLATE_NOOP("PhaseBar", "get ready"), QT_TRANSLATE_NOOP("PhaseBar", "trains"),
                             QT_TRANSLATE_NOOP("PhaseBar", "answer"), QT_TRANSLATE_NOOP("PhaseBar", "rest")};
constexpr std::array kParts{0.127, 0.311, 0.408, 0.154};  // shares of the width, as in the design's picture
constexpr int kPhaseHigh = 32, kBelow = 10, kShareHigh = 6, kBetween = 8, kPad = 12;

/// Returns the widths of the phases in `room`; a phase too narrow for its words takes space from wider ones.
std::array<double, kParts.size()> widthsIn(double room) {
    const QFontMetricsF metrics(textFont(TextSize::Body, QFont::DemiBold));
    std::array<double, kParts.size()> widths{}, spare{};
    double missing = 0, spared = 0;
    for (std::size_t i = 0; i < kParts.size(); ++i) {
        widths[i] = room * kParts[i];
        spare[i] = widths[i] - std::ceil(metrics.horizontalAdvance(PhaseBar::tr(kPhases[i]))) - 2 * scaledPx(kPad) - 2;
        (spare[i] < 0 ? missing : spared) += std::abs(spare[i]);
    }
    if (missing <= 0 || spared < missing) return widths;
    for (std::size_t i = 0; i < kParts.size(); ++i) widths[i] -= spare[i] < 0 ? spare[i] : spare[i] * missing / spared;
    return widths;
}

}  // namespace

PhaseBar::PhaseBar(QWidget* parent) : QWidget(parent) {
    setAccessibleName(tr("Phase of the trial"));
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
}

void PhaseBar::setPhase(Phase phase, std::optional<double> left_s, std::optional<double> share) {
    if (phase == phase_ && left_s == left_s_ && share == share_) return;
    phase_ = phase;
    left_s_ = left_s;
    share_ = share;
    setAccessibleDescription(phase == kNone ? QString() : tr(kPhases[std::size_t(phase)]));
    update();
}

QSize PhaseBar::sizeHint() const { return {400, scaledPx(kPhaseHigh) + kBelow}; }

void PhaseBar::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const auto& c = colours();
    const int high = scaledPx(kPhaseHigh), pad = scaledPx(kPad);
    const auto widths = widthsIn(width() - kBetween * double(kParts.size() - 1));
    double x = 0;
    for (std::size_t i = 0; i < kParts.size(); ++i) {
        const QRectF box(x + 0.5, 0.5, widths[i] - 1, high - 1);
        const bool now = int(i) == phase_, before = phase_ != kNone && int(i) < phase_;
        painter.setPen(QPen(now ? c.primary : c.line, 1));
        painter.setBrush(now ? c.primary : before ? c.selection : c.base);
        painter.drawRoundedRect(box, 4, 4);
        painter.setFont(textFont(TextSize::Body, now ? QFont::DemiBold : QFont::Normal));
        painter.setPen(now ? c.primaryText : c.text);
        const auto words = box.adjusted(pad, 0, -pad, 0);
        painter.drawText(words, Qt::AlignLeft | Qt::AlignVCenter,
                         painter.fontMetrics().elidedText(tr(kPhases[i]), Qt::ElideRight, int(words.width())));
        if (now && left_s_) {
            painter.setFont(textFont(TextSize::Body));
            const auto left = tr("%1 left").arg(quantityText(*left_s_, "s", *left_s_ < 10 ? 2 : 3));
            if (painter.fontMetrics().horizontalAdvance(left) < words.width() / 2)
                painter.drawText(words, Qt::AlignRight | Qt::AlignVCenter, left);
        }
        if (now && share_) {
            const QRectF trough(x, high + kBelow - kShareHigh, widths[i], kShareHigh);
            painter.fillRect(trough, c.sunken);
            painter.fillRect(QRectF(trough.topLeft(), QSizeF(trough.width() * *share_, kShareHigh)), c.bar);
        }
        x += widths[i] + kBetween;
    }
}

}  // namespace tacto::gui

#include "moc_PhaseBar.cpp"
