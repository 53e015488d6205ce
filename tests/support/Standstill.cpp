// Linked into tests that depend on real time. The program rightly switches its output off after 50 or 100 ms without a
// sign of life; a computer that gives it no processor for so long causes this without a fault.
//
// One thread sleeps a few milliseconds at a time and sends a byte through a pseudo-terminal, which shows how long the
// computer stalled. A second thread, woken each time, shows how long a message between threads takes (a transfer of an
// emulated USB device takes ten of them). Linux tells how long each thread of the test and of its programs waited for a
// processor, and how much processor time the virtual machine lost, since another thread than the watch may have
// stalled. A test that fails on a computer without stalls has failed, and so has a test with any failure other than a
// deadline (support/InTime.h). A test that was only late on a stalled computer runs again, five times in all, each time
// after the computer was calm; after five failures it has failed. Each retry adds a line to the file TACTO_RETRIES,
// which ./dev prints and counts.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <dirent.h>
#include <fcntl.h>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <string_view>
#include <sys/eventfd.h>
#include <sys/ioctl.h>
#include <sys/syscall.h>
#include <termios.h>
#include <thread>
#include <unistd.h>
#include <vector>

#include "tests/support/InTime.h"

/// Defined by the patient clock if that is linked (PatientClock.cpp).
extern "C" [[gnu::weak]] void tactoBeat();
extern "C" [[gnu::weak]] void tactoRest();

namespace {

/// The real clock, whichever clock the test uses.
struct Clock {
    using duration = std::chrono::nanoseconds;
    using rep = duration::rep;
    using period = duration::period;
    using time_point = std::chrono::time_point<Clock>;
    static constexpr bool is_steady = true;
    static time_point now() noexcept {
        std::timespec at{};
        ::syscall(SYS_clock_gettime, CLOCK_MONOTONIC, &at);
        return time_point(std::chrono::seconds(at.tv_sec) + std::chrono::nanoseconds(at.tv_nsec));
    }
};
using Milliseconds = std::chrono::duration<double, std::milli>;

constexpr Milliseconds kStill{25};    // half of the shortest deadline, the 50 ms of a stimulator's status
constexpr Milliseconds kSlowWord{1};  // fifty times the usual; ten such round trips are half of 50 ms
constexpr int kTries = 5;
constexpr const char* kTry = "TACTO_TEST_TRY";

/// A pseudo-terminal. A byte written at one end waits for a kernel thread, which belongs to no process, before it can
/// be read at the other. Avoids the C library, as KernelFile does.
class KernelLine {
public:
    KernelLine()
        : master_(static_cast<int>(::syscall(SYS_openat, AT_FDCWD, "/dev/ptmx", O_RDWR | O_NOCTTY | O_CLOEXEC))) {
        int locked = 0;
        ::syscall(SYS_ioctl, master_, TIOCSPTLCK, &locked);
        slave_ = static_cast<int>(::syscall(SYS_ioctl, master_, TIOCGPTPEER, O_RDWR | O_NOCTTY | O_CLOEXEC));
        termios raw{};
        if (tcgetattr(slave_, &raw) != 0) return;
        cfmakeraw(&raw);
        works_ = tcsetattr(slave_, TCSANOW, &raw) == 0;
    }
    ~KernelLine() {
        ::syscall(SYS_close, slave_);
        ::syscall(SYS_close, master_);
    }
    KernelLine(const KernelLine&) = delete;
    KernelLine& operator=(const KernelLine&) = delete;

    /// Returns once a byte has passed through.
    void pass() const {
        char byte = 'x';
        if (works_ && ::syscall(SYS_write, slave_, &byte, 1) == 1) ::syscall(SYS_read, master_, &byte, 1);
    }

private:
    int master_, slave_ = -1;
    bool works_ = false;
};

/// Two threads that pass a message back and forth.
class Words {
public:
    Words() : echo_([this] { run(); }) {}
    ~Words() {
        ending_ = true;
        say(there_);
        echo_.join();
        ::close(there_);
        ::close(back_);
    }
    Words(const Words&) = delete;
    Words& operator=(const Words&) = delete;

