#include "app/gui/calibrate/ToleranceCard.h"

#include <QPainter>

#include "app/gui/theme/Icons.h"
#include "app/gui/theme/Theme.h"
#include "app/gui/theme/VerdictBlock.h"
#include "app/report/NumberText.h"
#include "app/report/TableContent.h"

namespace tacto::gui {

namespace {

constexpr int kCardWidth = 176, kNarrowCard = 64, kCardPad = 12, kCardTop = 9, kCardBar = 7, kCardIcon = 14;
constexpr int kLowPad = 4, kLowBar = 4;
constexpr int kOneLineFrom = 320;  // width from which place and tolerance are on one line
constexpr double kNearTolerance = 0.8;

}  // namespace

ToleranceCard::ToleranceCard(const QString& title, QWidget* parent) : QAbstractButton(parent) {
    setText(title);
    setAccessibleName(title);
    setCheckable(true);
    setAutoExclusive(true);
    setFocusPolicy(Qt::StrongFocus);
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    onFontChange(*this, [this] { updateGeometry(); });
}

void ToleranceCard::setShape(Shape shape) {
    if (std::exchange(shape_, shape) == shape) return;
    updateGeometry();
    update();
}

void ToleranceCard::show(const CalibrationReadings& of) {
    verdict_ = of.verdict;
    const auto* use = of.nearest();
    share_ = use != nullptr ? use->share() : 0;
    large_ = use != nullptr ? limitShareText(100 * share_) : tr("%1 readings").arg(of.readings.size());
    beside_ = use != nullptr ? tr("of the tolerance used") : QString();
    where_ = use != nullptr
                 ? tr("at %1: %2")
                       .arg(settingText(use->commanded, of.unit), uncertainText(use->error, use->expanded, of.unit))
                 : QString();
    tolerance_ = use != nullptr ? tr("tolerance ± %1").arg(settingText(use->tolerance, of.unit)) : QString();
    whereOf_ = use != nullptr ? tr("%1 of ± %2").arg(where_, settingText(use->tolerance, of.unit)) : QString();
    const auto said = QStringList{verdict_, (large_ + ' ' + beside_).trimmed(), where_, tolerance_}.join("; ");
    setToolTip(tr("%1: %2. Shows it in the plot.").arg(text(), said));
    setAccessibleDescription(said);
    update();
}

int ToleranceCard::heightOf(Shape shape) const {
    const int body = QFontMetrics(textFont(TextSize::Body)).height();
    const int small = QFontMetrics(textFont(TextSize::Small)).height();
    switch (shape) {
        case Shape::OneLine:
            return body + scaledPx(kLowBar) + 3 * kLowPad;
        case Shape::TwoLines:
            return body + scaledPx(kLowBar) + small + 4 * kLowPad;
        case Shape::Large:
            break;
    }
    return body + QFontMetrics(textFont(TextSize::Large)).height() + scaledPx(kCardBar) + (oneLine() ? 1 : 2) * small +
           2 * kCardTop + 4;
}

int ToleranceCard::wordedWidth() const {
    const QFontMetrics body(textFont(TextSize::Body, QFont::DemiBold));
    const QFontMetrics small(textFont(TextSize::Small, QFont::DemiBold));
    const int verdict = verdict_.isEmpty() ? 0 : scaledPx(kCardIcon) + small.horizontalAdvance(verdict_) + 4 + kCardPad;
    return 2 * kCardPad + body.horizontalAdvance(text() + "  " + large_) + verdict;
}

QSize ToleranceCard::sizeHint() const { return {scaledPx(kCardWidth), heightOf(shape_)}; }

QSize ToleranceCard::minimumSizeHint() const { return {scaledPx(kNarrowCard), sizeHint().height()}; }

bool ToleranceCard::oneLine() const { return width() >= scaledPx(kOneLineFrom); }

void ToleranceCard::resizeEvent(QResizeEvent* event) {
    QAbstractButton::resizeEvent(event);
    if (event->size().width() != event->oldSize().width()) updateGeometry();
}

void ToleranceCard::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter(this);
    const auto& c = colours();
    painter.setRenderHint(QPainter::Antialiasing);
    const bool chosen = isChecked();
    const double pen = chosen ? 2 : 1;
    painter.setPen(QPen(chosen ? c.text : hasFocus() ? c.edge : c.line, pen));
    painter.setBrush(underMouse() && !chosen ? c.sunken : c.base);
    painter.drawRoundedRect(QRectF(rect()).adjusted(pen / 2, pen / 2, -pen / 2, -pen / 2), 4, 4);
    painter.setRenderHint(QPainter::Antialiasing, false);
    shape_ == Shape::Large ? paintLarge(painter) : paintLines(painter);
}

