#include "app/gui/theme/ProgressBar.h"

#include <QStyleOptionProgressBar>
#include <QStylePainter>

#include "app/gui/theme/Colours.h"

namespace tacto::gui {

/// The words twice, each time clipped to the ground that they stand out from.
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
