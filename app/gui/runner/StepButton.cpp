#include "app/gui/runner/StepButton.h"

#include <QPainter>

#include "app/gui/theme/Icons.h"
#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {

constexpr int kStepWidth = 224, kStepHeight = 56, kStepLow = 36;
constexpr int kShapeLeft = 24, kShape = 16, kWordsLeft = 48, kChosenBar = 4, kDot = 12;
constexpr int kAcrossHeight = 40, kAcrossSide = 12, kAloneSide = 8, kAcrossDot = 20, kAcrossGap = 8;

}  // namespace

StepButton::StepButton(const QString& name, int number, Place place, QWidget* parent)
    : QAbstractButton(parent), number_(number), place_(place) {
    setCheckable(true);
    setAutoExclusive(true);
    setFocusPolicy(Qt::TabFocus);
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    setName(name);
    onFontChange(*this, [this] { updateGeometry(); });
}

void StepButton::setName(const QString& name) {
    setText(name);
    setAccessibleName(name);
    updateGeometry();
    say();
}

void StepButton::setNumber(int number) {
    if (std::exchange(number_, number) != number) update();
}

void StepButton::setState(StepList::State state) {
    if (std::exchange(state_, state) != state) say();
}

void StepButton::setNote(const QString& note) {
    if (std::exchange(note_, note) != note) say();
}

void StepButton::setOutOfReach(const QString& why) {
    outOfReach_ = why;
    setEnabled(why.isEmpty());
    say();
}

void StepButton::setLow(bool low) {
    if (std::exchange(low_, low) != low) updateGeometry();
}

void StepButton::setAcross(bool across, bool named) {
    if (std::exchange(across_, across) != across) updateGeometry();
    if (std::exchange(named_, named) != named) update();
}

int StepButton::widthAcross(bool named) const {
    const int dot = scaledPx(kAcrossDot);
    if (!named) return 2 * scaledPx(kAloneSide) + dot;
    const QFontMetrics name(textFont(TextSize::Body, QFont::DemiBold));  // bold, like the name of the current step
    return 2 * scaledPx(kAcrossSide) + dot + scaledPx(kAcrossGap) + name.horizontalAdvance(text()) + 1;
}

void StepButton::say() {
    const auto word = [&] {
        switch (state_) {
            case StepList::State::ToDo:
                return tr("to do");
            case StepList::State::UnderWay:
                return tr("under way");
            case StepList::State::Done:
                return tr("done");
            case StepList::State::Troubled:
                return tr("needs attention");
        }
        return QString();
    }();
    const auto says = note_.isEmpty() ? word : word + ": " + note_;
    setAccessibleDescription(says);
    setToolTip(outOfReach_.isEmpty() ? tr("%1: %2. Shows this step.").arg(text(), says) : outOfReach_);
    update();
}

QSize StepButton::sizeHint() const {
    if (across_) {
        const int name = QFontMetrics(textFont(TextSize::Body)).height();
        return {widthAcross(named_), std::max(scaledPx(kAcrossHeight), name + 8)};
    }
    const int words =
        QFontMetrics(textFont(TextSize::Body)).height() + (low_ ? 0 : QFontMetrics(textFont(TextSize::Small)).height());
    return {scaledPx(kStepWidth), std::max(scaledPx(low_ ? kStepLow : kStepHeight), words + 8)};
}