    void pass() {
        const auto begun = Clock::now();
        say(there_);
        hear(back_);
        ++passed_;
        if (Clock::now() - begun > kSlowWord) ++slow_;
    }
    [[nodiscard]] bool slow() const noexcept { return slow_ >= 3 && 10 * slow_ >= passed_; }
    [[nodiscard]] int slowOnes() const noexcept { return slow_; }
    [[nodiscard]] int passed() const noexcept { return passed_; }

private:
    static void say(int to) {
        const std::uint64_t one = 1;
        [[maybe_unused]] const auto said = ::write(to, &one, sizeof one);
    }
    static void hear(int from) {
        std::uint64_t word = 0;
        [[maybe_unused]] const auto heard = ::read(from, &word, sizeof word);
    }
    void run() {
        for (;;) {
            hear(there_);
            if (ending_) return;
            say(back_);
        }
    }

    const int there_ = ::eventfd(0, EFD_CLOEXEC);
    const int back_ = ::eventfd(0, EFD_CLOEXEC);
    std::atomic<bool> ending_{false};
    int passed_ = 0;
    int slow_ = 0;
    std::thread echo_;  // declared last: starts when everything else is ready
};

// Reads without the C library. In some tests umockdev replaces the library's calls and holds a lock during each open.
// If the thread sanitizer found a race there, its report would wait for that lock forever.
class KernelFile {
public:
    explicit KernelFile(const std::string& path)
        : number_(static_cast<int>(::syscall(SYS_openat, AT_FDCWD, path.c_str(), O_RDONLY | O_CLOEXEC))) {}
    ~KernelFile() { ::syscall(SYS_close, number_); }
    KernelFile(const KernelFile&) = delete;
    KernelFile& operator=(const KernelFile&) = delete;

    [[nodiscard]] int number() const noexcept { return number_; }

private:
    const int number_;
};

/// Returns the first 4 KiB, or "" if the file is gone.
std::string contentOf(const std::string& path) {
    const KernelFile file(path);
    char text[4096];
    const auto size = ::syscall(SYS_read, file.number(), text, sizeof text);
    return {text, static_cast<std::size_t>(std::max(0L, size))};
}

/// Returns an empty list if the folder is gone.
std::vector<std::string> namesIn(const std::string& folder) {
    const KernelFile file(folder);
    std::vector<std::string> names;
    alignas(dirent64) char entries[4096];
    while (const auto size = std::max(0L, ::syscall(SYS_getdents64, file.number(), entries, sizeof entries))) {
        for (long at = 0; at < size;) {
            const auto* const entry = reinterpret_cast<const dirent64*>(entries + at);
            if (entry->d_name[0] != '.') names.emplace_back(entry->d_name);
            at += entry->d_reclen;
        }
    }
    return names;
}

/// Measures how long threads waited for a processor, as Linux counts it: the longest wait within about 100 ms.
class Waits {
public:
    void look() {
        isFirst_ = last_ == Clock::time_point{};
        if (!isFirst_ && Clock::now() - last_ < kBetween) return;
        last_ = Clock::now();
        take("stolen", stolen());
        for (const auto& process : processes()) {
            for (const auto& task : namesIn(process + "/task")) {
                const auto path = process + "/task/" + task + "/schedstat";
                double ran_ns = 0, waited_ns = 0;
                if (std::istringstream(contentOf(path)) >> ran_ns >> waited_ns)
                    take(path, Milliseconds(waited_ns / 1e6));
            }
        }
    }
    [[nodiscard]] Milliseconds longest() const noexcept { return longest_; }

private:
    static constexpr Milliseconds kBetween{50};
    struct Count {
        Milliseconds total, before;  ///< time lost up to the last look, and what the look before added
    };

    /// Returns the stolen time of all processors together.
    [[nodiscard]] static Milliseconds stolen() {
        std::string cpu;
        double user = 0, nice = 0, system = 0, idle = 0, waiting = 0, interrupts = 0, soft = 0, steal = 0;
        std::istringstream(contentOf("/proc/stat")) >> cpu >> user >> nice >> system >> idle >> waiting >> interrupts >>
            soft >> steal;
        return Milliseconds(1e3 * steal / static_cast<double>(::sysconf(_SC_CLK_TCK)));
    }
    /// Returns this process and the processes that it started.
    [[nodiscard]] static std::vector<std::string> processes() {
        std::vector<std::string> all{"/proc/self"};
        for (const auto& task : namesIn("/proc/self/task")) {
            std::istringstream children(contentOf("/proc/self/task/" + task + "/children"));
            for (std::string id; children >> id;) all.push_back("/proc/" + id);
        }
        return all;
    }
    void take(const std::string& whose, Milliseconds total) {
        const auto [at, isNew] = counts_.try_emplace(whose, Count{total, Milliseconds(0)});
        auto& [last, before] = at->second;
        // Waits before the first look are not the test's; a thread that appears later has waited only since it started.
        const auto added = !isNew ? total - last : isFirst_ ? Milliseconds(0) : total;
        longest_ = std::max(longest_, before + added);
        last = total;
        before = added;
    }

