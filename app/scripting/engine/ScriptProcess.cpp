#include "app/scripting/engine/ScriptProcess.h"

#include <QRegularExpression>
#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <ctime>
#include <fcntl.h>
#include <functional>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

#include "app/scripting/wire/ScriptMessage.h"
#include "core/base/JsonText.h"
#include "core/base/ProgramStart.h"

extern char** environ;

namespace tacto {

namespace {

using nlohmann::json;

/// Limit for a process that uses no processor time: it was stopped from outside, or the machine stands still.
constexpr std::chrono::minutes kMaxSilence{10};
constexpr std::chrono::milliseconds kMaxStart{3000};
constexpr std::chrono::milliseconds kLastMoments{200};  // how long a process may still run after its socket closed
constexpr int kTimesOnABusyMachine = 10;                // one second of processor time may take up to this many seconds

int findRunLine(const std::string& text) {
    static const QRegularExpression run(QStringLiteral(R"(\bfunction\s*\*?\s*run\s*\(|\b(?:const|let|var)\s+run\s*=)"));
    const QString code = QString::fromStdString(text);
    const auto match = run.match(code);
    if (!match.hasMatch()) return 1;
    return static_cast<int>(code.left(match.capturedStart()).count(QLatin1Char('\n'))) + 1;
}

/// Returns the table of existing functions; it tells the script's process what can be called.
json tableOfFunctions() {
    json table = json::array();
    for (const auto& function : hostFunctions()) {
        table.push_back({{"object", function.object},
                         {"name", function.name},
                         {"property", function.kind == HostKind::Property},
                         {"javascript", function.javascript}});
    }
    return table;
}

/// Returns the processor time that a process has used, or nothing once the process is gone.
std::optional<std::chrono::nanoseconds> timeUsedBy(pid_t pid) {
    clockid_t clock{};
    timespec used{};
    if (::clock_getcpuclockid(pid, &clock) != 0 || ::clock_gettime(clock, &used) != 0) return std::nullopt;
    return std::chrono::seconds(used.tv_sec) + std::chrono::nanoseconds(used.tv_nsec);
}

}  // namespace

/// Limits the time that a script may take without a call or an end. With a `limit`, calls do not extend it.
class ScriptProcess::Patience {
public:
    Patience(pid_t pid, std::optional<std::chrono::milliseconds> limit) : pid_(pid), limit_(limit) { begin(); }
    void begin() {
        used_ = timeUsedBy(pid_);
        since_ = std::chrono::steady_clock::now();
    }
    void called() {
        if (!limit_) begin();
    }
    [[nodiscard]] Result<void> look() const {
        const auto now = timeUsedBy(pid_);
        const auto computed = now && used_ ? *now - *used_ : std::chrono::nanoseconds(0);
        const auto passed = std::chrono::steady_clock::now() - since_;
        if (limit_ && (computed > *limit_ || passed > kTimesOnABusyMachine * *limit_))
            return fail(ErrorCode::Timeout, "no answer in time");
        if (computed > ScriptProcess::kMaxThought) {
            return fail(ErrorCode::Timeout, "the script computed for {} s without a call, which is more than it may",
                        ScriptProcess::kMaxThought.count());
        }
        if (passed > kMaxSilence)
            return fail(ErrorCode::Timeout, "the script's process stood still for {} min", kMaxSilence.count());
        return {};
    }

private:
    pid_t pid_;
    std::optional<std::chrono::milliseconds> limit_;
    std::optional<std::chrono::nanoseconds> used_;
    std::chrono::steady_clock::time_point since_;
};

namespace {

/// Returns the number under `key`, or `otherwise` if the value is not a number.
std::int64_t wholeIn(const json& message, const char* key, std::int64_t otherwise) {
    const auto at = message.find(key);
    return at != message.end() && at->is_number_integer() ? at->get<std::int64_t>() : otherwise;
}

std::string textIn(const json& message, const char* key) { return shortened(textOr(message, key), kMaxReason + 3); }

}  // namespace

std::string ScriptError::text() const {
    return line > 0 ? fmt::format("{}:{}: {}", file, line, reason) : fmt::format("{}: {}", file, reason);
}

Result<std::unique_ptr<ScriptProcess>> ScriptProcess::start(std::size_t memory, std::filesystem::path program) {
    if (program.empty()) program = programBeside("tactoscope-script");
    const auto refused = [&](int why) {
        return fail(why == ENOENT ? ErrorCode::NotFound : ErrorCode::Io, "scripts cannot run: {} does not start ({}){}",
                    program.string(), std::strerror(why), why == ENOENT ? "; install Tactoscope again" : "");
    };
    int ends[2];
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) return refused(errno);
    posix_spawn_file_actions_t files;
    posix_spawnattr_t attributes;
    posix_spawn_file_actions_init(&files);
    posix_spawnattr_init(&attributes);
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        posix_spawn_file_actions_addopen(&files, stream, "/dev/null", O_RDWR, 0);
    posix_spawn_file_actions_adddup2(&files, ends[1], kScriptSocket);
    sigset_t none;
    sigemptyset(&none);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK);
    const std::string path = program.string();
    char* const arguments[] = {const_cast<char*>(path.c_str()), nullptr};
    pid_t pid = 0;
    const int failed = ::posix_spawn(&pid, path.c_str(), &files, &attributes, arguments, environ);
    posix_spawn_file_actions_destroy(&files);
    posix_spawnattr_destroy(&attributes);
    ::close(ends[1]);
    if (failed != 0) {
        ::close(ends[0]);
        return refused(failed);
    }
    std::unique_ptr<ScriptProcess> process(new ScriptProcess(pid, ends[0]));
    if (auto introduced = process->introduce(memory); !introduced) return failure(introduced);
    return process;
}

