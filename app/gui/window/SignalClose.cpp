#include "app/gui/window/SignalClose.h"

#include <QCoreApplication>
#include <cstdlib>

namespace tacto::gui {

namespace {

constexpr int kStopped = 4;  // exit code of a stopped program, as for tactoscope-cli

}  // namespace

SignalClose::SignalClose(SignalStop& stops, MainWindow& window) : stops_(stops) {
    const auto close = [&window] {
        window.controller().stop("operator (signal)");
        const auto inTurn = [&window] {
            window.closeUnasked();
            QCoreApplication::exit();  // ends the program even if a dialog is open
        };
        QMetaObject::invokeMethod(&window, inTurn, Qt::QueuedConnection);
    };
    stops_.onStop([close, first = first_] {
        close();
        note(first);
    });
    if (stops_.signalled()) close();  // a signal came while the window was being built
}

SignalClose::~SignalClose() {
    stops_.onStop([first = first_] { note(first); });
}

void SignalClose::note(const First& first) {
    const auto now = std::chrono::steady_clock::now();
    if (!*first) *first = now;
    if (now - **first >= kExitTimeout) std::_Exit(kStopped);
}

}  // namespace tacto::gui
