#include "tests/support/OtherProgram.h"

#include <array>
#include <csignal>
#include <cstdio>
#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <stdexcept>
#include <sys/file.h>
#include <sys/wait.h>
#include <unistd.h>

namespace tacto::test {

std::pair<std::string, int> outputOf(const std::string& line) {
    std::string output;
    FILE* pipe = popen((line + " 2>&1").c_str(), "r");
    if (pipe == nullptr) return {"", -1};
    std::array<char, 4096> piece{};
    for (std::size_t n = 0; (n = std::fread(piece.data(), 1, piece.size(), pipe)) > 0;) output.append(piece.data(), n);
    const int status = pclose(pipe);
    return {output, WIFEXITED(status) ? WEXITSTATUS(status) : -1};
}

OtherProgram::OtherProgram(const std::filesystem::path& file, bool locked) {
    // A spawned program has what it inherits from its first moment on; only the lock needs the file open here.
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    constexpr int kItsOwn = 9;
    if (locked) {
        file_ = open(file.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
        if (file_ < 0 || flock(file_, LOCK_EX | LOCK_NB) != 0) throw std::runtime_error("no lock on " + file.string());
        posix_spawn_file_actions_adddup2(&actions, file_, kItsOwn);
    } else {
        posix_spawn_file_actions_addopen(&actions, kItsOwn, file.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK, 0);
    }
    std::string program = "/bin/sleep";
    std::string long_s = "600";
    std::array<char*, 3> arguments{program.data(), long_s.data(), nullptr};
    std::array<char*, 1> environment{nullptr};  // without what tests preload
    const int spawned =
        posix_spawn(&process_, program.c_str(), &actions, nullptr, arguments.data(), environment.data());
    posix_spawn_file_actions_destroy(&actions);
    if (spawned != 0) throw std::runtime_error("no other program: it cannot open " + file.string());
}

OtherProgram::~OtherProgram() {
    kill(process_, SIGKILL);
    waitpid(process_, nullptr, 0);
    if (file_ >= 0) close(file_);
}

std::string OtherProgram::text() const { return fmt::format("sleep (pid {})", process_); }

}  // namespace tacto::test
