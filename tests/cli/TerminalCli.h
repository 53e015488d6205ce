// TerminalCli.h - runs the built tactoscope-cli at a terminal, as a person does: typed text is its input, Ctrl+C is a
// signal, and its output is the screen.
//
// Thread-safety: the test's own thread.
#pragma once

#include <string>
#include <string_view>
#include <sys/types.h>

#include "tests/cli/RunCli.h"

namespace tacto::test {

class TerminalCli {
public:
    /// Starts the program in `desk`'s folder, at a terminal of `columns`.
    TerminalCli(const Desk& desk, const Words& words, unsigned short columns = 80);
    ~TerminalCli();
    TerminalCli(const TerminalCli&) = delete;
    TerminalCli& operator=(const TerminalCli&) = delete;

    /// Reads the screen until it shows `text`. Returns false if the program ended first, or after 20 s.
    [[nodiscard]] bool waitFor(std::string_view text);
    void type(std::string_view keys);
    /// Reads the screen to its end. Returns the exit code; minus the signal's number if a signal ended the program; -9
    /// if it had to be killed after 20 s.
    [[nodiscard]] int wait();
    /// Returns everything that was printed, without the terminal's carriage returns.
    [[nodiscard]] const std::string& screen() const { return screen_; }

private:
    [[nodiscard]] bool readSome(int within_ms);
    pid_t pid_ = -1;
    int master_ = -1;
    std::string screen_;
};

}  // namespace tacto::test
