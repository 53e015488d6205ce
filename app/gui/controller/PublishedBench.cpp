#include "app/gui/controller/PublishedBench.h"

#include <utility>

namespace tacto::gui {

Telemetry PublishedBench::telemetry() const {
    const std::scoped_lock lock(mutex_);
    return bench_ != nullptr ? bench_->telemetry() : Telemetry{};
}

std::optional<DeviceReport> PublishedBench::deviceReport(Role role) const {
    const std::scoped_lock lock(mutex_);
    return bench_ != nullptr ? bench_->deviceReport(role) : std::nullopt;
}

void PublishedBench::stop(const char* by) noexcept {
    const std::scoped_lock lock(mutex_);
    if (script_ == nullptr) unheardStop_ = by;
    if (script_ != nullptr && takesStop_ && takesStop_(by)) return;
    if (script_ != nullptr)
        script_->stop(by);
    else if (bench_ != nullptr)
        bench_->stop(by);
}

void PublishedBench::pause() {
    const std::scoped_lock lock(mutex_);
    if (script_ != nullptr)
        script_->pause();
    else if (bench_ != nullptr)
        bench_->pause();
}

void PublishedBench::resume() {
    const std::scoped_lock lock(mutex_);
    if (script_ != nullptr)
        script_->resume();
    else if (bench_ != nullptr)
        bench_->resume();
}

bool PublishedBench::paused() const {
    const std::scoped_lock lock(mutex_);
    if (script_ != nullptr) return script_->paused();
    return bench_ != nullptr && bench_->telemetry().paused;
}

bool PublishedBench::markMoment(Instant at, const std::string& word) {
    const std::scoped_lock lock(mutex_);
    return bench_ != nullptr && bench_->markMoment(at, word);
}

void PublishedBench::publish(Bench* bench) {
    const std::scoped_lock lock(mutex_);
    bench_ = bench;
    script_ = nullptr;
}

std::optional<std::string> PublishedBench::publish(Bench& bench, ScriptRun& script) {
    const std::scoped_lock lock(mutex_);
    bench_ = &bench;
    script_ = &script;
    return unheardStop_;
}

void PublishedBench::forgetStops() {
    const std::scoped_lock lock(mutex_);
    unheardStop_.reset();
}

void PublishedBench::setTakesStop(std::function<bool(const char*)> takes) {
    const std::scoped_lock lock(mutex_);
    takesStop_ = std::move(takes);
}

}  // namespace tacto::gui
