#include "drivers/sigrok/transport/SigrokThread.h"

#include <condition_variable>
#include <csignal>
#include <deque>
#include <glib.h>
#include <mutex>
#include <optional>
#include <thread>

namespace tacto::sigrok_driver {

struct SigrokThread::State {
    std::mutex mutex;
    std::condition_variable changed;
    std::deque<Job> jobs;   // guarded by mutex
    bool busy = false;      // guarded by mutex
    bool quitting = false;  // guarded by mutex
    bool ended = false;     // guarded by mutex

    void loop() {
        // Blocks SIGPIPE, because libsigrok may write to an instrument that has hung up.
        sigset_t broken;
        sigemptyset(&broken);
        sigaddset(&broken, SIGPIPE);
        ::pthread_sigmask(SIG_BLOCK, &broken, nullptr);
        // Without a context of its own, a session would use the process's main context, which the window uses.
        GMainContext* const own = g_main_context_new();
        g_main_context_push_thread_default(own);
        std::unique_lock lock(mutex);
        for (;;) {
            changed.wait(lock, [&] { return quitting || !jobs.empty(); });
            if (jobs.empty()) break;
            {
                const Job job = std::move(jobs.front());
                jobs.pop_front();
                busy = true;
                lock.unlock();
                job();
            }
            lock.lock();
            busy = false;
            changed.notify_all();
        }
        lock.unlock();
        g_main_context_pop_thread_default(own);
        g_main_context_unref(own);
        lock.lock();
        ended = true;
        changed.notify_all();
    }
};

SigrokThread::SigrokThread() : state_(std::make_shared<State>()) {
    std::thread([state = state_] { state->loop(); }).detach();
}

SigrokThread::~SigrokThread() {
    std::unique_lock lock(state_->mutex);
    state_->quitting = true;
    state_->changed.notify_all();
    state_->changed.wait_for(lock, std::chrono::milliseconds(800), [&] { return state_->ended; });
}

void SigrokThread::post(Job job) {
    const std::scoped_lock lock(state_->mutex);
    state_->jobs.push_back(std::move(job));
    state_->changed.notify_all();
}

Result<void> SigrokThread::run(std::function<Result<void>()> job, Seconds timeout, std::string_view what) {
    struct Reply {
        std::mutex mutex;
        std::condition_variable came;
        std::optional<Result<void>> result;
    };
    const auto reply = std::make_shared<Reply>();
    post([reply, work = std::move(job)] {
        auto result = work();
        const std::scoped_lock lock(reply->mutex);
        reply->result = std::move(result);
        reply->came.notify_all();
    });
    std::unique_lock lock(reply->mutex);
    if (!reply->came.wait_for(lock, timeout, [&] { return reply->result.has_value(); })) {
        return fail(ErrorCode::Timeout, "{} has taken more than {:.3g} s", what, timeout.count());
    }
    return *reply->result;
}

bool SigrokThread::idle(Seconds timeout) const {
    std::unique_lock lock(state_->mutex);
    return state_->changed.wait_for(lock, timeout, [&] { return !state_->busy && state_->jobs.empty(); });
}

}  // namespace tacto::sigrok_driver
