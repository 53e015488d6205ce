#include "app/scripting/engine/ScriptRun.h"

#include <atomic>
#include <condition_variable>
#include <cstdlib>
#include <mutex>
#include <system_error>
#include <thread>
#include <unistd.h>

#include "app/scripting/engine/Arguments.h"
#include "app/scripting/engine/ScriptProcess.h"
#include "app/scripting/engine/ScriptSession.h"
#include "app/scripting/wire/MemoryGuard.h"
#include "core/base/ProgramStart.h"
#include "core/kinds/ResultKinds.h"
#include "core/pilot/PilotSession.h"
#include "core/session/SessionWriter.h"

namespace tacto {

namespace {
constexpr std::chrono::seconds kHostCallLimit{5};

/// Writes without the C library's streams: the stopped thread may hold their lock, and stderr may accept nothing.
[[noreturn]] void endProgram(const std::string& why) {
    if (takesMore(STDERR_FILENO)) static_cast<void>(!::write(STDERR_FILENO, why.data(), why.size()));
    std::abort();
}

}  // namespace

/// Members without a guard belong to the script's thread until it has ended, then to the caller of wait().
struct ScriptRun::State final : HostPort {
    State(RunRequest given, std::unique_ptr<ScriptProcess> started)
        : request(std::move(given)), session(request), process(std::move(started)) {}

    RunRequest request;
    ScriptSession session;
    nlohmann::json declared;
    std::optional<ScriptError> error;
    bool stoppedInTime = false;  // the stop came before the script ended
    bool running = false;
    int line = 0;  // the line of the last host call

    std::mutex control;  // held only for moments
    std::condition_variable woken;
    bool paused = false;    // guarded by control
    bool stopping = false;  // guarded by control
    bool lost = false;      // guarded by control: the script's process ended by itself
    bool ended = false;     // guarded by control: the script's thread has released everything
    bool over = false;      // guarded by control: the bench may no longer exist
    std::string stoppedBy;  // guarded by control
    std::optional<std::chrono::steady_clock::time_point> endedAt;  // guarded by control: output ended from outside

    const std::unique_ptr<ScriptProcess> process;
    std::thread thread;                    // serves the process
    std::thread watch;                     // waits for the process to end, also during a host call
    std::unique_ptr<MemoryGuard> memory;   // limits the memory that the program keeps for the script
    std::optional<ScriptOutcome> outcome;  // used only by the caller of wait()

