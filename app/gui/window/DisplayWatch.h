// DisplayWatch.h - while QApplication is made: where it reaches no display, Qt would end the program with a core dump,
// and where a display does not answer, it would wait for ever. Here both end it with one sentence and exit code 3.
//
// Thread-safety: main()'s thread, one at a time. The program is ended on the thread that Qt or SIGALRM finds.
#pragma once

#include <QStringList>
#include <optional>

namespace tacto::gui {

class DisplayWatch {
public:
    /// How long a display has for its answer; the first start on a computer also makes the cache of fonts.
    static constexpr unsigned kWait_s = 30;

    /// The sentence for a program whose environment and arguments name no display at all.
    [[nodiscard]] static std::optional<QString> noneIsNamed(const QStringList& arguments);

    /// Keeps what Qt says to itself until the display is there.
    DisplayWatch();
    /// The display is there: what Qt said is printed.
    ~DisplayWatch();
    DisplayWatch(const DisplayWatch&) = delete;
    DisplayWatch& operator=(const DisplayWatch&) = delete;
};

}  // namespace tacto::gui
