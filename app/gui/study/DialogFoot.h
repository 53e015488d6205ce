// DialogFoot.h - how a dialog of a study ends: a line for what went wrong, and Cancel beside the button that acts.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QDialog>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

namespace tacto::gui {

/// Adds `trouble` and the buttons to `column`; Cancel rejects `dialog`, and neither button is its default. Returns
/// Cancel.
QPushButton* addFoot(QDialog& dialog, QVBoxLayout& column, QLabel& trouble, QPushButton* act);

}  // namespace tacto::gui
