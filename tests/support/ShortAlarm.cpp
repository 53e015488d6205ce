// Preloaded into a program that uses alarm(): shortens each second of the alarm to 20 ms, so that a test need not wait.
#include <sys/time.h>

extern "C" unsigned alarm(unsigned seconds) {
    const itimerval once{{}, {seconds / 50, static_cast<suseconds_t>(seconds % 50) * 20'000}};
    return setitimer(ITIMER_REAL, &once, nullptr) == 0 ? 0 : 1;
}
