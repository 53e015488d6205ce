// RunFeed.h - messages of a running protocol, stored until the window reads them.
//
// Thread-safety: RunFeedCollector may be used by any thread.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "app/scripting/engine/ScriptRun.h"

namespace tacto::gui {

/// The messages since the window last read them.
struct RunFeed {
    std::optional<ScriptProgress> progress;
    std::vector<std::string> log;
    std::vector<nlohmann::json> trials;                    ///< as passed to record.trial(), with condition and trial
    std::vector<std::shared_ptr<const Capture>> captures;  ///< only the newest few
};

class RunFeedCollector {
public:
    /// Listens to the run started by `request`; must outlive that run.
    void listen(RunRequest& request);
    [[nodiscard]] RunFeed take();

private:
    std::mutex mutex_;
    RunFeed feed_;  // guarded by mutex_
};

}  // namespace tacto::gui
