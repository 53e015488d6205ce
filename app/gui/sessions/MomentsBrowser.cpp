#include "app/gui/sessions/MomentsBrowser.h"

#include <QAbstractTextDocumentLayout>
#include <QPaintEvent>
#include <QPainter>
#include <QScrollBar>
#include <QTextBlock>
#include <QTextLayout>
#include <algorithm>
#include <cmath>

namespace tacto::gui {

MomentsBrowser::MomentsBrowser(QWidget* parent) : QTextBrowser(parent) {
    document()->setDocumentMargin(0);
    connect(verticalScrollBar(), &QScrollBar::valueChanged, viewport(), qOverload<>(&QWidget::update));
}

QRect MomentsBrowser::whole() const {
    const int from = verticalScrollBar()->value(), to = from + viewport()->height();
    int top = from, bottom = to;
    const auto& places = *document()->documentLayout();
    for (auto block = document()->begin(); block.isValid(); block = block.next()) {
        const auto place = places.blockBoundingRect(block);
        if (place.bottom() < from || place.top() > to) continue;
        for (int i = 0; i < block.layout()->lineCount(); ++i) {
            const auto line = block.layout()->lineAt(i).rect().translated(place.topLeft());
            const int begins = int(std::floor(line.top())), ends = int(std::ceil(line.bottom()));
            if (begins < from && ends > from) top = std::max(top, ends);
            if (begins < to && ends > to) bottom = std::min(bottom, begins);
        }
    }
    if (bottom <= top) return viewport()->rect();  // not one has room
    return {0, top - from, viewport()->width(), bottom - top};
}

void MomentsBrowser::paintEvent(QPaintEvent* event) {
    QPaintEvent within(event->region() & whole());
    QTextBrowser::paintEvent(&within);
}

}  // namespace tacto::gui

#include "moc_MomentsBrowser.cpp"
