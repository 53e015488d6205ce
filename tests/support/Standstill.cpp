// Linked into tests that wait by the clock. The program switches its output off when 50 or 100 ms pass without a sign
// of life, as it should; a virtual machine that is not given its processors for so long makes it do so without a fault.
//
// A thread that sleeps a millisecond at a time sees how long the machine stood still. A test that fails in a process
// that never did has failed. One that fails in a process that did is tried again from the start, three times in all;
// if the machine stood still in each of them, nothing was learnt, and CTest is told that the test was not run.
#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <string>
#include <thread>
#include <unistd.h>
#include <vector>

namespace {

using Clock = std::chrono::steady_clock;
using Milliseconds = std::chrono::duration<double, std::milli>;

constexpr Milliseconds kStill{25};  // half of the shortest that is waited for, the 50 ms of a stimulator's status
constexpr int kTries = 3;
constexpr int kNotRun = 77;  // SKIP_RETURN_CODE in tests/CMakeLists.txt
constexpr const char* kTry = "TACTO_TEST_TRY";

class StandstillWatch : public testing::Environment {
public:
    void SetUp() override {
        thread_ = std::thread([this] {
            auto last = Clock::now();
            while (!ending_) {
                std::this_thread::sleep_for(std::chrono::milliseconds(1));
                const auto now = Clock::now();
                longest_ = std::max(longest_, Milliseconds(now - last));
                last = now;
            }
        });
    }
    void TearDown() override {
        ending_ = true;
        thread_.join();
        if (!testing::UnitTest::GetInstance()->Failed() || longest_ < kStill) return;
        const char* told = std::getenv(kTry);
        const int number = told == nullptr ? 1 : std::atoi(told);
        std::printf("The machine stood still for %.0f ms: try %d of %d tells nothing.\n", longest_.count(), number,
                    kTries);
        std::fflush(nullptr);
        if (number < kTries) {
            waitForCalm();
            again(number + 1);
        }
        ::_exit(kNotRun);
    }

private:
    /// A second without a standstill, or ten in all.
    static void waitForCalm() {
        const auto begun = Clock::now();
        for (auto calm = begun, last = begun; last - calm < std::chrono::seconds(1);) {
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
            const auto now = Clock::now();
            if (now - last > kStill) calm = now;
            if (now - begun > std::chrono::seconds(10)) return;
            last = now;
        }
    }
    static void again(int number) {
        std::ifstream file("/proc/self/cmdline");
        const std::string all{std::istreambuf_iterator<char>(file), {}};
        std::vector<std::string> words;
        for (std::size_t at = 0; at < all.size(); at += words.back().size() + 1) words.emplace_back(all.c_str() + at);
        std::vector<char*> arguments;
        for (auto& word : words) arguments.push_back(word.data());
        arguments.push_back(nullptr);
        ::setenv(kTry, std::to_string(number).c_str(), 1);
        ::execv("/proc/self/exe", arguments.data());
    }

    std::thread thread_;
    std::atomic<bool> ending_{false};
    Milliseconds longest_{0};  // the thread's, until it is joined
};

// gtest owns it.
[[maybe_unused]] const auto* const kWatch = testing::AddGlobalTestEnvironment(new StandstillWatch);

}  // namespace
