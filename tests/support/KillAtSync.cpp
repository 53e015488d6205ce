// Preloaded into a program: kills it with SIGKILL at its n-th call that makes data durable (fsync, fdatasync), where n
// is TACTO_KILL_AT_SYNC. Every committed row makes such a call, so that running with every n covers every event. If the
// program makes fewer calls, nothing is killed.
#include <atomic>
#include <csignal>
#include <cstdlib>
#include <dlfcn.h>
#include <unistd.h>

namespace {

void countOne() {
    static const char* const text = std::getenv("TACTO_KILL_AT_SYNC");
    static const long wanted = text != nullptr ? std::atol(text) : 0;
    static std::atomic<long> count{0};
    if (wanted > 0 && ++count == wanted) kill(getpid(), SIGKILL);
}

int real(const char* name, int file) {
    using Sync = int (*)(int);
    return reinterpret_cast<Sync>(dlsym(RTLD_NEXT, name))(file);
}

}  // namespace

extern "C" int fsync(int file) {
    countOne();
    return real("fsync", file);
}
extern "C" int fdatasync(int file) {
    countOne();
    return real("fdatasync", file);
}
