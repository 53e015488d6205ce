// RunFeed.h - what a running protocol says, kept for the window until it looks.
//
// Thread-safety: RunFeedCollector any thread.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "app/scripting/engine/ScriptRun.h"

namespace tacto::gui {

/// What came since the window last looked.
struct RunFeed {
    std::optional<ScriptProgress> progress;
    std::vector<std::string> log;
    std::vector<nlohmann::json> trials;  ///< as record.trial() was given them, with condition and trial
    std::vector<std::shared_ptr<const Capture>> captures;  ///< the newest few
};

class RunFeedCollector {
public:
    /// Listens to the run that `request` starts; outlives it.
    void listen(RunRequest& request);
    [[nodiscard]] RunFeed take();

private:
    std::mutex mutex_;
    RunFeed feed_;  // guarded by mutex_
};

}  // namespace tacto::gui
