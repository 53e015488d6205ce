// ScopeFeed.h - which captures come to an oscilloscope's screen: the bench's, from the session that is open, or those
// of a file; and the bench's last train, which stays while the output is off.
//
// Thread-safety: the GUI thread.
#pragma once

#include <filesystem>

#include "app/gui/scope/model/ScopeModel.h"
#include "app/gui/scope/panels/ScopeAcquisition.h"

namespace tacto::gui {

class ScopeFeed {
public:
    enum class Taken {
        Nothing,   ///< it was not asked for any more
        Held,      ///< what is shown stays: in its place this would say nothing
        Shown,     ///< one more of its source
        ShownAnew  ///< the first of another source: what was counted is over
    };

    /// Both outlive it.
    ScopeFeed(ScopeModel& model, ScopeAcquisition& acquisition) : model_(model), acquisition_(acquisition) {}

    /// The bench's session is `session`; empty: none is open. Returns whether captures of another one come from now on:
    /// then marks, and a file that was looked at, are gone from the screen.
    [[nodiscard]] bool begin(const std::filesystem::path& session);
    /// The session of the bench that was open last.
    [[nodiscard]] const std::filesystem::path& session() const noexcept { return session_; }

    /// Shows it, unless it was not asked for or the last train stays. Its first train is framed.
    [[nodiscard]] Taken take(const ShownPtr& shown);

private:
    [[nodiscard]] bool staysBefore(const ShownCapture& next) const;

    ScopeModel& model_;
    ScopeAcquisition& acquisition_;
    std::filesystem::path session_;
    bool framed_ = false;  // the first train of it was
};

}  // namespace tacto::gui
