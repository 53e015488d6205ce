// BuiltWindow.h - starts bin/tactoscope on this X server as a first-time user would, with an empty home, and plays that
// user's hands and eyes, counting the time a person would take.
//
// Whereabouts.cpp, a plugin in the program, tells where to click and which text is shown.
//
// Thread-safety: the test's thread.
#pragma once

#include <QProcess>
#include <QTemporaryDir>
#include <functional>

namespace tacto::test {

/// Adds up the time that a person needs for reading, pointing and typing.
class PersonsTime {
public:
    static constexpr double kWordsPerSecond = 4;
    static constexpr double kPoint_s = 1.1;  ///< time to move the mouse to a target and click (Card, Moran and Newell)
    static constexpr double kKey_s = 0.3;    ///< time to find a key and press it
    void reads(const QString& text);
    void points() { spent_s_ += kPoint_s; }
    void types(qsizetype keys) { spent_s_ += double(keys) * kKey_s; }
    [[nodiscard]] double spent_s() const { return spent_s_; }

private:
    double spent_s_ = 0;
};

class BuiltWindow {
public:
    BuiltWindow();
    ~BuiltWindow();  ///< ends the program
    BuiltWindow(const BuiltWindow&) = delete;
    BuiltWindow& operator=(const BuiltWindow&) = delete;

    /// Starts the program; returns false if no window appears.
    [[nodiscard]] bool start();
    /// Returns the answer to a question of Whereabouts.cpp; empty if none comes in 5 s.
    [[nodiscard]] QString ask(const QString& question);
    /// Returns the text of the widget with that name, with plain spaces.
    [[nodiscard]] QString text(const QString& name) { return ask("text " + name).replace(QChar(0x202f), ' '); }
    [[nodiscard]] bool stands(const QString& name) { return !ask("where " + name).isEmpty(); }
    /// Clicks on the widget with that name; returns false if it is not visible.
    [[nodiscard]] bool clickOn(const QString& name);
    /// Presses keys, named as for xdotool.
    [[nodiscard]] bool press(const QStringList& keys);
    [[nodiscard]] bool enter(const QString& text);
    /// Gives the main window the keyboard focus, as a window manager does after a click.
    [[nodiscard]] bool focus();
    /// Ends the program with Ctrl+Q; returns true if it ended without an error.
    [[nodiscard]] bool leaves();
    [[nodiscard]] QString home() const { return home_.path(); }

    PersonsTime person;

private:
    QTemporaryDir home_;
    QProcess program_;
    QString window_;  // the window's number on the X server
};

}  // namespace tacto::test
