// Scripts need a QCoreApplication; it must exist before the first engine and after the last.
#include <QCoreApplication>
#include <cstdlib>
#include <gtest/gtest.h>

#include "app/scripting/engine/ScriptRun.h"

int main(int argc, char** argv) {
    ::testing::InitGoogleTest(&argc, argv);
    QCoreApplication application(argc, argv);
    const int result = RUN_ALL_TESTS();
    // A script that a test abandoned may still be running: nothing may be torn down under it.
    if (tacto::ScriptRun::abandonedRunning() > 0) std::_Exit(result);
    return result;
}
