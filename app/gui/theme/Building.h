// Building.h - what pages are built of: columns, rows, words and buttons, each in one line.
#pragma once

#include <QBoxLayout>
#include <QLabel>
#include <QPushButton>

#include "app/gui/theme/Theme.h"

namespace tacto::gui {

/// The layout of `in`. `spacing` -1: the style's own.
template <class Layout>
Layout* layoutIn(QWidget& in, int spacing, const QMargins& margins) {
    auto* made = new Layout(&in);
    made->setContentsMargins(margins);
    if (spacing >= 0) made->setSpacing(spacing);
    return made;
}
inline QVBoxLayout* columnIn(QWidget& in, int spacing = -1, const QMargins& margins = {}) {
    return layoutIn<QVBoxLayout>(in, spacing, margins);
}
inline QHBoxLayout* rowIn(QWidget& in, int spacing = -1, const QMargins& margins = {}) {
    return layoutIn<QHBoxLayout>(in, spacing, margins);
}

/// Plain text that wraps.
inline void wrapPlain(QLabel& label) {
    label.setTextFormat(Qt::PlainText);
    label.setWordWrap(true);
}
/// The title of a part of a page.
inline QLabel* strongLabel(const QString& text, QWidget* parent) {
    auto* made = new QLabel(text, parent);
    setTextSize(*made, TextSize::Body, true);
    return made;
}
/// A button that no key but its own presses.
inline QPushButton* pageButton(const QString& text, const char* name, const QString& tip, QWidget* parent) {
    auto* made = new QPushButton(text, parent);
    made->setObjectName(name);
    made->setToolTip(tip);
    made->setAutoDefault(false);
    return made;
}

}  // namespace tacto::gui
