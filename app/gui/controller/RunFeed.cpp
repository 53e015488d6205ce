#include "app/gui/controller/RunFeed.h"

#include <utility>

namespace tacto::gui {

void RunFeedCollector::listen(RunRequest& request) {
    constexpr std::size_t kMaxCaptures = 8;
    request.onProgress = [this](const ScriptProgress& progress) {
        const std::scoped_lock lock(mutex_);
        feed_.progress = progress;
    };
    request.onLog = [this](const std::string& text) {
        const std::scoped_lock lock(mutex_);
        feed_.log.push_back(text);
    };
    request.onTrial = [this](const nlohmann::json& trial) {
        const std::scoped_lock lock(mutex_);
        feed_.trials.push_back(trial);
    };
    request.onCapture = [this](const Capture& capture) {
        auto shared = std::make_shared<const Capture>(capture);
        const std::scoped_lock lock(mutex_);
        if (feed_.captures.size() == kMaxCaptures) feed_.captures.erase(feed_.captures.begin());
        feed_.captures.push_back(std::move(shared));
    };
}

RunFeed RunFeedCollector::take() {
    const std::scoped_lock lock(mutex_);
    return std::exchange(feed_, {});
}

}  // namespace tacto::gui
