// Menus.h - the main window's menus: files, bench, view, help.
#pragma once

#include <QActionGroup>
#include <QMenu>
#include <QObject>

namespace tacto::gui {

class DockColumn;
class MainWindow;
class RecordingLine;

class Menus final : public QObject {
    Q_OBJECT
public:
    /// The window owns this. The view menu offers `workspaces` and `docks`; `line` shows messages.
    Menus(MainWindow& window, const QActionGroup& workspaces, DockColumn& docks, RecordingLine& line);

private:
    void addBench();
    void addView(const QActionGroup& workspaces, DockColumn& docks);
    void addLooks(QMenu& view);
    void addHelp();
    void showAbout();

    MainWindow& window_;
    RecordingLine& line_;
};

}  // namespace tacto::gui
