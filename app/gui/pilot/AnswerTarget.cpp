#include "app/gui/pilot/AnswerTarget.h"

#include <QMouseEvent>
#include <QPainter>
#include <QTouchEvent>

#include "app/gui/theme/Icons.h"
#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {

constexpr double kRadius = 8, kKeyRadius = 4, kEdge = 2;
constexpr double kIconShare = 1.75;  // icon size divided by word size
constexpr double kPadShare = 0.9;
constexpr double kBetweenCaps = 0.4;  // gap between key caps divided by key size
constexpr int kMinText_px = 11;

}  // namespace

AnswerTarget::AnswerTarget(QWidget* parent) : QAbstractButton(parent) {
    setFocusPolicy(Qt::NoFocus);  // the window handles the keys
    setAttribute(Qt::WA_AcceptTouchEvents);
}

void AnswerTarget::setContent(const QString& words, const QStringList& icons, const QString& key, const QString& button,
                              Shape shape) {
    setText(words);
    auto name = key.isEmpty() ? words : tr("%1, key %2").arg(words, key);
    if (!button.isEmpty()) name = tr("%1, button %2").arg(name, button);
    setAccessibleName(name);
    icons_ = icons;
    key_ = key;
    button_ = button;
    shape_ = shape;
    update();
}

void AnswerTarget::setType(int words_px, int key_px) {
    words_px_ = words_px;
    most_px_ = words_px;
    key_px_ = key_px;
    update();
}

void AnswerTarget::limitWords(int px) {
    most_px_ = px;
    update();
}

QFont AnswerTarget::wordFont(int px) const {
    auto font = textFont(TextSize::Body, QFont::DemiBold);
    font.setPixelSize(std::max(1, px));
    return font;
}

int AnswerTarget::keyPx() const { return std::max(kMinText_px, std::min(key_px_, height() / 5)); }

/// Returns the width of a key's cap or of a button's circle.
int AnswerTarget::capWide(const QString& of) const {
    auto font = textFont(TextSize::Body);
    font.setPixelSize(keyPx());
    return of.isEmpty() ? 0 : std::max(int(keyPx() * 1.6), QFontMetrics(font).horizontalAdvance(of) + keyPx() / 2);
}

/// Returns the width that the words leave free on one side, with the margin; 0 if there is no key or button. If words
/// are centred, the key is on the right and the button on the left, so the words stay as large as with the key alone.
int AnswerTarget::capsWide() const {
    if (key_.isEmpty() && button_.isEmpty()) return 0;
    const int margin = keyPx() * 7 / 10;
    if (shape_ == Shape::Stacked) return std::max(capWide(key_), capWide(button_)) + margin;
    const int between = key_.isEmpty() || button_.isEmpty() ? 0 : int(keyPx() * kBetweenCaps);
    return capWide(key_) + between + capWide(button_) + margin;
}

int AnswerTarget::leastPx() const { return std::max(kMinText_px, int(words_px_ * 0.3)); }

int AnswerTarget::fittingPx() const {
    const int least = leastPx();
    for (int px = words_px_; px > least; --px) {
        const QFontMetrics metrics(wordFont(px));
        const int pad = int(px * kPadShare);
        const bool row = shape_ == Shape::Row;
        const int icons = icons_.isEmpty() || !row ? 0 : int(px * kIconShare) + pad / 2;
        const int cap = row ? capsWide() : 0;
        const int high = metrics.height() + (row || icons_.isEmpty() ? 0 : int(px * (kIconShare + 0.9)));
        // If the words reach down to the key, they must fit next to the key.
        const bool low = !row && capsWide() > 0 && (height() + high) / 2 > height() - int(keyPx() * 2.3);
        const int beside = low ? 2 * (capsWide() + keyPx() / 10) : 2 * pad;
        const bool wide = metrics.horizontalAdvance(text()) + icons + cap + beside <= width();
        if (wide && high <= height() - 8) return px;
        // Next to the key, words wrap to two lines before their letters get small.
        const int room = width() - icons - cap - 2 * pad;
        if (row && wrapped(metrics, room).width() <= room && wrapped(metrics, room).height() <= height() - 8) return px;
    }
    return least;
}

