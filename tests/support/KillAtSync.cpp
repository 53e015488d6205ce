// Preloaded into a program: ends it by SIGKILL at the n-th time that it makes something durable (fsync, fdatasync),
// where TACTO_KILL_AT_SYNC says n. Every committed row is made durable, so every n together are every event; a count
// that the program does not reach kills nothing.
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
