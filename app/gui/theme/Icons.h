// Icons.h - the icons of resources/icons in the theme's colours: lines on a grid of 24 px, drawn at 16, 20, 24 or 32.
//
// An icon takes its colour when it is painted, so it follows a change of theme by itself.
#pragma once

#include <QIcon>
#include <QPixmap>
#include <QString>

namespace tacto::gui {

enum class Ink {
    Text,     ///< like words beside it; disabled like disabled words
    Primary,  ///< like words on the primary fill
};

/// `name`: the file's, without its ending ("state-armed"). An icon that is not there is a null icon.
[[nodiscard]] QIcon icon(const QString& name, Ink ink = Ink::Text);

/// An icon in one colour, `size` logical pixels wide and high, sharp on a screen with a pixel ratio of `scale`.
[[nodiscard]] QPixmap iconPixmap(const QString& name, const QColor& colour, int size, double scale);

}  // namespace tacto::gui
