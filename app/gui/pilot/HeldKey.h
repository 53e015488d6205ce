// HeldKey.h - whether a key is still down though its window heard that it came up.
//
// X repeats a held key as pairs of a release and a press. Qt marks a pair as repeated only where both wait for it at
// once; otherwise it hands on a release of a key that is still held. Letting go is a STOP, so the server is asked.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QKeyEvent>

namespace tacto::gui {

/// Asks the X server, which has just sent `released`: a round trip on this computer. False on any other platform, where
/// repeats are marked. A key that was pressed again before its release is heard counts as held: its next one is heard.
[[nodiscard]] bool isStillDown(const QKeyEvent& released);

}  // namespace tacto::gui
