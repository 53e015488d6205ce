// main() of every gui test: offscreen unless said otherwise, with the user's folders in a place of its own.
#include <QApplication>
#include <QTemporaryDir>
#include <gtest/gtest.h>

#include "app/gui/look/Look.h"
#include "tests/gui/OffscreenScreen.h"
#include "tests/support/Support.h"

int main(int argc, char** argv) {
    testing::InitGoogleTest(&argc, argv);
    const QTemporaryDir home;
    for (const auto* name : {"HOME", "XDG_DATA_HOME", "XDG_CONFIG_HOME", "XDG_CACHE_HOME", "XDG_RUNTIME_DIR"})
        qputenv(name, home.path().toUtf8());
    tacto::test::useOffscreenScreen(home);
    QApplication application(argc, argv);
    QApplication::setApplicationName("tactoscope");
    QApplication::setOrganizationName("tactoscope");
    QApplication::setQuitOnLastWindowClosed(false);
    tacto::gui::applyTheme(tacto::gui::Theme::Light);
    return RUN_ALL_TESTS();
}
