// HelpWindow.h - the window with the guide, the keys and the limits; and the explanation of the focused widget.
#pragma once

#include <QWidget>

#include "app/run/Shipped.h"

namespace tacto::gui {

class Workspaces;

/// Returns the guide's file (in resources/help/guide) about the shown workspace.
[[nodiscard]] QString guidePageOf(const Workspaces& workspaces);

/// Opens the guide at that file, with the limit sets in force and their sources. An open guide goes to that page.
void openGuide(const ShippedLimits& limits, const QString& page, QWidget* parent);

/// Explains the focused widget with its tool tip, or with the tool tip of the widget around it.
void explainFocus(QWidget* window);

}  // namespace tacto::gui
