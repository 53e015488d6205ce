// StartedWith.h - reads the window's command line: `tactoscope [FILE]`, as called from the desktop's menu.
//
// Thread-safety: a plain value.
#pragma once

#include <QString>
#include <QStringList>
#include <optional>

namespace tacto::gui {

struct StartedWith {
    /// A text to print instead of opening a window.
    struct Answer {
        QString text;
        int exitCode = 0;  ///< as in tactoscope-cli: 0 help or version (stdout), 2 usage, 3 no such file (both stderr)
    };
    QString file;  ///< opened like a file dropped on the window; empty: none
    std::optional<Answer> answer;

    /// `arguments` begin with the program's name. Qt's own options (-platform, -style) are errors here, as QApplication
    /// removes them before. Help and version are answered even before QApplication, which needs a display.
    static StartedWith read(const QStringList& arguments);
};

}  // namespace tacto::gui
