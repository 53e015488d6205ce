// Preloaded into a program: moves its wall clock ahead by TACTO_CLOCK_AHEAD seconds (negative: back), from the start
// or, if TACTO_CLOCK_FROM_SYNC is n, from its n-th call that makes data durable (fsync, fdatasync). Monotonic clocks
// are not changed.
#include <atomic>
#include <cstdlib>
#include <ctime>
#include <dlfcn.h>

namespace {

std::atomic<long> syncs{0};

long numberFrom(const char* name) {
    const char* const text = std::getenv(name);
    return text != nullptr ? std::atol(text) : 0;
}

int synced(const char* name, int file) {
    ++syncs;
    using Sync = int (*)(int);
    return reinterpret_cast<Sync>(dlsym(RTLD_NEXT, name))(file);
}

}  // namespace

extern "C" int clock_gettime(clockid_t clock, std::timespec* at) {
    using Get = int (*)(clockid_t, std::timespec*);
    static const auto get = reinterpret_cast<Get>(dlsym(RTLD_NEXT, "clock_gettime"));
    static const long ahead = numberFrom("TACTO_CLOCK_AHEAD"), from = numberFrom("TACTO_CLOCK_FROM_SYNC");
    const int failed = get(clock, at);
    if (failed == 0 && clock == CLOCK_REALTIME && syncs >= from) at->tv_sec += ahead;
    return failed;
}
extern "C" int fsync(int file) { return synced("fsync", file); }
extern "C" int fdatasync(int file) { return synced("fdatasync", file); }
