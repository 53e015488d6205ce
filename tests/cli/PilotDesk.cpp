#include "tests/cli/PilotDesk.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace tacto::test {

Words shortSession() {
    return {"--set", "participant=virtual:7", "--set", "blocks=1",     "--set", "detection=1",
            "--set", "attention=1.6",         "--set", "discomfort=3", "--set", "intolerance=5"};
}

Words PilotDesk::words(const std::string& protocol, const Words& more, const std::string& study) const {
    Words all{"run", protocol, "--device", "sim:", "--out", desk_.at(study), "--json"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
}

Ran PilotDesk::run(const std::string& protocol, const Words& more, const std::string& study) const {
    return desk_.run(words(protocol, more, study));
}

int PilotDesk::runKilled(long sync, const std::string& protocol, const Words& more, const std::string& study) const {
    auto environment = desk_.environment();
    environment.push_back(std::string("LD_PRELOAD=") + TACTO_KILL_AT_SYNC_LIBRARY);
    environment.push_back("TACTO_KILL_AT_SYNC=" + std::to_string(sync));
    auto all = words(protocol, more, study);
    all.insert(all.begin(), TACTO_CLI);
    std::vector<char*> arguments, variables;
    for (auto& each : all) arguments.push_back(each.data());
    for (auto& each : environment) variables.push_back(each.data());
    arguments.push_back(nullptr);
    variables.push_back(nullptr);
    const pid_t child = fork();
    if (child == 0) {
        const int nowhere = open("/dev/null", O_RDWR | O_CLOEXEC);
        for (const int stream : {0, 1, 2}) dup2(nowhere, stream);
        execve(TACTO_CLI, arguments.data(), variables.data());
        _exit(127);
    }
    int status = 0;
    EXPECT_EQ(waitpid(child, &status, 0), child);
    return WIFSIGNALED(status) ? -WTERMSIG(status) : WEXITSTATUS(status);
}

std::string planAndAnswers(const nlohmann::json& value) {
    auto trials = value["results"]["trials"];
    for (auto& trial : trials) trial.erase("attempt");
    return value["results"]["plan"].dump() + '\n' + trials.dump() + '\n' + value["results"]["confusion"].dump();
}

}  // namespace tacto::test
