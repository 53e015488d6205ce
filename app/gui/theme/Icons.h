// Icons.h - the icons of resources/icons in the theme's colours: lines on a grid of 24 px, drawn at 16 to 32 px.
//
// An icon gets its colour when it is painted, so it follows a change of theme by itself.
#pragma once

#include <QIcon>
#include <QPixmap>
#include <QString>

namespace tacto::gui {

enum class Ink {
    Text,     ///< the colour of text, also if disabled
    Primary,  ///< the colour of text on the primary fill
};

/// `name`: the file name without its ending ("state-armed"). Returns a null icon if there is no such file.
[[nodiscard]] QIcon icon(const QString& name, Ink ink = Ink::Text);

/// An icon in one colour, `size` logical pixels wide and high, sharp on a screen with the pixel ratio `scale`.
[[nodiscard]] QPixmap iconPixmap(const QString& name, const QColor& colour, int size, double scale);

}  // namespace tacto::gui
