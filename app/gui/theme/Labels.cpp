#include "app/gui/theme/Labels.h"

#include <QPainter>
#include <QStyle>
#include <QStyleOptionProgressBar>
#include <QStylePainter>

#include "app/gui/theme/Colours.h"
#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {
constexpr int kMinLetters = 3;  // least number of letters before the "…"; fewer would say nothing
}

QString ElidedLabel::shownText() const {
    const auto shown = fontMetrics().elidedText(text(), Qt::ElideRight, contentsRect().width());
    return shown == text() || shown.size() > kMinLetters ? shown : QString();
}

void ElidedLabel::paintEvent(QPaintEvent*) {
    const auto shown = shownText();
    if (shown.isEmpty()) return;
    QPainter painter(this);
    style()->drawItemText(&painter, contentsRect(), int(alignment()), palette(), isEnabled(), shown, foregroundRole());
}

TroubleLine::TroubleLine(const QString& name, QWidget* parent) : QLabel(parent) {
    setObjectName(name);
    setTextFormat(Qt::PlainText);
    setTextInteractionFlags(Qt::TextSelectableByMouse);
    setWordWrap(true);
    setTone(*this, Tone::Warning);
    hide();
}

void TroubleLine::say(const QString& why) {
    setText(why.isEmpty() ? QString() : "⚠ " + why);
    setVisible(!why.isEmpty());
}

/// Draws the text twice, in two colours, each time clipped to the part of the bar that needs this colour.
void ProgressBar::paintEvent(QPaintEvent* /*event*/) {
    QStyleOptionProgressBar option;
    initStyleOption(&option);
    option.textVisible = false;
    QStylePainter painter(this);
    painter.drawControl(QStyle::CE_ProgressBar, option);
    if (!isTextVisible() || text().isEmpty()) return;
    const auto room = style()->subElementRect(QStyle::SE_ProgressBarContents, &option, this);
    auto filled = room;
    filled.setWidth(int(qint64(room.width()) * (value() - minimum()) / std::max(1, maximum() - minimum())));
    auto empty = room;
    empty.setLeft(filled.right() + 1);
    for (const auto& [part, ink] : {std::pair(filled, colours().base), {empty, colours().text}}) {
        painter.setClipRect(part);
        painter.setPen(ink);
        painter.drawText(room, Qt::AlignCenter, text());
    }
}

}  // namespace tacto::gui
