#include "tests/cli/TerminalCli.h"

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <stdexcept>
#include <sys/ioctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace tacto::test {

namespace {
constexpr auto kTimeout = std::chrono::seconds(20);
}

TerminalCli::TerminalCli(const Desk& desk, const Words& words, unsigned short columns) {
    master_ = posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
    if (master_ < 0 || grantpt(master_) != 0 || unlockpt(master_) != 0) throw std::runtime_error("no pseudo-terminal");
    const winsize size{24, columns, 0, 0};
    ioctl(master_, TIOCSWINSZ, &size);
    const std::string slave = ptsname(master_);

    // The first terminal that a session leader opens becomes its own, so that Ctrl+C reaches it.
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, 0, slave.c_str(), O_RDWR, 0);
    posix_spawn_file_actions_adddup2(&actions, 0, 1);
    posix_spawn_file_actions_adddup2(&actions, 0, 2);
    pid_ = desk.spawn(words, actions, POSIX_SPAWN_SETSID);
}

TerminalCli::~TerminalCli() {
    if (pid_ > 0) {
        kill(pid_, SIGKILL);
        waitpid(pid_, nullptr, 0);
    }
    close(master_);
}

/// Returns false if nothing more will come.
bool TerminalCli::readSome(int within_ms) {
    pollfd watched{master_, POLLIN, 0};
    if (poll(&watched, 1, within_ms) <= 0) return true;
    std::array<char, 4096> chunk{};
    const auto got = read(master_, chunk.data(), chunk.size());
    if (got <= 0) return false;  // EIO: the last process with the terminal open has ended
    for (const char c : std::string_view(chunk.data(), static_cast<std::size_t>(got))) {
        if (c != '\r') screen_ += c;
    }
    return true;
}

bool TerminalCli::waitFor(std::string_view text) {
    const auto limit = std::chrono::steady_clock::now() + kTimeout;
    while (screen_.find(text) == std::string::npos) {
        if (std::chrono::steady_clock::now() > limit || !readSome(100)) return screen_.find(text) != std::string::npos;
    }
    return true;
}

void TerminalCli::type(std::string_view keys) {
    if (write(master_, keys.data(), keys.size()) != static_cast<ssize_t>(keys.size()))
        throw std::runtime_error("the terminal takes no keys");
}

int TerminalCli::wait() {
    const auto limit = std::chrono::steady_clock::now() + kTimeout;
    bool more = true;
    while (more && std::chrono::steady_clock::now() < limit) more = readSome(100);
    if (more) kill(pid_, SIGKILL);
    int status = 0;
    waitpid(pid_, &status, 0);
    pid_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

}  // namespace tacto::test
