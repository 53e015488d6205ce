// Dialogs.h - the one way in which the program opens a dialog or asks for a file: beside the window, never in its way.
//
// A modal dialog takes every click and key from the windows behind it, and with them STOP. No dialog of this program is
// modal: the window stays usable while one is open, so what a dialog asks about is taken when it opens, not when it
// is answered. StopKeys takes the modality from a dialog that Qt opens by itself.
#pragma once

#include <QDialog>
#include <QStringList>
#include <functional>

namespace tacto::gui {

/// Shows `dialog` below the safety bar, inside the screen, and deletes it when it is closed. If its parent has such a
/// dialog (class and title) open already, that one comes to the front and `dialog` is deleted.
void openDialog(QDialog* dialog);

/// Moves a window to below the safety bar of its parent's window, so that STOP stays in sight, and makes it as high as
/// its content needs and the screen has room. One that has no room there goes higher, beside STOP as far as it can.
/// Without a parent it stays where it is.
void place(QWidget& dialog);

/// Adds a button at the end of `layout` that closes the dialog.
void addCloseButton(QDialog& dialog, QLayout& layout);

/// Opens a file or folder with the desktop's program for it. Where there is none, the value says where the file lies.
[[nodiscard]] QString openOnDesktop(const QString& path);

struct FileQuestion {
    enum class Wants { ExistingFile, Folder, NewFolder, NewFile };
    QString title = {};
    Wants wants = Wants::ExistingFile;
    QStringList filters = {};  ///< "Profiles (*.json)"; empty: all files
    QString folder = {};       ///< shown first; empty: the last one
    QString name = {};         ///< suggested
    QString suffix = {};       ///< added to a name without one; without a dot
};

/// Asks the operator for a file or folder; a new folder that is typed is made. `then` gets its path, unless the
/// question is cancelled or `asking` is deleted first. A file that exists is replaced only after a second press, which
/// the dialog asks for in place.
void askForFile(QWidget& asking, const FileQuestion& question, std::function<void(const QString& path)> then);

/// From now on the dialog grows as far as the screen allows when its content needs more room: a text that got longer,
/// or larger, is not cut.
void growWithContent(QDialog& dialog);

}  // namespace tacto::gui
