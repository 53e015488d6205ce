#include "tests/cli/PilotDesk.h"

#include <csignal>
#include <fcntl.h>
#include <fmt/chrono.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/base/Clock.h"
#include "core/session/SessionWriter.h"
#include "core/study/Study.h"
#include "tests/support/InTime.h"

namespace tacto::test {

Words shortSession() { return {"--set", "participant=virtual:7", "--set", "blocks=1"}; }

namespace {

/// A session rightly refuses a STOP that takes over 10 ms; on a machine that stood still this shows nothing.
Ran stopsInTime(Ran ran) {
    const bool inTime = ran.err.find("to switch off; at most 10 ms are accepted") == std::string::npos;
    [&] { ASSERT_IN_TIME(inTime) << ran.err; }();
    return ran;
}

}  // namespace

Words PilotDesk::words(const std::string& protocol, const Words& more, const std::string& study) const {
    Words all{"run", protocol, "--out", desk_.at(study), "--json"};
    for (const auto& device : devices_) all.insert(all.end(), {"--device", device});
    all.insert(all.end(), more.begin(), more.end());
    return all;
}

Ran PilotDesk::run(const std::string& protocol, const Words& more, const std::string& study) const {
    return stopsInTime(desk_.run(words(protocol, more, study)));
}

void PilotDesk::writeUnfinished(const std::string& folder, const std::string& protocol,
                                const std::vector<WrittenRow>& rows, std::chrono::sys_seconds begunAt) const {
    auto study = Study::createRehearsal(desk_.at(folder)).value();
    Participant who;
    who.virtualSeed = 7;
    const auto code = study.enrol(who).value().code;
    ASSERT_TRUE(study.consent(code, {study.settings().consentVersion, study.today(), "KL"}));
    SessionRequest request;
    request.code = code;
    request.script = {protocol, "a"};
    request.encoding = "standard";
    request.codeConfirmed = request.devicesSimulated = true;
    request.exclusions = nothingExcludes();
    const auto begun = study.beginSession(request).value();
    VirtualClock clock;
    SessionAbout about;
    about.wallStart = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::chrono::system_clock::to_time_t(begunAt)));
    auto writer = SessionWriter::create(begun.path, about, clock, begun.seal);
    ASSERT_TRUE(writer) << writer.error().message;
    for (const auto& row : rows) ASSERT_TRUE((*writer)->event(clock.now(), row.kind, row.body));
    ASSERT_TRUE((*writer)->close());
}

Ran PilotDesk::runDisturbed(const Disturbance& by, const std::string& protocol, const Words& more,
                            const std::string& study) const {
    auto given = desk_.environment(TACTO_KILL_AT_SYNC_LIBRARY ":" TACTO_MOVED_CLOCK_LIBRARY);
    given.push_back("TACTO_KILL_AT_SYNC=" + std::to_string(by.killAtSync));
    given.push_back("TACTO_CLOCK_AHEAD=" + std::to_string(by.clock.count()));
    given.push_back("TACTO_CLOCK_FROM_SYNC=" + std::to_string(by.clockFromSync));
    auto all = Words{TACTO_CLI} + words(protocol, more, study);
    std::vector<char*> arguments, variables;
    for (auto& each : all) arguments.push_back(each.data());
    for (auto& each : given) variables.push_back(each.data());
    arguments.push_back(nullptr);
    variables.push_back(nullptr);
    const ScratchDir streams;
    const auto out = (streams.path() / "out").string(), err = (streams.path() / "err").string();
    const pid_t child = fork();
    if (child == 0) {
        constexpr int kFresh = O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC;
        dup2(open("/dev/null", O_RDONLY | O_CLOEXEC), 0);
        dup2(open(out.c_str(), kFresh, 0600), 1);
        dup2(open(err.c_str(), kFresh, 0600), 2);
        if (by.largestFile > 0) {
            signal(SIGXFSZ, SIG_IGN);
            const rlimit most{by.largestFile, by.largestFile};
            setrlimit(RLIMIT_FSIZE, &most);
        }
        execve(TACTO_CLI, arguments.data(), variables.data());
        _exit(127);
    }
    int status = 0;
    EXPECT_EQ(waitpid(child, &status, 0), child);
    return stopsInTime({WIFSIGNALED(status) ? -WTERMSIG(status) : WEXITSTATUS(status), contentOf(out), contentOf(err)});
}

int PilotDesk::runKilled(long sync, const std::string& protocol, const Words& more, const std::string& study) const {
    return runDisturbed({.killAtSync = sync}, protocol, more, study).code;
}

Words operator+(Words words, const Words& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

std::string planAndAnswers(const nlohmann::json& value) {
    auto trials = value["results"]["trials"];
    for (auto& trial : trials) trial.erase("attempt");
    return value["results"]["plan"].dump() + '\n' + trials.dump() + '\n' + value["results"]["confusion"].dump();
}

}  // namespace tacto::test
