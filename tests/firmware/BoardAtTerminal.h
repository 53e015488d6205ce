// BoardAtTerminal.h - boards behind a pseudo-terminal, in real time: the emulated one, and the program that a board's
// maker compiles (resources/firmware/tactile_board/mps2.c) on a machine of QEMU.
//
// Thread-safety: the test's own thread.
#pragma once

#include <fcntl.h>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <unistd.h>

#include "drivers/sciencemode/TtyTransport.h"
#include "tests/drivers/sensor_board/BoardConformance.h"
#include "tests/drivers/sensor_board/BoardOnPty.h"
#include "tests/support/OtherProgram.h"
#include "tests/support/Refused.h"

namespace tacto::test {

inline constexpr const char* kNoBoard =
    "gcc-arm-none-eabi, libnewlib-arm-none-eabi and qemu-system-arm are not all here: the board was not run as a "
    "microcontroller runs it";

class BoardAtTerminal {
public:
    virtual ~BoardAtTerminal() = default;
    [[nodiscard]] virtual std::string path() const = 0;
};

/// Speaks to a board at a terminal by frames alone.
class TerminalRig final : public BoardRig {
public:
    explicit TerminalRig(std::unique_ptr<BoardAtTerminal> board) : TerminalRig(board->path()) {
        board_ = std::move(board);
    }
    explicit TerminalRig(const std::string& path) : line_(accepted(sciencemode::TtyTransport::open(path))) {}
    [[nodiscard]] Transport& line() override { return *line_; }
    [[nodiscard]] const Clock& clock() const override { return clock_; }
    void wait(Seconds duration) override { std::this_thread::sleep_for(duration); }

private:
    SteadyClock clock_;
    std::unique_ptr<BoardAtTerminal> board_;
    std::unique_ptr<Transport> line_;
};

class EmulatedAtTerminal final : public BoardAtTerminal {
public:
    [[nodiscard]] std::string path() const override { return board_.path(); }

private:
    const SteadyClock clock_;
    BoardOnPty board_{clock_};
};

/// Its clock is that of this computer.
class QemuAtTerminal final : public BoardAtTerminal {
public:
    QemuAtTerminal()
        : qemu_({TACTO_ARM_QEMU, "-M", "mps2-an386", "-kernel", TACTO_WHOLE_BOARD, "-nographic", "-monitor", "none",
                 "-serial", "pty"}) {
        const auto said = qemu_.readLine().value_or("");
        const auto begin = said.find("/dev/pts/");
        if (begin == std::string::npos)
            throw std::runtime_error("QEMU says \"" + said + "\"; the path of its terminal was expected");
        path_ = said.substr(begin, said.find(' ', begin) - begin);
        // QEMU looks once a second whether anybody holds the terminal; until then it hears nothing.
        held_ = open(path_.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
        TerminalRig rig(path_);
        PlainHost host(rig);
        for (int asked = 0; asked < 100 && host.told.empty(); ++asked) {
            // Its token is no other command's: an answer may come late.
            host.write(sensorboard::encodeCommand(sensorboard::Command::Hello, 251));
            host.listen(Seconds(0.2));
        }
    }
    ~QemuAtTerminal() override { close(held_); }
    QemuAtTerminal(const QemuAtTerminal&) = delete;
    QemuAtTerminal& operator=(const QemuAtTerminal&) = delete;
    [[nodiscard]] std::string path() const override { return path_; }

private:
    HostProcess qemu_;
    std::string path_;
    int held_ = -1;
};

}  // namespace tacto::test
