// A script that wants more memory than exists, or more than it may have: the run ends with the output off; the program
// and the session continue.
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include "core/session/SessionReader.h"
#include "core/session/SessionVerify.h"
#include "tests/scripting/RunBench.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;

constexpr std::size_t kLimit = std::size_t{150} << 20;

struct Ended {
    ScriptOutcome outcome;
    bool off = false;
    bool closed = false;  // the session is closed and valid
    std::string events;
};

/// During its lifetime, the program can get only 1 GiB more; then allocating fails.
class LittleMemory {
public:
    LittleMemory() {
        static_cast<void>(::getrlimit(RLIMIT_AS, &before_));
        std::ifstream statm("/proc/self/statm");
        rlim_t pages = 0;
        statm >> pages;
        auto now = before_;
        now.rlim_cur = pages * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE)) + (rlim_t{1} << 30);
        static_cast<void>(::setrlimit(RLIMIT_AS, &now));
    }
    ~LittleMemory() { static_cast<void>(::setrlimit(RLIMIT_AS, &before_)); }
    LittleMemory(const LittleMemory&) = delete;
    LittleMemory& operator=(const LittleMemory&) = delete;

private:
    rlimit before_{};
};

/// Runs `greed` while the output delivers.
Ended run(const std::string& greed, std::size_t limit) {
    RunBench rig(true, "sim:", 1, true);
    auto request =
        rig.request(withRun("bench.arm({ load: 1000 }); bench.drive(\"manual\", { roughness: 1, pressure: 1 });"
                            "bench.wait(1);\n" +
                            greed));
    request.memoryLimit = limit;
    Ended ended;
    ended.outcome = runProtocol(std::move(request)).value();
    ended.off = rig.outputOff();
    rig.closeBench();
    ended.closed = rig.writer().close().has_value();
    const auto reader = SessionReader::open(rig.folder().path() / "run.tacto");
    if (!reader) return ended;
    const auto events = reader->events().value();
    for (const auto& row : events) ended.events += row.name + " " + row.body.dump() + "\n";
    return ended;
}

void expectEnded(const Ended& ended, const std::string& message) {
    ASSERT_TRUE(ended.outcome.error);
    EXPECT_THAT(ended.outcome.error->message, HasSubstr(message));
    EXPECT_NE(ended.outcome.verdict, ScriptVerdict::Pass);
    EXPECT_TRUE(ended.off);
    EXPECT_TRUE(ended.closed);
    EXPECT_THAT(ended.events, HasSubstr("script ended by an error"));
}

class ScriptMemory : public testing::TestWithParam<std::pair<const char*, const char*>> {
protected:
    void SetUp() override {
#ifdef TACTOSCOPE_SANITIZED
        GTEST_SKIP() << "the sanitizer ends a program that asks for too much";
#endif
    }
};

TEST_P(ScriptMemory, EndsTheRunWithTheOutputOff) {
    RecordProperty("hazard", "H10");
    const auto& [greed, message] = GetParam();
    SCOPED_TRACE(greed);
    expectEnded(run(greed, kLimit), message);
}

class ScriptWithoutMemory : public ScriptMemory {};

TEST_P(ScriptWithoutMemory, EndsTheRunWithTheOutputOff) {
    RecordProperty("hazard", "H10");
    const auto& [greed, message] = GetParam();
    SCOPED_TRACE(greed);
    const LittleMemory little;
    expectEnded(run(greed, std::size_t{1} << 40), message);
}

// The engine throws std::bad_alloc, even from code that is hot enough to be compiled.
INSTANTIATE_TEST_SUITE_P(
    Greed, ScriptWithoutMemory,
    testing::Values(std::pair("let s = 'x'; for (;;) { s += s; s.charCodeAt(0); }",
                              "asked for more memory than there is"),
                    std::pair("function f(n) { let s = 'x'; for (let i = 0; i < n; i++) { s += s; s.charCodeAt(0); } }"
                              "for (let i = 0; i < 2000; i++) f(8); f(40);",
                              "asked for more memory than there is"),
                    std::pair("try { let s = 'x'; for (;;) { s += s; s.charCodeAt(0); } } catch (e) {}"
                              "finally { return verdict({ verdict: 'pass' }); }",
                              "asked for more memory than there is")));

INSTANTIATE_TEST_SUITE_P(
    Greed, ScriptMemory,
    testing::Values(
        // More than the script may have.
        std::pair("const kept = []; for (let i = 0; ; i++) kept.push('x'.repeat(1e6) + i);", "takes too much memory"),
        std::pair("const kept = []; for (;;) kept.push(new Float64Array(1e6).fill(1));", "takes too much memory"),
        std::pair("const s = 'x'.repeat(2 ** 28); for (;;) s.charCodeAt(0);", "takes too much memory"),
        // Refused with the engine's own error.
        std::pair("new ArrayBuffer(1e12);", "RangeError")));

TEST(ScriptMemoryOfALine, ThatOnlyDeclaresIsWatchedToo) {
    RecordProperty("hazard", "H10");
#ifdef TACTOSCOPE_SANITIZED
    GTEST_SKIP() << "the sanitizer ends a program that asks for too much";
#endif
    const auto declared = [](const std::string& top) {
        const auto read = readDeclaration(probe(top + "\nprotocol({ title: \"Probe\" }); function run() {}"));
        return read ? std::string("read") : read.error().message;
    };
    EXPECT_THAT(declared("const kept = []; for (;;) kept.push(new Float64Array(1e6).fill(1));"),
                testing::AnyOf(HasSubstr("took more than 512 MiB"), HasSubstr("did not end within")));
    EXPECT_THAT(declared("for (;;) ;"), HasSubstr("did not end within 1000 ms"));
    EXPECT_EQ(declared(""), "read");
}

}  // namespace
}  // namespace tacto::test
