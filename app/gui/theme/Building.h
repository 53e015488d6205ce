// Building.h - what pages are built of: columns, rows, words and buttons, each in one line.
#pragma once

#include <QBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <initializer_list>
#include <optional>

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

/// One after the other, without stretch.
template <class Holder>
void addAll(Holder& holder, std::initializer_list<QWidget*> parts) {
    for (auto* part : parts) holder.addWidget(part);
}

/// By what it is found, what a screen reader says of it, and its tip. An empty tip changes none.
inline void nameWidget(QWidget& widget, const QString& name, const QString& spoken, const QString& tip = {}) {
    widget.setObjectName(name);
    widget.setAccessibleName(spoken);
    if (!tip.isEmpty()) widget.setToolTip(tip);
}

/// Plain text that wraps.
inline void wrapPlain(QLabel& label) {
    label.setTextFormat(Qt::PlainText);
    label.setWordWrap(true);
}
/// How a label looks, and what its words are: those that are not given stay as Qt has them.
struct LabelLooks {
    QString name = {};  ///< of the object
    Tone tone = Tone::Text;
    std::optional<TextSize> size = {};
    bool strong = false;  ///< with a size
    bool wraps = false;
    bool plain = false;       ///< its words are no markup
    bool selectable = false;  ///< by the mouse
};
template <class Label = QLabel>
Label* makeLabel(const QString& text, const LabelLooks& looks, QWidget* parent) {
    auto* made = new Label(text, parent);
    if (!looks.name.isEmpty()) made->setObjectName(looks.name);
    if (looks.plain) made->setTextFormat(Qt::PlainText);
    made->setWordWrap(looks.wraps);
    if (looks.selectable) made->setTextInteractionFlags(Qt::TextSelectableByMouse);
    if (looks.size) setTextSize(*made, *looks.size, looks.strong);
    if (looks.tone != Tone::Text) setTone(*made, looks.tone);
    return made;
}
/// The title of a part of a page.
inline QLabel* strongLabel(const QString& text, QWidget* parent) {
    return makeLabel(text, {.size = TextSize::Body, .strong = true}, parent);
}
/// No key but its own presses it.
inline QPushButton* pageButton(const QString& text, const QString& name, const QString& tip, QWidget* parent) {
    auto* made = new QPushButton(text, parent);
    made->setObjectName(name);
    made->setToolTip(tip);
    made->setAutoDefault(false);
    return made;
}

/// A table that shows, whose rows have no numbers, and which Tab leaves.
template <class Table>
void makeReadOnly(Table& table) {
    table.verticalHeader()->hide();
    table.setEditTriggers(Table::NoEditTriggers);
    table.setTabKeyNavigation(false);
}

}  // namespace tacto::gui
