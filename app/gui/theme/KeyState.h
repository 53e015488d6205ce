// KeyState.h - whether a key is down now. Qt alone cannot tell: X repeats a held key as pairs of release and press, and
// Qt marks a pair as a repeat only if both wait in the queue at once; and a release that comes while a window closes
// reaches no window of the program.
#pragma once

#include <QtGlobal>
#include <optional>

namespace tacto::gui {

/// Asks the X server, a round trip on this computer; `scanCode`: QKeyEvent::nativeScanCode(). Empty on other platforms,
/// which mark repeats.
[[nodiscard]] std::optional<bool> isKeyDown(quint32 scanCode);

}  // namespace tacto::gui
