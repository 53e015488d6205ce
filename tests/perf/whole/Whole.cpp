// Whole.cpp - measures time and memory of tactoscope-cli in normal use. Each time is compared with a baseline of the
// same run: a fixed calculation that takes a processor a third of a second.
//
//   perf_whole PATH-OF-tactoscope-cli
#include <algorithm>
#include <chrono>
#include <cmath>
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
    double megabytes = 0;  ///< peak resident memory
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

/// Times 2e8 multiplications, each using the last result: no parallel work and no memory access is possible.
double fixedSum_s() {
    double best = 1e9;
    for (int round = 0; round < 3; ++round) {
        const auto begun = std::chrono::steady_clock::now();
        double x = 1;
        for (int i = 0; i < 200'000'000; ++i) x = x * 1.0000001 + 1e-9;
        const volatile double kept = x;
        static_cast<void>(kept);
        best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count());
    }
    return best;
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
    const double sum_s = fixedSum_s();
    std::printf("%-44s %10.2f %10s  baseline\n", "a fixed sum", sum_s, "");
    const auto idle = runQuietly({cli, "--version"});
    std::printf("%-44s %10.2f %10.0f  start and end\n", "--version", idle.seconds, idle.megabytes);
    const auto judged = [&](const Ran& ran, double most) {
        return tacto::verdict(ran.exitCode == 0 ? ran.seconds / sum_s : std::nan(""), "the sum", most);
    };
    const auto separability =
        runQuietly({cli, "run", "separability", "--device", "sim:", "--out", out("separability")});
    std::printf("%-44s %10.2f %10.0f  report included: %s\n", "run separability, 25 repeats", separability.seconds,
                separability.megabytes, judged(separability, 30).c_str());
    Ran hours[2];
    const int lengths[] = {1, 10};
    for (int i = 0; i < 2; ++i) {
        const int seconds = lengths[i] * 3600;
        hours[i] = runQuietly({cli, "run", "live", "--device", "sim:", "--set", "duration=" + std::to_string(seconds),
                               "--out", out(i == 0 ? "live1" : "live10")});
        std::printf("run live, %2d simulated h %30.2f %10.0f  %.0f times real time; %s\n", lengths[i], hours[i].seconds,
                    hours[i].megabytes, seconds / hours[i].seconds, judged(hours[i], 55 * lengths[i]).c_str());
    }
    std::printf("memory of 10 h: %s\n",
                tacto::verdict(hours[1].megabytes / hours[0].megabytes, "that of 1 h", 1.05).c_str());
    std::error_code ignored;
    std::filesystem::remove_all(scratch, ignored);
    return 0;
}
