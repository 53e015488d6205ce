#include "app/gui/theme/ElidedLabel.h"

#include <QPainter>
#include <QStyle>

namespace tacto::gui {

void ElidedLabel::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    const auto shown = fontMetrics().elidedText(text(), Qt::ElideRight, contentsRect().width());
    style()->drawItemText(&painter, contentsRect(), int(alignment()), palette(), isEnabled(), shown, foregroundRole());
}

}  // namespace tacto::gui
