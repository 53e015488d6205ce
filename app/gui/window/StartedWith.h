// StartedWith.h - the command line of the window: `tactoscope [FILE]`, as the desktop's menu calls it.
//
// Thread-safety: a value.
#pragma once

#include <QString>
#include <QStringList>
#include <optional>

namespace tacto::gui {

struct StartedWith {
    /// The text that is printed in place of a window.
    struct Answer {
        QString text;
        int exitCode = 0;  ///< as tactoscope-cli's: 0 help or version (stdout), 2 usage, 3 no such file (both stderr)
    };
    QString file;  ///< opened as if it were dropped on the window; empty: none
    std::optional<Answer> answer;

    /// `arguments` begin with the program's name. Those that Qt understands (-platform, -style) are refused here:
    /// QApplication takes them away first. Help and version are answered before that, where there is no display.
    static StartedWith read(const QStringList& arguments);
};

}  // namespace tacto::gui
