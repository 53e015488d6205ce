// DisplayWatch.h - watches the start of QApplication. Without a display Qt would end with a core dump, and with a
// display that does not answer it would wait for ever. Here both end the program with one sentence and exit code 3.
//
// Thread-safety: main()'s thread, one at a time. Qt's thread or the one that gets SIGALRM ends the program.
#pragma once

#include <QStringList>
#include <optional>

namespace tacto::gui {

class DisplayWatch {
public:
    /// How long to wait for the display; the first start on a computer also builds the font cache.
    static constexpr unsigned kWait_s = 30;

    /// Returns an error sentence if neither environment nor arguments name a display.
    [[nodiscard]] static std::optional<QString> noneIsNamed(const QStringList& arguments);

    /// Holds back Qt's messages until the display answers.
    DisplayWatch();
    /// The display has answered: prints Qt's messages.
    ~DisplayWatch();
    DisplayWatch(const DisplayWatch&) = delete;
    DisplayWatch& operator=(const DisplayWatch&) = delete;
};

}  // namespace tacto::gui
