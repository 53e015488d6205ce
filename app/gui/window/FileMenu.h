// FileMenu.h - the File menu: opens, saves, exports, prints and closes what the present page shows.
//
// An entry that the page has nothing for is disabled while the menu is open, and its key says why.
#pragma once

#include <QMenu>
#include <QObject>
#include <QTemporaryDir>

#include "app/gui/runner/ReportPrinter.h"

namespace tacto::gui {

class MainWindow;
class RecordingLine;
class Workspaces;

class FileMenu final : public QObject {
    Q_OBJECT
public:
    /// The window owns this. `line` shows messages.
    FileMenu(MainWindow& window, Workspaces& workspaces, RecordingLine& line);

private:
    void fillRecent();
    void print();
    /// Adds an entry that calls `act`, if the page has something for it; otherwise says `none`.
    void add(const QString& text, const QKeySequence& key, const QString& none, std::function<bool()> has,
             std::function<void()> act);

    MainWindow& window_;
    Workspaces& workspaces_;
    RecordingLine& line_;
    QMenu* menu_;
    QMenu* recent_ = nullptr;
    QTemporaryDir drawn_;  ///< for pictures on their way to the printer
    ReportPrinter printer_;
};

}  // namespace tacto::gui
