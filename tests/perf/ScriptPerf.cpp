// The cost of running a script in a separate process: one call, compared with a word sent to another process and back;
// and the start, compared with the start of a program that does nothing.
#include <benchmark/benchmark.h>
#include <chrono>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include "app/scripting/engine/ScriptProcess.h"

extern char** environ;

namespace tacto {
namespace {

constexpr int kCalls = 20'000;
constexpr std::size_t kMemory = std::size_t{512} << 20;

/// Answers every call at once.
class QuickPort final : public HostPort {
public:
    Result<nlohmann::json> call(const HostFunction&, const nlohmann::json&, int) override { return 1.5; }
};

ProtocolSource scriptOf(const std::string& body) {
    ProtocolSource source;
    source.name = "perf";
    source.text = "function run(p) { " + body + " }";
    return source;
}

void scriptCall(benchmark::State& state) {
    QuickPort port;
    const auto process = ScriptProcess::start(kMemory).value();
    if (process->load(port, scriptOf("for (let i = 0; i < p.calls; ++i) bench.time;"))) state.SkipWithError("load");
    for (auto _ : state) {
        const auto begun = std::chrono::steady_clock::now();
        if (process->run({{"calls", kCalls}})) state.SkipWithError("run");
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begun;
        state.SetIterationTime(took.count() / kCalls);
    }
}
BENCHMARK(scriptCall)->Name("script/call")->Iterations(5)->UseManualTime()->Unit(benchmark::kMicrosecond);

void wordToAndFro(benchmark::State& state) {
    int ends[2];
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) return state.SkipWithError("socketpair");
    const pid_t child = ::fork();
    char word[32]{};
    if (child == 0) {
        ::close(ends[0]);
        while (::read(ends[1], word, sizeof word) == sizeof word && ::write(ends[1], word, sizeof word) > 0) {
        }
        ::_exit(0);
    }
    ::close(ends[1]);
    for (auto _ : state) {
        if (::write(ends[0], word, sizeof word) != sizeof word || ::read(ends[0], word, sizeof word) != sizeof word)
            state.SkipWithError("the other process is gone");
    }
    ::close(ends[0]);
    ::waitpid(child, nullptr, 0);
}
BENCHMARK(wordToAndFro)->Name("script/baseline: a word to and fro")->UseRealTime()->Unit(benchmark::kMicrosecond);

void scriptStart(benchmark::State& state) {
    QuickPort port;
    for (auto _ : state) {
        const auto process = ScriptProcess::start(kMemory).value();
        if (process->load(port, scriptOf(""))) state.SkipWithError("load");
    }
}
BENCHMARK(scriptStart)->Name("script/start")->Iterations(20)->UseRealTime()->Unit(benchmark::kMillisecond);

void emptyProgram(benchmark::State& state) {
    char name[] = "/bin/true";
    char* const arguments[] = {name, nullptr};
    for (auto _ : state) {
        pid_t pid = 0;
        if (::posix_spawn(&pid, name, nullptr, nullptr, arguments, environ) != 0) state.SkipWithError("spawn");
        ::waitpid(pid, nullptr, 0);
    }
}
BENCHMARK(emptyProgram)->Name("script/baseline: /bin/true")->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace tacto