/// Paints title, share and verdict on one line, the bar below, then the place of the largest share.
void ToleranceCard::paintLines(QPainter& painter) const {
    auto line = rect().adjusted(kCardPad, kLowPad, -kCardPad, -kLowPad);
    const QFontMetrics body(textFont(TextSize::Body, QFont::DemiBold));
    QRect head(line.left(), line.top(), line.width(), body.height());
    head.setRight(head.right() - paintVerdict(painter, head, body.horizontalAdvance(text() + "  " + large_)));
    painter.setFont(textFont(TextSize::Body, QFont::DemiBold));
    painter.setPen(colours().text);
    painter.drawText(head, Qt::AlignRight | Qt::AlignVCenter, large_);
    head.setRight(head.right() - body.horizontalAdvance(large_) - kCardPad);
    painter.drawText(head, Qt::AlignLeft | Qt::AlignVCenter, body.elidedText(text(), Qt::ElideRight, head.width()));
    const int high = scaledPx(kLowBar);
    const QRect bar(line.left(), head.bottom() + 1 + kLowPad, line.width(), high);
    paintBar(painter, bar);
    if (shape_ == Shape::OneLine) return;
    const auto font = textFont(TextSize::Small);
    const QFontMetrics small(font);
    const QRect below(line.left(), bar.bottom() + 1 + kLowPad, line.width(), small.height());
    painter.setFont(font);
    painter.setPen(colours().text);
    painter.drawText(below, Qt::AlignLeft | Qt::AlignVCenter,
                     small.elidedText(whereOf_, Qt::ElideRight, below.width()));
}

void ToleranceCard::paintLarge(QPainter& painter) const {
    const auto& c = colours();
    auto line = rect().adjusted(kCardPad, kCardTop, -kCardPad, -kCardTop);
    const auto write = [&](const QFont& font, const QColor& ink, const QString& text, int from = 0) {
        painter.setFont(font);
        painter.setPen(ink);
        const auto metrics = painter.fontMetrics();
        const QRect place(line.left() + from, line.top(), line.width() - from, metrics.height());
        painter.drawText(place, Qt::AlignLeft | Qt::AlignVCenter,
                         metrics.elidedText(text, Qt::ElideRight, place.width()));
        return metrics.horizontalAdvance(text);
    };
    const auto title = textFont(TextSize::Body, QFont::DemiBold);
    const QRect head(line.left(), line.top(), line.width(), QFontMetrics(title).height());
    const int taken = paintVerdict(painter, head, QFontMetrics(title).horizontalAdvance(text()));
    painter.setFont(title);
    painter.setPen(c.text);
    painter.drawText(head, Qt::AlignLeft | Qt::AlignVCenter,
                     painter.fontMetrics().elidedText(text(), Qt::ElideRight, head.width() - taken));
    line.setTop(line.top() + QFontMetrics(title).height());
    const auto large = textFont(TextSize::Large, QFont::DemiBold), small = textFont(TextSize::Small);
    const int wide = write(large, c.text, large_);
    const int high = QFontMetrics(large).height();
    const int drop = high - QFontMetrics(small).height() - 3;
    line.setTop(line.top() + drop);
    write(small, c.quiet, beside_, wide + 6);
    line.setTop(line.top() - drop + high);
    paintBar(painter, {line.left(), line.top(), line.width(), scaledPx(kCardBar)});
    line.setTop(line.top() + scaledPx(kCardBar) + 3);
    const int where = write(small, c.text, where_);
    if (oneLine()) {
        write(small, c.quiet, tolerance_, where + 2 * kCardPad);
    } else {
        line.setTop(line.top() + QFontMetrics(small).height());
        write(small, c.quiet, tolerance_);
    }
}

/// Paints the verdict at the right of `head` and returns its width. The word is painted only if it leaves the width
/// `wanted` for the text at the left (wordedWidth()); otherwise the verdict above and the tool tip show the word.
int ToleranceCard::paintVerdict(QPainter& painter, const QRect& head, int wanted) const {
    if (verdict_.isEmpty()) return 0;
    const auto style = verdictStyle(verdict_);
    const auto small = textFont(TextSize::Small, QFont::DemiBold);
    const int size = scaledPx(kCardIcon), word = QFontMetrics(small).horizontalAdvance(verdict_) + 4;
    const bool room = wanted + size + word + kCardPad <= head.width();
    const int taken = size + (room ? word : 0) + 4;
    painter.setFont(small);
    painter.setPen(style.colour);
    if (room) painter.drawText(head, Qt::AlignRight | Qt::AlignVCenter, verdict_);
    painter.drawPixmap(head.right() - taken + 4, head.center().y() - size / 2,
                       iconPixmap(style.icon, style.colour, size, devicePixelRatioF()));
    return taken;
}

void ToleranceCard::paintBar(QPainter& painter, const QRect& bar) const {
    const auto& c = colours();
    painter.setPen(Qt::NoPen);
    painter.setBrush(c.sunken);
    painter.drawRect(bar);
    painter.setBrush(share_ > 1 ? c.fail : share_ >= kNearTolerance ? c.amber : c.bar);
    painter.drawRect(QRect(bar.topLeft(), QSize(int(bar.width() * std::clamp(share_, 0.0, 1.0)), bar.height())));
}

}  // namespace tacto::gui

#include "moc_ToleranceCard.cpp"