    Clock::time_point last_{};
    bool isFirst_ = true;  ///< true during the first look
    std::map<std::string, Count> counts_;
    Milliseconds longest_{0};
};

/// Notes whether anything failed that no stall excuses. Ends a test at an ASSERT_IN_TIME even within a function that
/// the test calls: otherwise a later failure caused by it would not count as a deadline.
class Failures : public testing::EmptyTestEventListener {
public:
    void OnTestPartResult(const testing::TestPartResult& part) override {
        if (!part.failed()) return;
        if (std::string_view(part.message()).find(tacto::test::kNotInTime) != 0) {
            broken_ = true;
        } else if (part.fatally_failed() && std::this_thread::get_id() == tests_) {
            throw testing::AssertionException(part);
        }
    }
    [[nodiscard]] bool broken() const noexcept { return broken_; }

private:
    const std::thread::id tests_ = std::this_thread::get_id();
    std::atomic<bool> broken_{false};  // atomic: a test's other threads may fail too
};

class StandstillWatch : public testing::Environment {
public:
    void SetUp() override {
        testing::UnitTest::GetInstance()->listeners().Append(owned_.release());
        if (tactoBeat != nullptr) tactoBeat();
        // Measures from now on, not from when the thread first runs, and until the end.
        thread_ = std::thread([this, last = Clock::now()]() mutable {
            const KernelLine line;
            Words words;
            Waits waits;
            const auto look = [&] {
                waits.look();
                const auto now = Clock::now();
                longest_ = std::max(longest_, Milliseconds(now - last));
                last = now;
            };
            while (!ending_) {
                nap();
                look();
                words.pass();
                line.pass();
                if (tactoBeat != nullptr) tactoBeat();
            }
            look();
            if (tactoRest != nullptr) tactoRest();
            waited_ = waits.longest();
            slowly_ = words.slow();
            said_ = std::to_string(words.slowOnes()) + " of " + std::to_string(words.passed());
        });
    }
    void TearDown() override {
        ending_ = true;
        thread_.join();
        const bool calm = longest_ < kStill && waited_ < kStill && !slowly_;
        if (!testing::UnitTest::GetInstance()->Failed() || calm) return;
        if (failures_->broken()) return;
        const char* set = std::getenv(kTry);
        const int number = set == nullptr ? 1 : std::atoi(set);
        std::printf(
            "The machine stood still for %.0f ms, kept a thread waiting for %.0f ms, and %s words between threads took "
            "over %.0f ms: try %d of %d.\n",
            longest_.count(), waited_.count(), said_.c_str(), kSlowWord.count(), number, kTries);
        std::fflush(nullptr);
        if (number == kTries) return;
        if (const char* list = std::getenv("TACTO_RETRIES")) {
            std::ofstream(list, std::ios::app)
                << testing::GTEST_FLAG(filter) << ": still for " << longest_.count() << " ms, a thread waited "
                << waited_.count() << " ms, " << said_ << " words slow\n";
        }
        waitForCalm();
        again(number + 1);
    }

private:
    static void nap() {
        const timespec time{0, 4'000'000};  // interval between two looks: short against kStill, and cheap
        ::syscall(SYS_nanosleep, &time, nullptr);
    }
    /// Waits for one second without a stall, but at most ten seconds.
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

    std::unique_ptr<Failures> owned_ = std::make_unique<Failures>();  // owned here until tests begin, then by gtest
    Failures* const failures_ = owned_.get();
    std::thread thread_;
    std::atomic<bool> ending_{false};
    // Used by the thread until it is joined:
    Milliseconds longest_{0};
    Milliseconds waited_{0};
    bool slowly_ = false;
    std::string said_;
};

// gtest owns this object.
[[maybe_unused]] const auto* const kWatch = testing::AddGlobalTestEnvironment(new StandstillWatch);

}  // namespace
