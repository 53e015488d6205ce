// LookChange.h - what a widget does when the theme or the size of text changes.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QWidget>
#include <functional>

namespace tacto::gui {

/// Calls `follow` from now on whenever `widget` has another palette or another font.
void onLookChange(QWidget& widget, std::function<void()> follow);
/// The same for another font alone.
void onFontChange(QWidget& widget, std::function<void()> follow);

/// Calls `follow` in the next turn of the event loop after a change of palette, font or style, when the widgets within
/// have it too: for one that gives them fonts, places or a style sheet of its own. (The theme's new sheet takes them
/// those fonts; a sheet that is set while the theme's is being laid may keep the colours of the theme before.)
void afterLookChange(QWidget& widget, std::function<void()> follow);

/// Bounds of a widget's width that grow and shrink with the size of text: pixels of text at 100 % (scaledPx()).
void boundWidth(QWidget& widget, int atMost_px);
void fixWidth(QWidget& widget, int px);

}  // namespace tacto::gui
