// OffscreenScreen.h - the screen for a program without a display: full HD; at scale 2 twice as many pixels each way.
// Qt's own offscreen screen has only 800 x 800 pixels, and windows stay within their screen.
//
// Thread-safety: call it before QApplication is made.
#pragma once

#include <QFile>
#include <QString>
#include <QTemporaryDir>

namespace tacto::test {

/// Chooses the offscreen platform unless QT_QPA_PLATFORM names another one. `folder` must outlive the program.
inline void useOffscreenScreen(const QTemporaryDir& folder) {
    const auto platform = qgetenv("QT_QPA_PLATFORM");
    if (!platform.isEmpty() && platform != "offscreen") return;
    QFile screen(folder.filePath("screen.json"));
    if (!screen.open(QIODevice::WriteOnly)) qFatal("cannot write %s", qPrintable(screen.fileName()));
    const double scale = qEnvironmentVariable("QT_SCALE_FACTOR", "1").toDouble();
    screen.write(QString(R"({"screens": [{"name": "desk", "x": 0, "y": 0, "width": %1, "height": %2,)"
                         R"( "logicalDpi": 96, "logicalBaseDpi": 96, "dpr": 1}]})")
                     .arg(int(1920 * scale))
                     .arg(int(1080 * scale))
                     .toUtf8());
    qputenv("QT_QPA_PLATFORM", "offscreen:configfile=" + screen.fileName().toUtf8());
}

}  // namespace tacto::test
