#include "tests/support/OtherProgram.h"

#include <array>
#include <csignal>
#include <cstdio>
#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
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
    // A spawned program has its inherited files from the start; only the lock needs the file opened here.
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
    std::array<char*, 1> environment{nullptr};  // so without the libraries that tests preload
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

HostProcess::HostProcess(std::vector<std::string> words) {
    std::array<int, 2> in{}, out{};
    if (pipe2(in.data(), O_CLOEXEC) != 0 || pipe2(out.data(), O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, in[0], STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, out[1], STDOUT_FILENO);
    sigset_t deadly;
    sigemptyset(&deadly);
    for (const int each : {SIGABRT, SIGSEGV, SIGINT}) sigaddset(&deadly, each);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setsigdefault(&attributes, &deadly);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
    std::vector<char*> arguments;
    for (auto& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    const int spawned = posix_spawn(&process_, arguments[0], &actions, &attributes, arguments.data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    close(in[0]);
    close(out[1]);
    in_ = in[1];
    out_ = out[0];
    if (spawned == 0) return;
    close(in_);
    close(out_);
    throw std::runtime_error(words.front() + " does not start");
}

HostProcess::~HostProcess() {
    if (process_ > 0) {
        kill(process_, SIGKILL);
        waitpid(process_, nullptr, 0);
    }
    close(in_);
    close(out_);
}

void HostProcess::signal(int number) const { kill(process_, number); }

bool HostProcess::speaks() const {
    char first = 0;
    return read(out_, &first, 1) == 1;
}

std::optional<std::string> HostProcess::readLine() {
    for (;;) {
        if (const auto end = pending_.find('\n'); end != std::string::npos) {
            auto line = pending_.substr(0, end);
            pending_.erase(0, end + 1);
            return line;
        }
        pollfd readable{out_, POLLIN, 0};
        if (poll(&readable, 1, 20'000) <= 0) return std::nullopt;
        std::array<char, 4096> chunk{};
        const auto got = read(out_, chunk.data(), chunk.size());
        if (got <= 0) return std::nullopt;
        pending_.append(chunk.data(), static_cast<std::size_t>(got));
    }
}

bool HostProcess::tell(const std::string& line) const {
    const auto whole = line + "\n";
    return write(in_, whole.data(), whole.size()) == std::ssize(whole);
}

bool HostProcess::stopAndWait() const {
    kill(process_, SIGSTOP);
    int status = 0;
    return waitpid(process_, &status, WUNTRACED) == process_ && WIFSTOPPED(status);
}

int HostProcess::ended() {
    int status = 0;
    waitpid(std::exchange(process_, -1), &status, 0);
    return status;
}

}  // namespace tacto::test