/// Paints the state: ✔ done, disc under way, ⚠ attention, ring to do. In a row, disc and ring hold the number.
void StepButton::paintShape(QPainter& painter, const QPoint& centre) const {
    const auto& c = colours();
    const int size = scaledPx(kShape);
    const auto place = [&](const QString& icon, const QColor& ink) {
        painter.drawPixmap(centre - QPoint(size / 2, size / 2), iconPixmap(icon, ink, size, devicePixelRatioF()));
    };
    if (state_ == StepList::State::Done) return place("verdict-pass", c.text);
    if (state_ == StepList::State::Troubled) return place("verdict-attention", c.amberText);
    const double radius = scaledPx(across_ ? kAcrossDot : kDot) / 2.0;
    const bool filled = state_ == StepList::State::UnderWay;
    painter.setPen(QPen(filled ? c.text : c.edge, 2));
    painter.setBrush(filled ? QBrush(c.text) : Qt::NoBrush);
    painter.drawEllipse(QPointF(centre), radius - 1, radius - 1);
    if (!across_) return;
    painter.setFont(textFont(TextSize::Small, QFont::DemiBold));
    painter.setPen(filled ? c.base : isEnabled() ? c.text : c.quiet);
    painter.drawText(QRectF(centre.x() - radius, centre.y() - radius, 2 * radius, 2 * radius), Qt::AlignCenter,
                     QString::number(number_));
}

void StepButton::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    paintGround(painter);
    across_ ? paintAcross(painter) : paintDown(painter);
    if (!hasFocus() || !window()->testAttribute(Qt::WA_KeyboardFocusChange)) return;
    painter.setPen(QPen(colours().text, 2));
    painter.setBrush(Qt::NoBrush);
    painter.drawRect(rect().adjusted(1, 1, -1, -1));
}

void StepButton::paintGround(QPainter& painter) const {
    const auto& c = colours();
    if (isChecked() && isEnabled()) {
        painter.fillRect(rect(), c.selection);
        const QRect below(0, height() - kChosenBar, width(), kChosenBar), left(0, 0, kChosenBar, height());
        painter.fillRect(across_ ? below : left, c.primary);
    } else if (underMouse() && isEnabled()) {
        painter.fillRect(rect(), c.sunken);
    }
}

void StepButton::paintAcross(QPainter& painter) const {
    const auto& c = colours();
    const int dot = scaledPx(kAcrossDot), side = scaledPx(named_ ? kAcrossSide : kAloneSide);
    paintShape(painter, {side + dot / 2, height() / 2});
    if (!named_) return;
    painter.setFont(textFont(TextSize::Body, isChecked() ? QFont::DemiBold : QFont::Normal));
    painter.setPen(isEnabled() ? c.text : c.quiet);
    const int left = side + dot + scaledPx(kAcrossGap);
    painter.drawText(QRect(left, 0, width() - left, height()), Qt::AlignLeft | Qt::AlignVCenter, text());
}

void StepButton::paintDown(QPainter& painter) const {
    const auto& c = colours();
    const auto name = textFont(TextSize::Body, isChecked() ? QFont::DemiBold : QFont::Normal);
    const auto small = textFont(TextSize::Small);
    const QFontMetrics above(name), below(small);
    const bool two = !low_ && !note_.isEmpty();
    const int top = (height() - above.height() - (two ? below.height() : 0)) / 2;
    const QPoint shape(scaledPx(kShapeLeft), top + above.height() / 2);
    // Lines to the previous and the next step.
    painter.setPen(QPen(c.line, 2));
    const int half = scaledPx(kShape) / 2 + 3;
    if (place_ != Place::First) painter.drawLine(shape.x(), 0, shape.x(), shape.y() - half);
    if (place_ != Place::Last) painter.drawLine(shape.x(), shape.y() + half, shape.x(), height());
    paintShape(painter, shape);
    const QRect words(scaledPx(kWordsLeft), top, width() - scaledPx(kWordsLeft) - 8, above.height());
    painter.setFont(name);
    painter.setPen(isEnabled() || isChecked() ? c.text : c.quiet);
    painter.drawText(words, Qt::AlignLeft | Qt::AlignVCenter, above.elidedText(text(), Qt::ElideRight, words.width()));
    if (!two) return;
    painter.setFont(small);
    painter.setPen(state_ == StepList::State::Troubled ? c.amberText : c.quiet);
    painter.drawText(words.translated(0, above.height()), Qt::AlignLeft | Qt::AlignTop,
                     below.elidedText(note_, Qt::ElideRight, words.width()));
}

}  // namespace tacto::gui

#include "moc_StepButton.cpp"
