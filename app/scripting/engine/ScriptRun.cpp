#include "app/scripting/engine/ScriptRun.h"

#include <QCoreApplication>
#include <atomic>
#include <condition_variable>
#include <cstdlib>
#include <mutex>
#include <poll.h>
#include <system_error>
#include <thread>
#include <unistd.h>

#include "app/scripting/engine/Arguments.h"
#include "app/scripting/engine/MemoryGuard.h"
#include "app/scripting/engine/ScriptSession.h"
#include "app/scripting/engine/ScriptThread.h"
#include "core/pilot/PilotSession.h"
#include "core/session/SessionWriter.h"

namespace tacto {

namespace {
/// A host call wakes within milliseconds of a stop. One that does not leaves the bench in two hands.
constexpr std::chrono::seconds kHostCallLimit{5};

/// Without the C library's streams: the thread that stands still may hold them, and stderr may take nothing.
[[noreturn]] void endProgram(const std::string& why) {
    pollfd out{STDERR_FILENO, POLLOUT, 0};
    if (::poll(&out, 1, 0) == 1 && (out.revents & POLLOUT) != 0)
        static_cast<void>(!::write(STDERR_FILENO, why.data(), why.size()));
    std::abort();
}

}  // namespace

/// Shared with the script's thread, which may outlive the ScriptRun when it was abandoned.
struct ScriptRun::State final : HostPort {
    explicit State(RunRequest given) : request(std::move(given)), session(request) {}

    RunRequest request;
    ScriptSession session;             // guarded by access
    std::timed_mutex access;           // held during a host call, so that giving up never cuts into one
    bool abandoned = false;            // guarded by access
    nlohmann::json declared;           // guarded by access
    std::optional<ScriptError> error;  // guarded by access
    bool ended = false;                // guarded by access
    bool stoppedInTime = false;        // guarded by access: the stop came before the script's end
    bool running = false;              // the script's thread only
    std::atomic<int> line{0};          // of the last host call

    std::mutex control;  // held for moments only
    std::condition_variable woken;
    bool paused = false;    // guarded by control
    bool stopping = false;  // guarded by control
    bool over = false;      // guarded by control: the bench may be gone
    std::string stoppedBy;  // guarded by control

    std::unique_ptr<ScriptThread> thread;  // set once, before stop() can be called
    std::unique_ptr<MemoryGuard> memory;   // ends before the thread does
    std::optional<ScriptOutcome> outcome;  // wait()'s caller only

    Result<nlohmann::json> call(const HostFunction& function, const nlohmann::json& arguments, int from) override;
    [[nodiscard]] Result<nlohmann::json> callChecked(const HostFunction& function, const nlohmann::json& arguments);
    void stop(const char* by) noexcept;
    void execute(Sandbox& sandbox);
    [[nodiscard]] std::optional<ScriptError> checkDeclared();
    void writeAbout();
    void conclude(ScriptThread::End end);
    std::uint64_t faultsBefore = 0;  // of the bench, at the start
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
        woken.wait(lock, [this] { return !paused || stopping; });
        if (stopping) return fail(ErrorCode::Stopped, "stopped by {}", stoppedBy);
    }
    const std::lock_guard lock(access);
    if (abandoned) return fail(ErrorCode::Stopped, "this script was abandoned");
    if (declares) {
        // As the program read it: the first one counts, and none inside run(p).
        if (running || !declared.is_null()) return fail(ErrorCode::InvalidArgument, "protocol() was called twice");
        declared = arguments;
        return nlohmann::json();
    }
    if (const auto& end = session.endedWith()) return tl::unexpected<Error>(*end);
    request.bench->attend();  // a script that calls runs
    try {
        auto answer = callChecked(function, arguments);
        if (!answer && function.failsDisarmed) request.bench->disarm();
        request.bench->attend();
        return answer;
    } catch (const std::exception& surprise) {  // of a library, as JSON or memory: the script gets it as an Error
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
        if (request.pilot != nullptr) request.pilot->endRun();  // a flag: no test takes this stop for its own
        request.bench->stop(by);                                // the output first
        if (!stopping) stoppedBy = by;
        stopping = true;
    }
    woken.notify_all();
    if (request.operatorDesk != nullptr) request.operatorDesk->cancel();
    if (request.pilot != nullptr) request.pilot->cancel();
    thread->interrupt();
}

void ScriptRun::State::execute(Sandbox& sandbox) {
    line = sandbox.runLine();
    auto failed = sandbox.load();
    if (!failed) failed = checkDeclared();
    if (!failed) {
        running = true;
        writeAbout();
        failed = sandbox.run(request.parameters);
    }
    bool stopped = false;
    {
        const std::lock_guard lock(control);
        stopped = stopping;
    }
    const std::lock_guard lock(access);
    if (abandoned) return;
    request.bench->disarm();
    error = std::move(failed);
    stoppedInTime = stopped;  // also where the script swallowed it
    ended = true;
}

