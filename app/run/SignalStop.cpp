#include "app/run/SignalStop.h"

#include <csignal>
#include <ctime>

namespace tacto {

namespace {
sigset_t stopSignals() {
    sigset_t set;
    sigemptyset(&set);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) sigaddset(&set, signal);
    return set;
}

/// A program started from here, such as a viewer, must still end on these signals.
void unblockInChild() {
    const auto set = stopSignals();
    pthread_sigmask(SIG_UNBLOCK, &set, nullptr);
}
}  // namespace

SignalStop::SignalStop() {
    static const int once = pthread_atfork(nullptr, nullptr, unblockInChild);
    static_cast<void>(once);
    const auto set = stopSignals();
    pthread_sigmask(SIG_BLOCK, &set, nullptr);
    std::signal(SIGPIPE, SIG_IGN);  // a write then reports that the reader is gone
    thread_ = std::thread([this] { wait(); });
}

SignalStop::~SignalStop() {
    quitting_ = true;
    thread_.join();
}

void SignalStop::onStop(std::function<void()> stop) {
    const std::scoped_lock lock(mutex_);
    stop_ = std::move(stop);
}

void SignalStop::wait() {
    const auto set = stopSignals();
    while (!quitting_) {
        const std::timespec look{0, 50'000'000};
        if (sigtimedwait(&set, nullptr, &look) < 0) continue;
        signalled_ = true;
        const std::scoped_lock lock(mutex_);
        if (stop_) stop_();
    }
}

}  // namespace tacto
