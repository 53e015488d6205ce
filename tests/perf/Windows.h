// Windows.h - preparation for benchmarks that use windows.
//
// Thread-safety: the main thread only.
#pragma once

#include <QApplication>

#include "app/gui/theme/Theme.h"

namespace tacto {

/// Creates the QApplication at first need, and never destroys it, since the main() of Google Benchmark does not know
/// Qt.
inline void needWindows() {
    static int argc = 1;
    static char name[] = "perf";
    static char* argv[] = {name, nullptr};
    if (QCoreApplication::instance() != nullptr) return;
    if (qEnvironmentVariableIsEmpty("QT_QPA_PLATFORM")) qputenv("QT_QPA_PLATFORM", "offscreen");
    new QApplication(argc, argv);
    gui::applyTheme(gui::Theme::Light);
}

}  // namespace tacto