    Result<nlohmann::json> call(const HostFunction& function, const nlohmann::json& arguments, int from) override;
    [[nodiscard]] Result<nlohmann::json> callChecked(const HostFunction& function, const nlohmann::json& arguments);
    void stop(const char* by) noexcept;
    void endOutput(const char* by) noexcept;
    void wake() noexcept;
    void watchProcess() noexcept;
    void execute();
    [[nodiscard]] std::optional<ScriptError> loadAndRun();
    [[nodiscard]] bool waitForEnd(std::optional<std::chrono::milliseconds> limit);
    [[nodiscard]] std::optional<ScriptError> checkDeclared();
    void writeAbout();
    void conclude();
    std::uint64_t faultsBefore = 0;  // the bench's faults at the start
    void writeVerdict();
    void writeEvent(std::string_view kind, const nlohmann::json& details);
    [[nodiscard]] std::string stopText(int at);
};

Result<nlohmann::json> ScriptRun::State::call(const HostFunction& function, const nlohmann::json& arguments, int from) {
    if (from > 0) line = from;
    const bool declares = function.object.empty() && function.name == "protocol";
    if (!running && !declares) {
        return fail(ErrorCode::InvalidArgument, "{} can be used inside run(p) only", function.fullName());
    }
    {
        std::unique_lock lock(control);
        woken.wait(lock, [this] { return !paused || stopping || lost; });
        if (stopping) return fail(ErrorCode::Stopped, "stopped by {}", stoppedBy);
        if (lost) return fail(ErrorCode::Stopped, "the script's process has ended");
    }
    if (declares) {
        // Only the first declaration counts, and run(p) cannot declare, because the program read the script that way.
        if (running || !declared.is_null()) return fail(ErrorCode::InvalidArgument, "protocol() was called twice");
        declared = arguments;
        return nlohmann::json();
    }
    if (const auto& end = session.endedWith()) return tl::unexpected<Error>(*end);
    request.bench->attend();  // a script that makes calls is running
    try {
        auto answer = callChecked(function, arguments);
        if (!answer && function.failsDisarmed) request.bench->disarm();
        request.bench->attend();
        return answer;
    } catch (const std::exception& surprise) {  // from a library such as JSON: an Error in the script
        if (function.failsDisarmed) request.bench->disarm();
        return fail(ErrorCode::InvalidArgument, "{}: {}", function.fullName(), surprise.what());
    }
}

Result<nlohmann::json> ScriptRun::State::callChecked(const HostFunction& function, const nlohmann::json& arguments) {
    const auto checked = Arguments::check(function, arguments);
    if (!checked) return failure(checked);
    if (function.needs && !request.bench->devices().has(*function.needs))
        return fail(ErrorCode::Unsupported, "{}: no {} is connected", function.fullName(), nameOf(*function.needs));
    return function.call(session, *checked);
}

void ScriptRun::State::stop(const char* by) noexcept {
    {
        const std::lock_guard lock(control);
        if (over) return;
        endOutput(by);
        if (!stopping) stoppedBy = by;
        stopping = true;
    }
    wake();
    process->end();
}

/// Call with `control` held. Switches the output off first.
void ScriptRun::State::endOutput(const char* by) noexcept {
    if (request.pilot != nullptr) request.pilot->endRun();  // sets a flag, so that no test reacts to this stop
    request.bench->stop(by);
    if (!endedAt) endedAt = std::chrono::steady_clock::now();
}

void ScriptRun::State::wake() noexcept {
    woken.notify_all();
    if (request.operatorDesk != nullptr) request.operatorDesk->cancel();
    if (request.pilot != nullptr) request.pilot->cancel();
}

/// A script without a process must not drive anything, whatever host call it still has under way.
void ScriptRun::State::watchProcess() noexcept {
    if (process->awaitEnd()) return;
    {
        const std::lock_guard lock(control);
        if (over || ended) return;
        lost = true;
        endOutput("the end of the script's process");
    }
    wake();
}

std::optional<ScriptError> ScriptRun::State::loadAndRun() {
    auto failed = process->load(*this, request.script);
    line = std::max(line, process->runLine());
    if (!failed) failed = checkDeclared();
    if (failed) return failed;
    running = true;
    writeAbout();
    return process->run(request.parameters);
}

void ScriptRun::State::execute() {
    try {
        error = loadAndRun();
    } catch (const std::exception& surprise) {  // mostly exhausted memory
        process->end();
        error = ScriptError{ErrorCode::Io, surprise.what(), fileOf(request.script), line};
    }
    request.bench->disarm();  // in every case: run() returned, threw, crashed or was ended
    const std::lock_guard lock(control);
    stoppedInTime = stopping;  // the run was stopped, even if the script caught the error
    ended = true;
    woken.notify_all();
}

/// Returns whether the script's thread has ended. After a stop the process is gone at once and a host call returns
/// within milliseconds; a call that does not return would leave the bench with two users.
bool ScriptRun::State::waitForEnd(std::optional<std::chrono::milliseconds> limit) {
    std::unique_lock lock(control);
    const auto until = std::chrono::steady_clock::now() + limit.value_or(std::chrono::milliseconds(0));
    while (!ended) {
        const auto now = std::chrono::steady_clock::now();
        if (endedAt && now > *endedAt + kHostCallLimit) {
            lock.unlock();
            request.bench->stop("a host call that does not end");
            endProgram(
                fmt::format("a call of script {} into the bench did not end after a stop; ending with outputs off\n",
                            request.script.name));
        }
        if (limit && now >= until) return false;
        constexpr std::chrono::milliseconds kLook{200};
        woken.wait_until(lock, limit ? std::min(until, now + kLook) : now + kLook);
    }
    return true;
}

/// A report shows the title and settings that the operator saw, not what a script declares later, for instance
/// depending on the clock (hazard H9).
std::optional<ScriptError> ScriptRun::State::checkDeclared() {
    std::optional<ProtocolDeclaration> now;
    if (declared.is_array()) {
        if (auto read = parseDeclaration(declared[0], declared[1], declared[2])) now = std::move(*read);
    }
    if (!request.declaration) {  // the script was not read before
        request.declaration = std::move(now);
        return std::nullopt;
    }
    const auto difference = now ? differenceOf(*request.declaration, *now) : "nothing that can be read";
    if (difference.empty()) return std::nullopt;
    return ScriptError{ErrorCode::ParseError,
                       fmt::format("when it runs the script declares {}; it must declare what it declared when it was "
                                   "read before",
                                   difference),
                       fileOf(request.script), 1};
}

void ScriptRun::State::writeAbout() {
    const auto& declaration = request.declaration;
    if (request.session == nullptr || !declaration) return;
    nlohmann::json parameters = nlohmann::json::array();
    for (const auto& parameter : declaration->parameters) {
        parameters.push_back({{"name", parameter.name},
                              {"label", parameter.label},
                              {"value", request.parameters.value(parameter.name, parameter.value)},
                              {"unit", parameter.unit}});
        if (!parameter.zero.empty() && parameters.back()["value"] == 0) parameters.back()["shown"] = parameter.zero;
        for (const auto& [key, words] : parameter.choices)
            if (parameters.back()["value"] == key) parameters.back()["shown"] = words;
    }
    (void)request.session->reportItem(session.now(), {{"kind", "about"},
                                                      {"title", declaration->title},
                                                      {"purpose", declaration->purpose},
                                                      {"result_kind", declaration->kind},
                                                      {"parameters", parameters}});
}

std::string ScriptRun::State::stopText(int at) {
    std::string by;
    {
        const std::lock_guard lock(control);
        by = stoppedBy;
    }
    return fmt::format("{}:{}: stopped by {}, at this line or after it", fileOf(request.script), at, by);
}

void ScriptRun::State::conclude() {
    if (thread.joinable()) thread.join();
    process->end();
    if (watch.joinable()) watch.join();
    memory.reset();
    {
        const std::lock_guard lock(control);
        over = true;  // from here on stop() leaves the bench alone
    }
    session.recordExposure();
    ScriptOutcome result;
    result.file = fileOf(request.script);
    session.finish(result);
    if (stoppedInTime) {
        result.verdict = ScriptVerdict::Stopped;
        result.line = line;
        result.error = Error{ErrorCode::Stopped, stopText(line)};
    } else if (error) {
        result.verdict = error->code == ErrorCode::Stopped ? ScriptVerdict::Stopped : ScriptVerdict::None;
        result.line = error->line;
        result.error = Error{error->code, error->text()};
    }
    // This error ends the run even if the script caught it: no verdict may be based on what came after it.
    if (!result.error && session.endedWith()) {
        result.verdict = session.endedWith()->code == ErrorCode::Stopped ? ScriptVerdict::Stopped : ScriptVerdict::None;
        result.line = line;
        result.error = session.endedWith();
    }
    if (!result.error && request.bench->faults() > faultsBefore + session.expectedFaults()) {
        result.verdict = ScriptVerdict::Stopped;
        result.error = Error{request.bench->faultCode(),
                             fmt::format("fault during the run: {}. {}", request.bench->telemetry().reason.view(),
                                         outputAfter(request.bench->telemetry().fault))};
    }
    if (!result.error && request.bench->recordsLost() > 0) {
        result.verdict = ScriptVerdict::None;
        result.error = Error{ErrorCode::Io, fmt::format("{} records of this run were lost: the disk was too slow. "
                                                        "There is no verdict on what is not on record.",
                                                        request.bench->recordsLost())};
    }
    if (result.error) {
        result.results = session.takePartial();
        result.reasons = {result.error->message};
    }
    outcome = std::move(result);
    writeVerdict();
}

void ScriptRun::State::writeEvent(std::string_view kind, const nlohmann::json& details) {
    auto written = request.session->event(session.now(), kind, details);
    if (!written && !outcome->error) outcome->error = written.error();
}

void ScriptRun::State::writeVerdict() {
    if (request.session == nullptr) return;
    if (outcome->error) {
        writeEvent("script ended by an error", {{"message", outcome->error->message}});
    }
    if (auto shown = shownInReports(outcome->results); !shown.is_null())
        (void)request.session->reportItem(session.now(), {{"kind", "results"}, {"results", std::move(shown)}});
    // A protocol that judges nothing may still report reasons: they take the place of the verdict.
    const bool judged = outcome->verdict != ScriptVerdict::None;
    if (!judged && (outcome->error || outcome->reasons.empty())) return session.recordBasis(outcome->results);
    auto written =
        request.session->verdict(session.now(), request.script.name, judged ? nameOf(outcome->verdict) : "none",
                                 outcome->reasons, outcome->results);
    if (written || outcome->error) return;
    outcome->verdict = ScriptVerdict::None;  // a verdict that is not on disk does not count (hazard H8)
    outcome->error = written.error();
}

ScriptRun::ScriptRun(std::unique_ptr<State> state) : state_(std::move(state)) {}

Result<std::unique_ptr<ScriptRun>> ScriptRun::start(RunRequest request) {
    if (request.bench == nullptr) return fail(ErrorCode::InvalidArgument, "a script cannot run without a bench");
    if (auto begun = request.bench->begin(request.asked); !begun) {
        return fail(ErrorCode::Stopped, "stopped by operator before the script began: nothing was delivered");
    }
    const auto memory = request.memoryLimit.value_or(MemoryGuard::usualLimit());
    auto process = ScriptProcess::start(memory, request.program);
    if (!process) return failure(process);
    request.bench->resume();  // ends a pause from before this run
    std::unique_ptr<ScriptRun> run(new ScriptRun(std::make_unique<State>(std::move(request), std::move(*process))));
    State& state = *run->state_;
    state.faultsBefore = state.request.bench->faults();
    try {
        state.memory = std::make_unique<MemoryGuard>(
            [&state] { state.stop("the program: the script makes it take too much memory"); }, memory);
        state.watch = std::thread([&state] { state.watchProcess(); });
        state.thread = std::thread([&state] { state.execute(); });
        return run;
    } catch (const std::system_error& refused) {
        const std::lock_guard lock(state.control);
        state.ended = true;
        return fail(ErrorCode::Io, "the script cannot run: the system gives this program no thread ({})",
                    refused.what());
    }
}

ScriptRun::~ScriptRun() {
    stop("the program");
    (void)wait();
}

void ScriptRun::stop(const char* by) noexcept { state_->stop(by); }

void ScriptRun::pause() noexcept {
    const std::lock_guard lock(state_->control);
    if (state_->over || state_->stopping) return;
    state_->request.bench->pause();
    state_->paused = true;
}

void ScriptRun::resume() noexcept {
    {
        const std::lock_guard lock(state_->control);
        if (state_->over || state_->stopping) return;
        state_->request.bench->resume();
        state_->paused = false;
    }
    state_->woken.notify_all();
}

bool ScriptRun::paused() const noexcept {
    const std::lock_guard lock(state_->control);
    return state_->paused && !state_->over && !state_->stopping;
}

int ScriptRun::processId() const noexcept { return state_->process->id(); }

ScriptOutcome ScriptRun::wait() {
    if (!state_->outcome && state_->waitForEnd({})) state_->conclude();
    return *state_->outcome;
}

std::optional<ScriptOutcome> ScriptRun::waitFor(std::chrono::milliseconds time) {
    if (!state_->outcome && state_->waitForEnd(time)) state_->conclude();
    return state_->outcome;
}

Result<ScriptOutcome> runProtocol(RunRequest request) {
    auto run = ScriptRun::start(std::move(request));
    if (!run) return failure(run);
    return (*run)->wait();
}

}  // namespace tacto
