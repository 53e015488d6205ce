// HelpWindow.h - definitions and limits, the keys, and the first steps.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QDialog>
#include <QWidget>

#include "app/run/Shipped.h"

namespace tacto::gui {

/// Definitions (resources/help/definitions.md) and the limit sets in force, with their sources.
[[nodiscard]] QDialog* makeHelpWindow(const ShippedLimits& limits, QWidget* parent);

/// Every key, by topic.
[[nodiscard]] QDialog* makeShortcutSheet(QWidget* parent);

/// Says what the widget under the focus is for: its tool tip, or that of what holds it.
void explainFocus(QWidget* window);

}  // namespace tacto::gui
