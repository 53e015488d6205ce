// HelpWindow.h - the guide, with the keys and the limits, and what has the focus.
#pragma once

#include <QWidget>

#include "app/run/Shipped.h"

namespace tacto::gui {

class Workspaces;

/// The file of the guide (in resources/help/guide) that is about the workspace in front.
[[nodiscard]] QString guidePageOf(const Workspaces& workspaces);

/// Opens the guide at that file, beside the limit sets in force with their sources. A guide that is open turns to it.
void openGuide(const ShippedLimits& limits, const QString& page, QWidget* parent);

/// Explains the focused widget: its tool tip, or that of the widget around it.
void explainFocus(QWidget* window);

}  // namespace tacto::gui
