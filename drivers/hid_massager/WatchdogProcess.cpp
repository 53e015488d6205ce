#include "drivers/hid_massager/WatchdogProcess.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/base/ProgramStart.h"
#include "drivers/hid_massager/WatchdogLine.h"

namespace tacto::hid {

namespace {

constexpr int kStart_ms = 1000;
constexpr int kEnd_ms = 1000;

template <class... Args>
tl::unexpected<Error> notDriven(ErrorCode code, fmt::format_string<Args...> text, Args&&... args) {
    return fail(code,
                "the massager is not driven: without its watchdog it would go on vibrating if this program died. {}",
                fmt::format(text, std::forward<Args>(args)...));
}

/// Starts `program` with `end` of a new line as its kWatchdogSocket. Returns an error number, or 0.
int spawn(const std::filesystem::path& program, const StopWay& way, int end, pid_t& process) {
    auto words = way.arguments();
    words.insert(words.begin(), program.string());
    std::vector<char*> arguments;
    for (auto& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_adddup2(&files, end, kWatchdogSocket);
    // The watchdog outlives this program, and must not keep open a pipe that signals this program's end to a reader.
    for (const int standard : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        posix_spawn_file_actions_addopen(&files, standard, "/dev/null", O_RDWR, 0);
    }
    posix_spawnattr_t how;
    posix_spawnattr_init(&how);
    sigset_t none;
    sigemptyset(&none);
    posix_spawnattr_setsigmask(&how, &none);
    posix_spawnattr_setflags(&how, POSIX_SPAWN_SETSID | POSIX_SPAWN_SETSIGMASK);
    const int error = posix_spawn(&process, program.c_str(), &files, &how, arguments.data(), environ);
    posix_spawnattr_destroy(&how);
    posix_spawn_file_actions_destroy(&files);
    return error;
}

bool waitFor(int line, int time_ms) noexcept {
    pollfd look{line, POLLIN, 0};
    int found = 0;
    do {
        found = poll(&look, 1, time_ms);
    } while (found < 0 && errno == EINTR);
    return found > 0;
}

}  // namespace

std::filesystem::path WatchdogProcess::programPath() { return programBeside("tactoscope-watchdog"); }

Result<std::unique_ptr<Watchdog>> WatchdogProcess::start(const StopWay& way, const std::filesystem::path& program) {
    std::error_code none;
    if (!std::filesystem::exists(program, none)) {
        return notDriven(ErrorCode::NotFound, "{} is missing; install Tactoscope again", program.string());
    }
    std::array<int, 2> ends{};
    if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()) != 0) {
        return notDriven(ErrorCode::Io, "No socket for it: {}", std::strerror(errno));
    }
    pid_t process = -1;
    const int error = spawn(program, way, ends[1], process);
    close(ends[1]);
    if (error != 0) {
        close(ends[0]);
        return notDriven(ErrorCode::Io, "{} does not start: {}", program.string(), std::strerror(error));
    }
    std::unique_ptr<Watchdog> made(new WatchdogProcess(process, ends[0]));
    struct {
        char word;
        char error[sizeof(int)];
    } answer{};
    if (!waitFor(ends[0], kStart_ms) || recv(ends[0], &answer, sizeof answer, 0) < 1) {
        kill(process, SIGKILL);
        return notDriven(ErrorCode::Timeout, "{} did not answer within {} ms", program.string(), kStart_ms);
    }
    if (answer.word != static_cast<char>(WatchdogWord::Ready)) {
        int reason = 0;
        std::memcpy(&reason, answer.error, sizeof reason);
        return notDriven(ErrorCode::Io, "It cannot open {}: {}", way.node, std::strerror(reason));
    }
    return made;
}

WatchdogProcess::~WatchdogProcess() {
    const char leave = static_cast<char>(WatchdogWord::Leave);
    if (resting_) static_cast<void>(send(line_, &leave, 1, MSG_NOSIGNAL | MSG_DONTWAIT));
    shutdown(line_, SHUT_WR);
    // The watchdog ends when its line closes; late answers to beats may come first.
    const auto until = std::chrono::steady_clock::now() + std::chrono::milliseconds(kEnd_ms);
    for (;;) {
        const auto left =
            std::chrono::ceil<std::chrono::milliseconds>(until - std::chrono::steady_clock::now()).count();
        if (left <= 0 || !waitFor(line_, static_cast<int>(left))) break;
        char answer = 0;
        const auto got = recv(line_, &answer, 1, MSG_DONTWAIT);
        if (got == 1 || (got < 0 && (errno == EAGAIN || errno == EINTR))) continue;
        waitpid(process_, nullptr, 0);
        break;
    }
    close(line_);
}

WatchdogState WatchdogProcess::beat() noexcept {
    const char word = static_cast<char>(WatchdogWord::Beat);
    const auto now = std::chrono::steady_clock::now();
    char answer = 0;
    auto got = recv(line_, &answer, 1, MSG_DONTWAIT);
    for (; got == 1; got = recv(line_, &answer, 1, MSG_DONTWAIT)) unanswered_.reset();
    if (got == 0) return WatchdogState::Ended;
    // After rest() no beat was left unanswered.
    if (resting_ || !unanswered_) unanswered_ = now;
    resting_ = false;
    if (now - *unanswered_ > kUnansweredLimit) return WatchdogState::Silent;
    if (send(line_, &word, 1, MSG_NOSIGNAL | MSG_DONTWAIT) == 1) return WatchdogState::Watching;
    const bool full = errno == EAGAIN || errno == EWOULDBLOCK || errno == ENOBUFS;  // full: the watchdog reads nothing
    return full ? WatchdogState::Silent : WatchdogState::Ended;
}

void WatchdogProcess::rest() noexcept {
    const char word = static_cast<char>(WatchdogWord::Rest);
    // If the line is full or broken, the next beat() notices.
    static_cast<void>(send(line_, &word, 1, MSG_NOSIGNAL | MSG_DONTWAIT));
    resting_ = true;
}

}  // namespace tacto::hid
