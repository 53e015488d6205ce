// Hand.h - acts as a hand at mouse and keyboard of a real X server (xdotool): the events pass through the server and
// Qt's platform plugin, and so meet blocked windows, open popups and the focus.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QFileInfo>
#include <QProcess>
#include <QScreen>
#include <QTest>
#include <QWidget>
#include <gtest/gtest.h>

namespace tacto::test {

/// Sends a key through the X server to the window with the focus.
inline void type(const QString& keys) { ASSERT_EQ(QProcess::execute("xdotool", {"key", "--clearmodifiers", keys}), 0); }

/// Moves the mouse to a place on the screen, in logical pixels, and clicks.
inline void clickAt(const QPoint& global, const QString& button = "1") {
    const double scale = QGuiApplication::primaryScreen()->devicePixelRatio();
    ASSERT_EQ(QProcess::execute("xdotool", {"mousemove", QString::number(int(global.x() * scale)),
                                            QString::number(int(global.y() * scale)), "click", button}),
              0);
}

inline void clickOn(const QWidget& widget, const QString& button = "1") {
    clickAt(widget.mapToGlobal(widget.rect().center()), button);
}

/// Gives the window the server's focus, as a window manager does after a click.
inline void focus(const QWidget& window) {
    ASSERT_EQ(QProcess::execute("xdotool", {"windowfocus", QString::number(window.window()->winId())}), 0);
    letLive(20);
}

/// Saves a picture of the whole screen as PNG in $TACTO_SHOTS.
inline void picture(const QString& name) {
    letLive(150);
    const auto file = QString("%1/%2%3.png")
                          .arg(qEnvironmentVariable("TACTO_SHOTS"), name, qEnvironmentVariable("TACTO_SHOT_SUFFIX"));
    ASSERT_TRUE(QGuiApplication::primaryScreen()->grabWindow(0).save(file));
    EXPECT_GT(QFileInfo(file).size(), 10'000) << "a blank picture";
}

}  // namespace tacto::test
