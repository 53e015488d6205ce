#include "tests/cli/PilotDesk.h"

#include <csignal>
#include <fcntl.h>
#include <nlohmann/json.hpp>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace tacto::test {

Words shortSession() { return {"--set", "participant=virtual:7", "--set", "blocks=1"}; }

Words PilotDesk::words(const std::string& protocol, const Words& more, const std::string& study) const {
    Words all{"run", protocol, "--out", desk_.at(study), "--json"};
    for (const auto& device : devices_) all.insert(all.end(), {"--device", device});
    all.insert(all.end(), more.begin(), more.end());
    return all;
}

Ran PilotDesk::run(const std::string& protocol, const Words& more, const std::string& study) const {
    return desk_.run(words(protocol, more, study));
}

int PilotDesk::execute(const Words& environment, Words all, unsigned long largestFile,
                       const std::string& errors) const {
    auto given = environment;
    all.insert(all.begin(), TACTO_CLI);
    std::vector<char*> arguments, variables;
    for (auto& each : all) arguments.push_back(each.data());
    for (auto& each : given) variables.push_back(each.data());
    arguments.push_back(nullptr);
    variables.push_back(nullptr);
    const pid_t child = fork();
    if (child == 0) {
        const int nowhere = open("/dev/null", O_RDWR | O_CLOEXEC);
        const int said = open(errors.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
        dup2(nowhere, 0);
        dup2(nowhere, 1);
        dup2(said, 2);
        if (largestFile > 0) {
            signal(SIGXFSZ, SIG_IGN);
            const rlimit most{largestFile, largestFile};
            setrlimit(RLIMIT_FSIZE, &most);
        }
        execve(TACTO_CLI, arguments.data(), variables.data());
        _exit(127);
    }
    int status = 0;
    EXPECT_EQ(waitpid(child, &status, 0), child);
    return WIFSIGNALED(status) ? -WTERMSIG(status) : WEXITSTATUS(status);
}

int PilotDesk::runKilled(long sync, const std::string& protocol, const Words& more, const std::string& study) const {
    auto environment = desk_.environment();
    environment.push_back(std::string("LD_PRELOAD=") + TACTO_KILL_AT_SYNC_LIBRARY);
    environment.push_back("TACTO_KILL_AT_SYNC=" + std::to_string(sync));
    return execute(environment, words(protocol, more, study), 0, "/dev/null");
}

int PilotDesk::runOnFullDisk(unsigned long bytes, std::string& said, const std::string& protocol, const Words& more,
                             const std::string& study) const {
    const auto errors = desk_.at("errors.txt");
    const int code = execute(desk_.environment(), words(protocol, more, study), bytes, errors);
    said = contentOf(errors);
    return code;
}

std::string planAndAnswers(const nlohmann::json& value) {
    auto trials = value["results"]["trials"];
    for (auto& trial : trials) trial.erase("attempt");
    return value["results"]["plan"].dump() + '\n' + trials.dump() + '\n' + value["results"]["confusion"].dump();
}

}  // namespace tacto::test
