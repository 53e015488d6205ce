// GrowingDialog.h - a dialog that grows with what it says.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QDialog>

namespace tacto::gui {

/// From now on the dialog grows as far as the screen allows when its content needs more room: a text that got longer,
/// or larger, is not cut.
void growWithContent(QDialog& dialog);

}  // namespace tacto::gui
