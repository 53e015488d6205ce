// Building.h - functions that make the parts of a page (columns, rows, labels, buttons) in one line each.
#pragma once

#include <QBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <initializer_list>
#include <optional>

#include "app/gui/theme/Theme.h"

namespace tacto::gui {

/// Gives `in` a layout. `spacing` -1: the style's own spacing.
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

/// Adds all parts in order, without stretch.
template <class Holder>
void addAll(Holder& holder, std::initializer_list<QWidget*> parts) {
    for (auto* part : parts) holder.addWidget(part);
}

/// Sets the object name, the name for screen readers, and the tool tip. An empty `tip` leaves the tool tip as it is.
inline void nameWidget(QWidget& widget, const QString& name, const QString& spoken, const QString& tip = {}) {
    widget.setObjectName(name);
    widget.setAccessibleName(spoken);
    if (!tip.isEmpty()) widget.setToolTip(tip);
}

/// Shows the text without markup and wraps it.
inline void wrapPlain(QLabel& label) {
    label.setTextFormat(Qt::PlainText);
    label.setWordWrap(true);
}
/// The look of a label. Members that are not given keep Qt's default.
struct LabelLooks {
    QString name = {};  ///< object name
    Tone tone = Tone::Text;
    std::optional<TextSize> size = {};
    bool strong = false;  ///< bold; only with a size
    bool wraps = false;
    bool plain = false;       ///< the text is shown without markup
    bool selectable = false;  ///< the text can be selected with the mouse
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
/// Makes the title of a part of a page.
inline QLabel* strongLabel(const QString& text, QWidget* parent) {
    return makeLabel(text, {.size = TextSize::Body, .strong = true}, parent);
}
/// Makes a button that Return in another widget does not press.
inline QPushButton* pageButton(const QString& text, const QString& name, const QString& tip, QWidget* parent) {
    auto* made = new QPushButton(text, parent);
    made->setObjectName(name);
    made->setToolTip(tip);
    made->setAutoDefault(false);
    return made;
}

/// Makes a table read-only, hides its row numbers, and lets Tab leave it.
template <class Table>
void makeReadOnly(Table& table) {
    table.verticalHeader()->hide();
    table.setEditTriggers(Table::NoEditTriggers);
    table.setTabKeyNavigation(false);
}

}  // namespace tacto::gui
