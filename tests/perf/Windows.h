// Windows.h - what a benchmark of windows needs before its first one.
//
// Thread-safety: the main thread alone.
#pragma once

#include <QApplication>

#include "app/gui/theme/Theme.h"

namespace tacto {

/// The program that windows belong to: made at first need, never destroyed, since benchmark's main() knows nothing of
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
