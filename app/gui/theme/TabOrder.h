// TabOrder.h - the order of Tab where widgets are made late: Qt puts each one that is made at the end of its window.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QWidget>

namespace tacto::gui {

/// Tab goes from `before` through what stands in `place`, in the order in which that was made, and then to what came
/// after `before`. Call it again when `place` holds something new. Neither has to take the focus itself.
void tabAfter(QWidget& before, QWidget& place);
/// The same where `place` itself stands in the order.
inline void tabInPlace(QWidget& place) { tabAfter(place, place); }

}  // namespace tacto::gui