/// The title and the settings of a report are those that the operator saw, not what a script declares by the clock
/// (hazard H9).
std::optional<ScriptError> ScriptRun::State::checkDeclared() {
    const std::lock_guard lock(access);
    if (abandoned) return std::nullopt;
    std::optional<ProtocolDeclaration> now;
    if (declared.is_array()) {
        if (auto read = parseDeclaration(declared[0], declared[1], declared[2])) now = std::move(*read);
    }
    if (!request.declaration) {  // nothing was read before
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
    const std::lock_guard lock(access);
    const auto& declaration = request.declaration;
    if (abandoned || request.session == nullptr || !declaration) return;
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

void ScriptRun::State::conclude(ScriptThread::End end) {
    memory.reset();
    {
        const std::lock_guard lock(control);
        over = true;  // from here on stop() leaves the bench alone
    }
    std::unique_lock lock(access, std::defer_lock);
    if (!lock.try_lock_for(kHostCallLimit)) {
        request.bench->stop("a host call that does not end");
        endProgram(fmt::format("a call of script {} into the bench did not end after a stop; ending with outputs off\n",
                               request.script.name));
    }
    session.recordExposure();
    ScriptOutcome result;
    result.file = fileOf(request.script);
    if (end == ScriptThread::End::Abandoned && !ended) {
        abandoned = true;  // no host call of it does anything from here on
        request.bench->disarm();
        result.log = session.takeLog();
        result.abandoned = true;
        result.verdict = ScriptVerdict::Stopped;
        result.line = line;
        result.error =
            Error{ErrorCode::Stopped,
                  stopText(line) + "; it did not end within a second, so it was abandoned with the output off"};
        request.onProgress = nullptr;
        request.onLog = nullptr;
    } else {
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
        // What the script swallowed is still the end of the run: no verdict stands on what came after it.
        if (!result.error && session.endedWith()) {
            result.verdict =
                session.endedWith()->code == ErrorCode::Stopped ? ScriptVerdict::Stopped : ScriptVerdict::None;
            result.line = line;
            result.error = session.endedWith();
        }
        if (!result.error && request.bench != nullptr &&
            request.bench->faults() > faultsBefore + session.expectedFaults()) {
            result.verdict = ScriptVerdict::Stopped;
            result.error = Error{request.bench->faultCode(), fmt::format("fault during the run: {}. Output is off.",
                                                                         request.bench->telemetry().reason.view())};
        }
        if (!result.error && request.bench->recordsLost() > 0) {
            result.verdict = ScriptVerdict::None;
            result.error = Error{ErrorCode::Io, fmt::format("{} records of this run were lost: the disk was too slow. "
                                                            "There is no verdict on what is not on record.",
                                                            request.bench->recordsLost())};
        }
        if (result.error) {
            result.results = result.abandoned ? nlohmann::json() : session.takePartial();
            result.reasons = {result.error->message};
        }
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
        writeEvent(outcome->abandoned ? "script abandoned" : "script ended by an error",
                   {{"message", outcome->error->message}});
    }
    // A protocol that judges nothing may say what it found all the same: that stands where the verdict would.
    const bool judged = outcome->verdict != ScriptVerdict::None;
    if (!judged && (outcome->error || outcome->reasons.empty())) return session.recordBasis(outcome->results);
    auto written =
        request.session->verdict(session.now(), request.script.name, judged ? nameOf(outcome->verdict) : "none",
                                 outcome->reasons, outcome->results);
    if (written || outcome->error) return;
    outcome->verdict = ScriptVerdict::None;  // a verdict that is not on disk was not given (hazard H8)
    outcome->error = written.error();
}

ScriptRun::ScriptRun(std::shared_ptr<State> state) : state_(std::move(state)) {}

Result<std::unique_ptr<ScriptRun>> ScriptRun::start(RunRequest request) {
    if (request.bench == nullptr) return fail(ErrorCode::InvalidArgument, "a script cannot run without a bench");
    if (QCoreApplication::instance() == nullptr) {
        return fail(ErrorCode::InvalidArgument, "a script cannot run without a QCoreApplication");
    }
    if (auto begun = request.bench->begin(request.asked); !begun) {
        return fail(ErrorCode::Stopped, "stopped by operator before the script began: nothing was delivered");
    }
    request.bench->resume();  // a pause from before this run is over
    auto state = std::make_shared<State>(std::move(request));
    state->faultsBefore = state->request.bench->faults();
    State* raw = state.get();  // the thread keeps the port, which is the state, alive
    try {
        state->thread = std::make_unique<ScriptThread>(state, state->request.script,
                                                       [raw](Sandbox& sandbox) { raw->execute(sandbox); });
        // If the guard gets no thread, `run` stops the script as it goes. The guard stops the script through its
        // thread.
        std::unique_ptr<ScriptRun> run(new ScriptRun(state));
        state->memory =
            std::make_unique<MemoryGuard>([raw] { raw->stop("the program: the script takes too much memory"); },
                                          state->request.memoryLimit.value_or(MemoryGuard::usualLimit()));
        return run;
    } catch (const std::system_error& refused) {
        return fail(ErrorCode::Io, "the script cannot run: the system gives this program no thread ({})",
                    refused.what());
    }
}

ScriptRun::~ScriptRun() {
    stop("the program");
    (void)wait();
    state_->thread.reset();
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

ScriptOutcome ScriptRun::wait() {
    if (!state_->outcome) state_->conclude(state_->thread->wait());
    return *state_->outcome;
}

std::optional<ScriptOutcome> ScriptRun::waitFor(std::chrono::milliseconds time) {
    if (state_->outcome) return state_->outcome;
    const auto end = state_->thread->wait(time);
    if (end == ScriptThread::End::Running) return std::nullopt;
    state_->conclude(end);
    return state_->outcome;
}

int ScriptRun::abandonedRunning() noexcept { return ScriptThread::abandonedRunning(); }

Result<ScriptOutcome> runProtocol(RunRequest request) {
    auto run = ScriptRun::start(std::move(request));
    if (!run) return failure(run);
    return (*run)->wait();
}

}  // namespace tacto