QSize AnswerTarget::wrapped(const QFontMetrics& metrics, int room) const {
    return metrics.boundingRect(QRect(0, 0, room, height()), Qt::TextWordWrap, text()).size();
}

QSize AnswerTarget::minimumSizeHint() const {
    const QFontMetrics metrics(wordFont(leastPx()));
    return {metrics.horizontalAdvance(text()) + 8, metrics.height() + 8};
}

bool AnswerTarget::event(QEvent* event) {
    if (event->type() == QEvent::TouchBegin) {
        emit wentDown(timeOf(*static_cast<QTouchEvent*>(event)));
        event->accept();  // so that the mouse does not report the same press again
        return true;
    }
    if (event->type() == QEvent::TouchEnd || event->type() == QEvent::TouchCancel) {
        emit cameUp();
        event->accept();
        return true;
    }
    return QAbstractButton::event(event);
}

void AnswerTarget::mousePressEvent(QMouseEvent* event) {
    if (event->button() == Qt::LeftButton) emit wentDown(timeOf(*event));
}

void AnswerTarget::mouseReleaseEvent(QMouseEvent* event) {
    if (event->button() == Qt::LeftButton) emit cameUp();
}

void AnswerTarget::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const auto& c = colours();
    const bool on = isChecked() || isDown();
    painter.setPen(QPen(on ? c.text : c.edge, on ? 2 * kEdge : kEdge));
    painter.setBrush(on ? c.selection : c.base);
    painter.drawRoundedRect(QRectF(rect()).adjusted(1, 1, -1, -1), kRadius, kRadius);

    const int px = wordsPx();
    const QFontMetrics words(wordFont(px));
    const int icon = int(px * kIconShare), pad = int(px * kPadShare);
    const auto put = [&](const QString& name, int x, int y) {
        painter.drawPixmap(x, y, iconPixmap(name, c.text, icon, devicePixelRatioF()));
    };
    painter.setFont(wordFont(px));
    painter.setPen(c.text);
    if (shape_ == Shape::Row) {
        int x = pad;
        for (const auto& name : icons_) {
            put(name, x, (height() - icon) / 2);
            x += icon + pad / 2;
        }
        const int cap = capsWide();
        const bool oneLine = words.horizontalAdvance(text()) + cap <= width() - x;
        painter.drawText(QRect(x, 0, width() - x - (oneLine ? 0 : cap), height()),
                         int(Qt::AlignLeft | Qt::AlignVCenter) | (oneLine ? 0 : int(Qt::TextWordWrap)), text());
    } else {
        const int gap = int(px * 0.9);
        const int high = words.height() + (icons_.isEmpty() ? 0 : icon + gap);
        int y = (height() - high) / 2;
        if (!icons_.isEmpty()) {
            const int row = int(icons_.size()) * icon + (int(icons_.size()) - 1) * gap;
            int x = (width() - row) / 2;
            for (const auto& name : icons_) {
                put(name, x, y);
                x += icon + gap;
            }
            y += icon + gap;
        }
        painter.drawText(QRect(0, y, width(), words.height()), Qt::AlignCenter, text());
    }
    paintCaps(painter);
}

void AnswerTarget::paintCaps(QPainter& painter) const {
    const auto& c = colours();
    auto font = textFont(TextSize::Body);
    const int key_px = keyPx(), margin = key_px * 7 / 10;
    font.setPixelSize(key_px);
    painter.setFont(font);
    const double high = key_px * 1.6;
    const auto put = [&](const QString& label, int left, double radius) {
        if (label.isEmpty()) return;
        const QRectF cap(left + 0.5, height() - margin - high + 0.5, capWide(label), high);
        painter.setPen(QPen(c.edge, 1));
        painter.setBrush(c.base);
        painter.drawRoundedRect(cap, radius, radius);
        painter.setPen(c.quiet);
        painter.drawText(cap, Qt::AlignCenter, label);
    };
    const int keyLeft = width() - margin - capWide(key_);
    put(key_, keyLeft, kKeyRadius);
    const int between = key_.isEmpty() ? 0 : int(key_px * kBetweenCaps);
    put(button_, shape_ == Shape::Stacked ? margin : keyLeft - between - capWide(button_), high / 2);
}

}  // namespace tacto::gui

#include "moc_AnswerTarget.cpp"
