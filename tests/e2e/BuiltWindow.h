// BuiltWindow.h - bin/tactoscope as a person starts it for the first time, with an empty home, on this X server; and
// that person's hand and eyes, with the time that they take.
//
// The window itself says where to click and what is written, through the plugin of Whereabouts.cpp.
//
// Thread-safety: the thread of the test.
#pragma once

#include <QProcess>
#include <QTemporaryDir>
#include <functional>

namespace tacto::test {

/// The time that a person takes beside the machine: reading, pointing, typing.
class PersonsTime {
public:
    static constexpr double kWordsPerSecond = 4;
    static constexpr double kPoint_s = 1.1;  ///< moves the mouse to a target and clicks (Card, Moran and Newell)
    static constexpr double kKey_s = 0.3;    ///< finds a key and presses it
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

    /// False where no window comes.
    [[nodiscard]] bool start();
    /// The answer to a question of Whereabouts.cpp; empty if none comes in 5 s.
    [[nodiscard]] QString ask(const QString& question);
    /// The text in the widget of that name, with plain spaces.
    [[nodiscard]] QString text(const QString& name) { return ask("text " + name).replace(QChar(0x202f), ' '); }
    [[nodiscard]] bool stands(const QString& name) { return !ask("where " + name).isEmpty(); }
    /// Clicks where it stands; false where it does not.
    [[nodiscard]] bool clickOn(const QString& name);
    /// Keys as xdotool names them.
    [[nodiscard]] bool press(const QStringList& keys);
    [[nodiscard]] bool enter(const QString& text);
    /// Gives the keyboard to the main window, as a window manager does after a click.
    [[nodiscard]] bool focus();
    /// The program's own end by Ctrl+Q, without an error.
    [[nodiscard]] bool leaves();
    [[nodiscard]] QString home() const { return home_.path(); }

    PersonsTime person;

private:
    QTemporaryDir home_;
    QProcess program_;
    QString window_;  // the window's number in the X server
};

}  // namespace tacto::test
