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

    // The first terminal that a session's leader opens is its own: Ctrl+C reaches it.
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, 0, slave.c_str(), O_RDWR, 0);
    posix_spawn_file_actions_adddup2(&actions, 0, 1);
    posix_spawn_file_actions_adddup2(&actions, 0, 2);
    posix_spawn_file_actions_addchdir_np(&actions, desk.path().c_str());
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    sigset_t defaults;
    sigemptyset(&defaults);
    sigset_t mask = defaults;
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) sigaddset(&defaults, signal);
    posix_spawnattr_setsigdefault(&attributes, &defaults);
    posix_spawnattr_setsigmask(&attributes, &mask);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSID | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK);
    Words command{TACTO_CLI};
    command.insert(command.end(), words.begin(), words.end());
    std::vector<char*> pointers;
    for (auto& word : command) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    Words environment = desk.environment();
    std::vector<char*> settings;
    for (auto& setting : environment) settings.push_back(setting.data());
    settings.push_back(nullptr);
    const int failed = posix_spawn(&pid_, TACTO_CLI, &actions, &attributes, pointers.data(), settings.data());
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    if (failed != 0) throw std::runtime_error("tactoscope-cli cannot be started");
}

TerminalCli::~TerminalCli() {
    if (pid_ > 0) {
        kill(pid_, SIGKILL);
        waitpid(pid_, nullptr, 0);
    }
    close(master_);
}

/// False when there is nothing more to come.
bool TerminalCli::readSome(int within_ms) {
    pollfd watched{master_, POLLIN, 0};
    if (poll(&watched, 1, within_ms) <= 0) return true;
    std::array<char, 4096> chunk{};
    const auto got = read(master_, chunk.data(), chunk.size());
    if (got <= 0) return false;  // EIO: the last process that had the terminal open is gone
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
