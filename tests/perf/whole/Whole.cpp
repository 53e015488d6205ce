// Whole.cpp - times tactoscope-cli as its users run it, with the memory it takes. Each figure stands beside its
// baseline or its target, measured in the same run.
//
//   perf_whole PATH-OF-tactoscope-cli
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <spawn.h>
#include <string>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

#include "tests/perf/Verdict.h"

extern char** environ;

namespace {

struct Ran {
    double seconds = 0;
    double megabytes = 0;  ///< largest resident set
    int exitCode = -1;
};

Ran runQuietly(const std::vector<std::string>& words) {
    std::vector<char*> arguments;
    for (const auto& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    const auto begun = std::chrono::steady_clock::now();
    pid_t child = 0;
    Ran ran;
    if (posix_spawn(&child, arguments[0], &actions, nullptr, arguments.data(), environ) != 0) return ran;
    int status = 0;
    rusage used{};
    wait4(child, &status, 0, &used);
    ran.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
    ran.megabytes = static_cast<double>(used.ru_maxrss) / 1024;
    ran.exitCode = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    posix_spawn_file_actions_destroy(&actions);
    return ran;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fprintf(stderr, "usage: perf_whole PATH-OF-tactoscope-cli\n");
        return 2;
    }
    const std::string cli = argv[1];
    const auto scratch = std::filesystem::temp_directory_path() / ("tactoscope-perf-" + std::to_string(getpid()));
    const auto out = [&](const char* name) { return (scratch / name).string(); };

    std::printf("%-44s %10s %10s  %s\n", "whole program", "seconds", "MB", "");
    const auto idle = runQuietly({cli, "--version"});
    std::printf("%-44s %10.2f %10.0f  baseline: start and end\n", "--version", idle.seconds, idle.megabytes);
    const auto separability =
        runQuietly({cli, "run", "separability", "--device", "sim:", "--out", out("separability")});
    std::printf("%-44s %10.2f %10.0f  wanted: under 10 s, report included: %s\n", "run separability, 25 repeats",
                separability.seconds, separability.megabytes,
                tacto::verdict(separability.seconds < 10 && separability.exitCode == 0));
    Ran hours[2];
    const int lengths[] = {1, 10};
    for (int i = 0; i < 2; ++i) {
        const int seconds = lengths[i] * 3600;
        hours[i] = runQuietly({cli, "run", "live", "--device", "sim:", "--set", "duration=" + std::to_string(seconds),
                               "--out", out(i == 0 ? "live1" : "live10")});
        const double speed = seconds / hours[i].seconds;
        std::printf("run live, %2d simulated h %30.2f %10.0f  %.0f times real time; wanted: 200: %s\n", lengths[i],
                    hours[i].seconds, hours[i].megabytes, speed,
                    tacto::verdict(speed >= 200 && hours[i].exitCode == 0));
    }
    const double more = hours[1].megabytes / hours[0].megabytes - 1;
    std::printf("memory from 1 to 10 h: %+.1f %%; wanted: within 5 %%: %s\n", 100 * more, tacto::verdict(more <= 0.05));
    std::error_code ignored;
    std::filesystem::remove_all(scratch, ignored);
    return 0;
}
