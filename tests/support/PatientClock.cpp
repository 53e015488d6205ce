// A clock that waits if the computer is slow, for tests of programs that use an emulated device. Linked into the test,
// which preloads it into the programs that it starts, so that all of them read the same time.
//
// The thread that watches for stalls (Standstill.cpp) beats every few milliseconds, each time after a message to
// another thread and a byte through a pseudo-terminal have come back. Between two beats this clock advances by at most
// kMaxBetween, slowed down by the load: with eight threads ready on two processors it runs a quarter as fast. If the
// computer stalls, passes nothing on or is busy with other work, the deadlines of both ends wait too: an answer is late
// only if the program or the device is slow. CLOCK_MONOTONIC and CLOCK_BOOTTIME show this time; sleeping and waiting by
// poll, ppoll or a C++ condition variable follow it. Wall-clock time is not changed.
#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <dlfcn.h>
#include <fcntl.h>
#include <new>
#include <poll.h>
#include <pthread.h>
#include <string>
#include <sys/mman.h>
#include <sys/timerfd.h>
#include <unistd.h>

namespace {

using Nanoseconds = std::int64_t;

constexpr Nanoseconds kMaxBetween = 8'000'000;     // twice the usual time between two beats
constexpr Nanoseconds kAbandoned = 5'000'000'000;  // after so long without a beat, the beating process has ended
constexpr Nanoseconds kLook = 1'000'000;
constexpr double kSlowest = 0.125;  // lower limit, so that a test of 10 s ends
constexpr const char* kPageName = "TACTO_PATIENT_CLOCK";

/// The data that all processes share. Only the test's own watch thread writes them.
struct Page {
    std::atomic<std::uint32_t> turn;  ///< odd while the other members are being written
    std::atomic<Nanoseconds> beat;    ///< time of the last beat on the real clock
    std::atomic<Nanoseconds> own;     ///< this clock's time at that beat
    std::atomic<double> rate;         ///< this clock's speed relative to the real clock; 0: no beats, same speed
};
std::atomic<Page*> page{nullptr};
bool isOwner = false;

template <class Function>
Function* next(const char* name) {
    return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

Nanoseconds countOf(const std::timespec& at) { return Nanoseconds{1'000'000'000} * at.tv_sec + at.tv_nsec; }
std::timespec textOf(Nanoseconds count) {
    return {static_cast<std::time_t>(count / 1'000'000'000), static_cast<long>(count % 1'000'000'000)};
}

int readMachine(clockid_t clock, std::timespec* at) {
    static auto* const get = next<int(clockid_t, std::timespec*)>("clock_gettime");
    return get(clock, at);
}
Nanoseconds machineNow() {
    std::timespec at{};
    readMachine(CLOCK_MONOTONIC, &at);
    return countOf(at);
}

struct Now {
    Nanoseconds own = 0, machine = 0;
    double rate = 1;
    bool isHeld = false;

    /// Returns how much real time to wait before checking again whether `end` has come on this clock. This clock never
    /// runs faster than the real clock and its rate may soon change: waiting for the whole time could be much too long.
    [[nodiscard]] Nanoseconds until(Nanoseconds end) const {
        const Nanoseconds left = end - own;
        if (left <= 0) return 0;
        return std::max(left, isHeld ? kLook : kLook / 20);
    }
};
Now reckon(Nanoseconds machine, Nanoseconds beat, Nanoseconds own, double rate) {
    const auto passed = std::max<Nanoseconds>(0, machine - beat);  // the beat may have come after the reading
    if (rate == 0) return {own + passed, machine};
    const auto counted = static_cast<Nanoseconds>(rate * static_cast<double>(std::min(passed, kMaxBetween)));
    return {own + counted + std::max<Nanoseconds>(0, passed - kAbandoned), machine, rate, passed > kMaxBetween};
}
Now now() {
    const Nanoseconds machine = machineNow();
    const Page* const shared = page;
    if (shared == nullptr) return {machine, machine};
    for (;;) {
        const auto turn = shared->turn.load();
        const Nanoseconds beat = shared->beat, own = shared->own;
        const double rate = shared->rate;
        if (turn % 2 == 0 && shared->turn.load() == turn) return reckon(machine, beat, own, rate);
    }
}

/// Changes the rate from this moment on. Nobody reads between this moment and the new rate: a reading by the old rate
/// could be later than the next one.
void write(double rate) {
    Page& shared = *page;
    ++shared.turn;
    const auto at = reckon(machineNow(), shared.beat, shared.own, shared.rate);
    shared.beat = at.machine;
    shared.own = at.own;
    shared.rate = rate;
    ++shared.turn;
}

/// Returns the share of a processor that a thread that is ready to run gets.
double shareOfProcessor() {
    static const int file = open("/proc/loadavg", O_RDONLY | O_CLOEXEC);
    char text[64]{};
    double load = 0;
    int running = 0;
    if (pread(file, text, sizeof text - 1, 0) <= 0 ||
        std::sscanf(text, "%lf %lf %lf %d/", &load, &load, &load, &running) != 4)
        return 1;
    return std::clamp(static_cast<double>(sysconf(_SC_NPROCESSORS_ONLN)) / std::max(1, running), kSlowest, 1.0);
}

/// Opens the page shared by the test that started this program; without one, this is the test and makes the page.
[[gnu::constructor]] void begin() {
    const char* const given = std::getenv(kPageName);
    const auto mine = "/proc/" + std::to_string(getpid()) + "/fd/";  // a test that runs again made the page before
    const bool isGiven = given != nullptr && std::string(given).rfind(mine, 0) != 0;
    const int file = isGiven ? open(given, O_RDONLY | O_CLOEXEC) : memfd_create("clock", MFD_CLOEXEC);
    if (file < 0 || (!isGiven && ftruncate(file, sizeof(Page)) != 0)) return;
    void* const shared = mmap(nullptr, sizeof(Page), isGiven ? PROT_READ : PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    if (shared == MAP_FAILED) return;
    if (isGiven) {
        page = static_cast<Page*>(shared);
        close(file);
        return;
    }
    isOwner = true;
    const auto begun = machineNow();
    new (shared) Page{{0}, {begun}, {begun}, {0}};
    page = static_cast<Page*>(shared);
    setenv(kPageName, (mine + std::to_string(file)).c_str(), 1);
    Dl_info self{};
    if (dladdr(reinterpret_cast<const void*>(&now), &self) == 0) return;
    const char* const others = std::getenv("LD_PRELOAD");
    const std::string all = others == nullptr ? "" : others;
    if (all.find(self.dli_fname) == std::string::npos)
        setenv("LD_PRELOAD", (all.empty() ? self.dli_fname : all + ':' + self.dli_fname).c_str(), 1);
}

}  // namespace

/// The test's watch thread calls this every few milliseconds, unless the computer stalls.
extern "C" void tactoBeat() {
    if (isOwner) write(shareOfProcessor());
}
/// From here on this clock runs like the real clock.
extern "C" void tactoRest() {
    if (isOwner) write(0);
}

extern "C" int clock_gettime(clockid_t clock, std::timespec* at) {
    if (clock != CLOCK_MONOTONIC && clock != CLOCK_BOOTTIME) return readMachine(clock, at);
    const auto present = now();
    if (clock == CLOCK_MONOTONIC) {
        *at = textOf(present.own);
        return 0;
    }
    const int failed = readMachine(clock, at);
    *at = textOf(countOf(*at) - (present.machine - present.own));
    return failed;
}

extern "C" int ppoll(pollfd* files, nfds_t count, const std::timespec* timeout, const sigset_t* mask) {
    static auto* const wait = next<int(pollfd*, nfds_t, const std::timespec*, const sigset_t*)>("ppoll");
    if (timeout == nullptr) return wait(files, count, nullptr, mask);
    const auto end = now().own + countOf(*timeout);
    for (;;) {
        const auto left = textOf(now().until(end));
        const int found = wait(files, count, &left, mask);
        if (found != 0 || now().own >= end) return found;
    }
}
extern "C" int poll(pollfd* files, nfds_t count, int timeout_ms) {
    const auto timeout = textOf(Nanoseconds{1'000'000} * timeout_ms);
    return ppoll(files, count, timeout_ms < 0 ? nullptr : &timeout, nullptr);
}

extern "C" int clock_nanosleep(clockid_t clock, int flags, const std::timespec* time, std::timespec* left) {
    static auto* const sleep = next<int(clockid_t, int, const std::timespec*, std::timespec*)>("clock_nanosleep");
    if (clock != CLOCK_MONOTONIC) return sleep(clock, flags, time, left);
    const auto end = countOf(*time) + (flags == TIMER_ABSTIME ? 0 : now().own);
    for (;;) {
        const auto present = now();
        if (present.own >= end) return 0;
        const auto rest = textOf(present.until(end));
        const int ended = sleep(clock, 0, &rest, nullptr);
        if (ended != 0 && left != nullptr) *left = textOf(std::max<Nanoseconds>(0, end - now().own));
        if (ended != 0) return ended;
    }
}
extern "C" int nanosleep(const std::timespec* time, std::timespec* left) {
    const int ended = clock_nanosleep(CLOCK_MONOTONIC, 0, time, left);
    if (ended != 0) errno = ended;
    return ended == 0 ? 0 : -1;
}

/// Sets a timer on this clock; for libusb, which reads the time again when the timer expires.
extern "C" int timerfd_settime(int timer, int flags, const itimerspec* time, itimerspec* before) {
    static auto* const set = next<int(int, int, const itimerspec*, itimerspec*)>("timerfd_settime");
    const bool isOff = time->it_value.tv_sec == 0 && time->it_value.tv_nsec == 0;
    if ((flags & TFD_TIMER_ABSTIME) == 0 || isOff) return set(timer, flags, time, before);
    const auto present = now();
    auto machines = *time;
    machines.it_value = textOf(present.machine + present.until(countOf(time->it_value)));
    return set(timer, flags, &machines, before);
}

/// A thread that has waited its share of real time wakes and checks again, as after any spurious wake-up.
extern "C" int pthread_cond_clockwait(pthread_cond_t* condition, pthread_mutex_t* mutex, clockid_t clock,
                                      const std::timespec* until) {
    static auto* const wait =
        next<int(pthread_cond_t*, pthread_mutex_t*, clockid_t, const std::timespec*)>("pthread_cond_clockwait");
    if (clock != CLOCK_MONOTONIC) return wait(condition, mutex, clock, until);
    const auto present = now();
    const auto end = textOf(present.machine + present.until(countOf(*until)));
    const int ended = wait(condition, mutex, clock, &end);
    return ended == ETIMEDOUT && now().own < countOf(*until) ? 0 : ended;
}
