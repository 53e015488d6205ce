#include "app/gui/pilot/ParticipantStop.h"

#include <QMouseEvent>
#include <QPainter>
#include <QTouchEvent>
#include <utility>

#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"
#include "core/pilot/PilotRecord.h"

namespace tacto::gui {

namespace {

constexpr double kStopRadius = 8;
constexpr int kMinFoot_px = 11;

/// Returns the font in the largest size, up to `px`, at which `words` fit the width `room`.
QFont fitted(const QString& words, QFont font, int px, int room) {
    font.setPixelSize(std::max(1, px));
    while (font.pixelSize() > 8 && QFontMetrics(font).horizontalAdvance(words) > room)
        font.setPixelSize(font.pixelSize() - 1);
    return font;
}

}  // namespace

ParticipantStop::ParticipantStop(std::function<void()> stop, QWidget* parent)
    : QAbstractButton(parent), stop_(std::move(stop)) {
    setObjectName("participantStop");
    setText(word("stop.word"));
    sayIt();
    setFocusPolicy(Qt::NoFocus);
    setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Expanding);  // in a row the button is as high as the row
    setAttribute(Qt::WA_AcceptTouchEvents);
}

void ParticipantStop::setType(int word_px, int lines_px) {
    word_px_ = word_px;
    lines_px_ = lines_px;
    update();
}

void ParticipantStop::setWords(const ParticipantWords& words) {
    words_ = words;
    setText(word("stop.word"));
    sayIt();
}

QString ParticipantStop::word(std::string_view key) const { return qtext(words_.text(key)); }

QString ParticipantStop::buttonWords() const {
    if (buttons_.isEmpty()) return {};
    if (buttons_.first().isEmpty()) return " · " + word("stop.pedal");
    const auto all = buttons_.join(QString(" %1 ").arg(word("stop.or"))).toStdString();
    return " · " + qtext(words_.text("stop.button", {{"button", all}}));
}

QString ParticipantStop::leftWords() const {
    return qtext(words_.text("stop.left",
                             {{"left", fmt::format("{}", left_)}, {"of", fmt::format("{}", kMaxParticipantStops)}}));
}

void ParticipantStop::setButtons(const QStringList& buttons) {
    buttons_ = buttons;
    sayIt();
}

void ParticipantStop::setLeft(int left) {
    if (std::exchange(left_, left) != left) sayIt();
}

void ParticipantStop::setOperators() {
    operators_ = true;
    setToolTip(
        tr("The operator’s: the output is off at once, and the session is interrupted. It can go on within 2 h."));
    sayIt();
}

void ParticipantStop::sayIt() {
    const auto whose = operators_ ? tr("STOP, the operator’s: interrupts the session")
                                  : QString("%1%2, %3").arg(text(), buttonWords(), leftWords());
    setAccessibleName(whose);
    drawnFor_ = {};
    update();
}

void ParticipantStop::press() {
    stop_();
    setDown(true);
    update();
}

bool ParticipantStop::event(QEvent* event) {
    if (event->type() == QEvent::TouchBegin) {
        press();
        event->accept();
        return true;
    }
    if (event->type() == QEvent::TouchEnd || event->type() == QEvent::TouchCancel ||
        event->type() == QEvent::MouseButtonRelease)
        setDown(false);
    return QAbstractButton::event(event);
}

void ParticipantStop::mousePressEvent(QMouseEvent* /*event*/) { press(); }  // any mouse button stops

void ParticipantStop::paintEvent(QPaintEvent* /*event*/) {
    const auto plain = stateStyle(InterlockState::Faulted).ground;
    const auto ground = isDown() ? plain.darker(130) : plain;
    const Looks looks(size(), devicePixelRatioF(), ground.rgb(), buttons_, word_px_, lines_px_);
    if (std::exchange(drawnFor_, looks) != looks) drawn_ = draw(ground);
    QPainter(this).drawPixmap(0, 0, drawn_);
}

QPixmap ParticipantStop::draw(const QColor& ground) const {
    QPixmap drawn(size() * devicePixelRatioF());
    drawn.setDevicePixelRatio(devicePixelRatioF());
    drawn.fill(Qt::transparent);
    QPainter painter(&drawn);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(Qt::NoPen);
    painter.setBrush(ground);
    painter.drawRoundedRect(rect(), kStopRadius, kStopRadius);
    painter.setPen(stateStyle(InterlockState::Faulted).ink);
    const int room = width() * 9 / 10;
    const auto leftText = leftWords();
    auto keys = operators_ ? tr("interrupts the session") : word("stop.keys") + buttonWords();
    const auto longest = word("stop.at-once");
    const auto foot =
        operators_ ? QString() : longest + '\n' + qtext(words_.text("stop.yours", {{"left", leftText.toStdString()}}));
    const auto word = fitted(text(), textFont(TextSize::Display, QFont::Bold), word_px_, room);
    auto lines = fitted(longest, textFont(TextSize::Body), lines_px_, room);
    const int footHigh = QFontMetrics(lines).lineSpacing() * 2 + QFontMetrics(lines).descent();
    const QFontMetrics above(word);
    const bool hasFoot = !operators_ && QFontMetrics(lines).horizontalAdvance(longest) <= room &&
                         lines.pixelSize() >= kMinFoot_px &&
                         height() > above.height() + 3 * footHigh + lines.pixelSize() * 2;
    if (!hasFoot && !operators_) keys += " · " + leftText;
    if (!hasFoot) lines = fitted(keys, lines, lines_px_, room);
    const QFontMetrics below(lines);
    const int top = int((height() - above.height() - below.height()) * 0.43);
    painter.setFont(word);
    painter.drawText(QRect(0, top, width(), above.height()), Qt::AlignCenter, text());
    painter.setFont(lines);
    painter.drawText(QRect(0, top + above.height(), width(), below.height()), Qt::AlignCenter, keys);
    if (hasFoot)
        painter.drawText(QRect(0, height() - footHigh - lines.pixelSize() * 3 / 2, width(), footHigh),
                         Qt::AlignHCenter | Qt::AlignTop, foot);
    return drawn;
}

}  // namespace tacto::gui

#include "moc_ParticipantStop.cpp"