Result<void> ScriptProcess::introduce(std::size_t memory) {
    return sendMessage(socket_,
                       {{"start", {{"functions", tableOfFunctions()}, {"memory", memory}, {"parent", ::getpid()}}}});
}

ScriptProcess::~ScriptProcess() {
    end();
    reap();
    ::close(socket_);
}

void ScriptProcess::end() noexcept {
    ending_ = true;
    ::shutdown(socket_, SHUT_RDWR);  // needed because another process may hold the other end, too
    const std::lock_guard lock(life_);
    if (!reaped_) static_cast<void>(::kill(pid_, SIGKILL));
}

WhileWaiting ScriptProcess::watching(const Patience& patience) const {
    return [this, &patience]() -> Result<void> {
        if (ending_) return fail(ErrorCode::Io, "ended");
        if (stopped_ && stopped_()) return fail(ErrorCode::Stopped, "stopped");
        return patience.look();
    };
}

bool ScriptProcess::endsWithin(std::chrono::milliseconds time) const noexcept {
    const auto until = std::chrono::steady_clock::now() + time;
    for (;;) {
        siginfo_t how{};
        if (::waitid(P_PID, static_cast<id_t>(pid_), &how, WEXITED | WNOWAIT | WNOHANG) != 0 || how.si_pid == pid_)
            return true;
        if (std::chrono::steady_clock::now() >= until) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
}

bool ScriptProcess::ended() const noexcept { return reaped_ || endsWithin(std::chrono::milliseconds(0)); }

bool ScriptProcess::awaitEnd() const noexcept {
    siginfo_t how{};
    while (::waitid(P_PID, static_cast<id_t>(pid_), &how, WEXITED | WNOWAIT) < 0 && errno == EINTR) {
    }
    return ending_;
}

/// Waits for the end of the process.
void ScriptProcess::reap() noexcept {
    if (reaped_) return;
    siginfo_t how{};
    while (::waitid(P_PID, static_cast<id_t>(pid_), &how, WEXITED | WNOWAIT) < 0 && errno == EINTR) {
    }
    const std::lock_guard lock(life_);
    while (::waitpid(pid_, &status_, 0) < 0 && errno == EINTR) {
    }
    reaped_ = true;
}

ScriptError ScriptProcess::error(ErrorCode code, std::string reason, int line) const {
    return {code, std::move(reason), file_, line};
}

std::optional<ScriptError> ScriptProcess::load(HostPort& port, const ProtocolSource& source,
                                               std::optional<std::chrono::milliseconds> limit,
                                               std::function<bool()> stopped) {
    port_ = &port;
    stopped_ = std::move(stopped);
    file_ = fileOf(source);
    lines_ = static_cast<int>(std::ranges::count(source.text, '\n')) + 3;
    runLine_ = findRunLine(source.text);
    lastLine_ = 0;
    return serve({{"load", {{"file", file_}, {"text", source.text}}}}, limit);
}

std::optional<ScriptError> ScriptProcess::run(const nlohmann::json& parameters) {
    return serve({{"run", parameters}}, std::nullopt);
}

/// Sends the message and answers calls until the script reports its end.
std::optional<ScriptError> ScriptProcess::serve(const json& message, std::optional<std::chrono::milliseconds> limit) {
    if (reaped_) return error(ErrorCode::Io, "the script's process is gone");
    if (!ready_) {
        Patience start(pid_, kMaxStart);
        const auto begun = receiveMessage(socket_, watching(start));
        if (!begun) return lost(begun.error());
        ready_ = true;
    }
    Patience patience(pid_, limit);
    const WhileWaiting waiting = watching(patience);
    if (auto sent = sendMessage(socket_, message, waiting); !sent) return lost(sent.error());
    for (;;) {
        auto said = receiveMessage(socket_, waiting);
        if (!said) return lost(said.error());
        if (said->is_object() && said->contains("ended")) return endedBy((*said)["ended"]);
        const auto answered = answer(*said, patience);
        if (!answered) return lost({ErrorCode::ParseError, "said what no script can say"});
        if (!*answered) return lost(answered->error());
    }
}

/// Returns nothing for a message that calls no function.
std::optional<Result<void>> ScriptProcess::answer(const json& message, Patience& patience) {
    const auto& functions = hostFunctions();
    const WhileWaiting waiting = watching(patience);
    if (!message.is_object()) return std::nullopt;
    const bool refused = message.contains("refused");
    const auto index = wholeIn(message, refused ? "refused" : "call", -1);
    if (index < 0 || index >= static_cast<std::int64_t>(functions.size())) return std::nullopt;
    const HostFunction& function = functions[static_cast<std::size_t>(index)];
    if (refused) {  // the arguments cannot be handed over
        return sendMessage(
            socket_,
            remember({ErrorCode::InvalidArgument, fmt::format("{}: {}", function.fullName(), textIn(message, "why"))}),
            waiting);
    }
    const auto given = message.find("with");
    if (given == message.end() || !given->is_array()) return std::nullopt;
    const auto line = std::clamp<std::int64_t>(wholeIn(message, "line", 0), 0, lines_);
    if (line > 0) lastLine_ = static_cast<int>(line);
    auto value = port_->call(function, *given, static_cast<int>(line));
    patience.called();  // the duration of a host call does not count against the script
    if (value) {
        auto sent = sendMessage(socket_, {{"value", std::move(*value)}}, waiting);
        if (sent || sent.error().code != ErrorCode::InvalidArgument) return sent;
        value = failure(sent);  // the value is too large to hand over
    }
    return sendMessage(socket_, remember(value.error()), waiting);
}

/// Shortens the message, because it may contain the entire rejected value.
json ScriptProcess::remember(Error error) {
    error.message = shortened(error.message, kMaxReason);
    if (failures_.size() == kFailures) failures_.pop_front();
    failures_.emplace_back(nextFailure_, error);
    return {{"failure", nextFailure_++}, {"code", static_cast<int>(error.code)}, {"text", error.message}};
}

std::optional<ScriptError> ScriptProcess::endedBy(const json& ended) const {
    if (ended.is_null()) return std::nullopt;
    if (!ended.is_object()) return error(ErrorCode::ParseError, "ended in a way that no script can");
    const auto line = static_cast<int>(std::clamp<std::int64_t>(wholeIn(ended, "line", 0), 0, lines_));
    // Code and sentence of a failed call come from the program, whatever the script did with them.
    const auto number = wholeIn(ended, "failure", 0);
    for (const auto& [known, failed] : failures_)
        if (known == number) return error(failed.code, failed.message, line);
    if (flagOr(ended, "memory")) {
        return error(ErrorCode::Stopped, "the script asked for more memory than there is; output is off", line);
    }
    return error(ErrorCode::ParseError, textIn(ended, "reason"), line);
}

/// Ends the process, because nothing more can come from it.
ScriptError ScriptProcess::lost(const Error& why) {
    const bool asked = ending_;
    // A process that closed its socket but lives on has not ended by itself.
    const bool byItself = why.code == ErrorCode::Io && endsWithin(kLastMoments);
    if (!byItself) end();
    reap();
    if (asked) return error(ErrorCode::Stopped, "interrupted", lastLine_);
    if (!byItself && why.code == ErrorCode::Io)
        return error(ErrorCode::Io, "the script's process hung up, at this line or after it", lastLine_);
    if (!byItself) return error(why.code, why.message, lastLine_);
    if (WIFEXITED(status_) && WEXITSTATUS(status_) == kTooMuchMemory) {
        return error(ErrorCode::Stopped,
                     "stopped by the program: the script takes too much memory, at this line or after "
                     "it",
                     lastLine_);
    }
    if (WIFSIGNALED(status_) && WTERMSIG(status_) == SIGKILL) {
        return error(ErrorCode::Stopped,
                     "the script's process was ended from outside, as when memory is short, at this "
                     "line or after it",
                     lastLine_);
    }
    return error(ErrorCode::Io,
                 fmt::format("the script made the script engine crash ({} {}), at this line or after it",
                             WIFSIGNALED(status_) ? "signal" : "exit code",
                             WIFSIGNALED(status_) ? WTERMSIG(status_) : WEXITSTATUS(status_)),
                 lastLine_);
}

}  // namespace tacto
