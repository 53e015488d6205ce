// WindowPlace.h - keeps a window on its screen, and puts its parts where they were at first. STOP is in the window's
// corner: no part of the window may lie beyond the screen, even if the screen has changed since.
//
// Thread-safety: the GUI thread.
#pragma once

class QSplitter;
class QWidget;

namespace tacto::gui {

/// Moves and shrinks the window until it lies on its screen; a maximised one is left alone. Before a window is shown
/// its frame is not known: called again after that, it takes the frame off.
void keepOnScreen(QWidget& window);

/// As a splitter shares its room at first: each part what it asks for, what is left by their stretch.
void layOutAnew(QSplitter& splitter);

}  // namespace tacto::gui
