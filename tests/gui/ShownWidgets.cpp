#include "tests/gui/ShownWidgets.h"

#include <QStyle>
#include <QStyleOptionFrame>
#include <QToolButton>

namespace tacto::test {

QString called(const QWidget& widget) {
    auto name = QString("%1 %2").arg(widget.metaObject()->className(), widget.objectName());
    const auto* at = &widget;
    while (at->parentWidget() != nullptr && at->objectName().isEmpty()) at = at->parentWidget();
    return at == &widget ? name : QString("%1in %2 %3").arg(name, at->metaObject()->className(), at->objectName());
}

QSize roomForText(const QLineEdit& edit) {
    QStyleOptionFrame option;
    option.initFrom(&edit);
    option.rect = edit.contentsRect();
    option.lineWidth = edit.hasFrame() ? edit.style()->pixelMetric(QStyle::PM_DefaultFrameWidth, &option, &edit) : 0;
    option.state |= QStyle::State_Sunken;
    const auto inside = edit.style()->subElementRect(QStyle::SE_LineEditContents, &option, &edit);
    auto room = inside.marginsRemoved(edit.textMargins()).size();
    for (const auto* button : edit.findChildren<QToolButton*>())
        if (button->isVisible()) room.rwidth() -= button->width();
    return room;
}

QString cutOf(const QString& what, const QWidget& at, int has, int needs) {
    return QString("\"%1\" in %2: %3 of %4 px").arg(what, called(at)).arg(has).arg(needs);
}

}  // namespace tacto::test
