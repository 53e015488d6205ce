#include "app/scripting/engine/ScriptThread.h"

#include <atomic>
#include <condition_variable>
#include <mutex>

namespace tacto {

namespace {
std::atomic<int> abandonedCount{0};
using SteadyTime = std::chrono::steady_clock::time_point;
}  // namespace

struct ScriptThread::Shared {
    std::shared_ptr<HostPort> port;
    ProtocolSource source;
    std::function<void(Sandbox&)> body;

    std::mutex mutex;
    std::condition_variable changed;
    Sandbox* sandbox = nullptr;               // guarded; null before and after its life
    std::optional<SteadyTime> interruptedAt;  // guarded
    bool done = false;                        // guarded
    bool abandoned = false;                   // guarded

    void run() {
        {
            Sandbox engine(*port, source);
            {
                const std::lock_guard lock(mutex);
                sandbox = &engine;
                if (interruptedAt) engine.interrupt();
            }
            body(engine);
            const std::lock_guard lock(mutex);
            sandbox = nullptr;
        }
        body = nullptr;
        const std::lock_guard lock(mutex);
        done = true;
        if (abandoned) --abandonedCount;
        changed.notify_all();
    }
};

ScriptThread::ScriptThread(std::shared_ptr<HostPort> port, ProtocolSource source, std::function<void(Sandbox&)> body)
    : shared_(std::make_shared<Shared>()) {
    shared_->port = std::move(port);
    shared_->source = std::move(source);
    shared_->body = std::move(body);
    thread_ = std::thread([shared = shared_] { shared->run(); });
}

ScriptThread::~ScriptThread() {
    if (!thread_.joinable()) return;
    interrupt();
    (void)wait();
}

void ScriptThread::interrupt() noexcept {
    const std::lock_guard lock(shared_->mutex);
    if (!shared_->interruptedAt) shared_->interruptedAt = std::chrono::steady_clock::now();
    if (shared_->sandbox != nullptr) shared_->sandbox->interrupt();
    shared_->changed.notify_all();
}

ScriptThread::End ScriptThread::wait(std::optional<std::chrono::milliseconds> limit) {
    std::unique_lock lock(shared_->mutex);
    const auto until = std::chrono::steady_clock::now() + limit.value_or(std::chrono::milliseconds(0));
    while (!shared_->done) {
        std::optional<SteadyTime> deadline;
        if (limit) deadline = until;
        if (shared_->interruptedAt) {
            const auto giveUp = *shared_->interruptedAt + kGrace;
            deadline = deadline ? std::min(*deadline, giveUp) : giveUp;
        }
        if (!deadline) {
            shared_->changed.wait(lock);
            continue;
        }
        if (shared_->changed.wait_until(lock, *deadline) == std::cv_status::no_timeout || shared_->done) continue;
        if (!shared_->interruptedAt || std::chrono::steady_clock::now() < *shared_->interruptedAt + kGrace) {
            if (limit && std::chrono::steady_clock::now() >= until) return End::Running;
            continue;
        }
        shared_->abandoned = true;
        ++abandonedCount;
        lock.unlock();
        thread_.detach();
        return End::Abandoned;
    }
    lock.unlock();
    if (thread_.joinable()) thread_.join();
    return End::Done;
}

int ScriptThread::abandonedRunning() noexcept { return abandonedCount.load(); }

}  // namespace tacto
