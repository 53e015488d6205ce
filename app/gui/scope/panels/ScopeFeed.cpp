#include "app/gui/scope/panels/ScopeFeed.h"

#include <utility>

namespace tacto::gui {

bool ScopeFeed::begin(const std::filesystem::path& session) {
    if (!acquisition_.possible() || std::exchange(session_, session) == session) return false;
    framed_ = false;
    model_.clearMarks();
    // A bench that has just been opened is looked at, not the file that was.
    if (model_.shown() && !model_.shown()->source.isEmpty()) {
        model_.clear();
        acquisition_.wantAgain();
    }
    return true;
}

ScopeFeed::Taken ScopeFeed::take(const ShownPtr& shown) {
    const bool ours = shown->source.isEmpty();
    if (ours && !acquisition_.take(*shown)) return Taken::Nothing;
    if (ours && staysBefore(*shown)) {
        model_.setHeld(true);
        return Taken::Held;
    }
    const bool anew = !ours || !model_.shown() || model_.shown()->source != shown->source;
    model_.show(shown);
    // At first the record is seen whole; then the first train in it is shown.
    if (ours && !shown->capture->untriggered && !std::exchange(framed_, true)) model_.frameFirstPulse();
    return anew ? Taken::ShownAnew : Taken::Shown;
}

/// The last train stays when the output is off: noise in its place would say nothing.
bool ScopeFeed::staysBefore(const ShownCapture& next) const {
    const auto& last = model_.shown();
    return next.capture->untriggered && !model_.roll() && !acquisition_.delivering() && last &&
           last->source.isEmpty() && !last->capture->untriggered;
}

}  // namespace tacto::gui
