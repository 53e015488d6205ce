// Dialogs.h - opens every dialog and every question for a file: next to the window's controls, never blocking them.
//
// A modal dialog would take all clicks and keys from the windows behind it, and so block STOP. No dialog of this
// program is modal: the window stays usable, so a dialog notes what it asks about when it opens, not when it is
// answered. StopKeys makes dialogs non-modal that Qt opens by itself.
#pragma once

#include <QDialog>
#include <QStringList>
#include <functional>

namespace tacto::gui {

/// Shows `dialog` below the safety bar, inside the screen, and deletes it when closed. If its parent already has an
/// open dialog of this class and title, that dialog comes to the front and `dialog` is deleted.
void openDialog(QDialog* dialog);

/// Moves a window below the safety bar of its parent's window, so that STOP stays visible, and makes it as high as its
/// content needs and the screen allows. If the room there is too small, the window goes higher, at the side of STOP if
/// possible. A window without a parent is not moved.
void place(QWidget& dialog);

/// Adds a button at the end of `layout` that closes the dialog.
void addCloseButton(QDialog& dialog, QLayout& layout);

/// Opens a file or folder with the desktop's program. Returns where the file is if there is no such program; if the
/// desktop finds that out only later, it is told then (Told.h).
[[nodiscard]] QString openOnDesktop(const QString& path);

struct FileQuestion {
    enum class Wants { ExistingFile, Folder, NewFolder, NewFile };
    QString title = {};
    Wants wants = Wants::ExistingFile;
    QStringList filters = {};  ///< "Profiles (*.json)"; empty: all files
    QString folder = {};       ///< the folder shown first; empty: the last one used, on any day
    QString name = {};         ///< the suggested name
    QString suffix = {};       ///< added to a name without a suffix; written without a dot
};

/// Asks the operator for a file or folder; makes a new folder whose name was typed. Calls `then` with the path, unless
/// the question is cancelled or `asking` is deleted first. An existing file is replaced only after a second press,
/// which the dialog asks for in its last line.
void askForFile(QWidget& asking, const FileQuestion& question, std::function<void(const QString& path)> then);

/// Lets the dialog grow, as far as the screen allows, when its content needs more room, so that longer or larger text
/// is not cut off.
void growWithContent(QDialog& dialog);

}  // namespace tacto::gui
