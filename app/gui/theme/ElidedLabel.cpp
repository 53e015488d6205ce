#include "app/gui/theme/ElidedLabel.h"

#include <QPainter>
#include <QStyle>

namespace tacto::gui {

namespace {
constexpr int kMinLetters = 3;  // fewer before the "…" say nothing
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

}  // namespace tacto::gui
