// Preloaded into a program with an alarm() for which a test does not want to wait: a second passes in 20 ms.
#include <sys/time.h>

extern "C" unsigned alarm(unsigned seconds) {
    const itimerval once{{}, {seconds / 50, static_cast<suseconds_t>(seconds % 50) * 20'000}};
    return setitimer(ITIMER_REAL, &once, nullptr) == 0 ? 0 : 1;
}
