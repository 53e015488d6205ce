// ScopeFrame.h - which part of time and levels the oscilloscope's screen shows, and why: the whole record, a pulse, or
// what the user chose. It follows the captures accordingly and knows the way back from a zoom.
//
// Thread-safety: none; one owner, ScopeModel.
#pragma once

#include <deque>

#include "app/gui/scope/model/Remembered.h"
#include "app/gui/scope/model/ScopeLanes.h"

namespace tacto::gui {

class ScopeFrame {
public:
    /// Everything that can be shown; for the length of a call.
    struct Scene {
        const ShownPtr& shown;  ///< may be null
        const std::deque<ShownPtr>& older;
        const ScopeLanes& lanes;
        const QString& active;  ///< the lane whose pulse is framed
        bool roll = false;
    };

    [[nodiscard]] const Viewport& view() const noexcept { return view_; }
    /// In roll mode the newest capture ends the screen; this is where the screen begins then. There must be a capture.
    [[nodiscard]] static double rollLeft(const Scene& scene, double perDivision_s);

    /// The first capture of its kind: fitted, then shown as it was chosen for the bench.
    void begin(const Scene& scene);
    /// One more capture after `before`: a view of the whole record keeps showing the whole record when its length or
    /// pre-trigger changes, a view of a pulse keeps showing the pulse when its width or place changes.
    void follow(const Scene& scene, const ShownCapture& before);
    /// A new lane begins with a scale of its own that shows it; what is there keeps its place.
    void addLanes(const Scene& scene);
    void changeMode(const Scene& scene);  ///< changes to roll mode, or back
    void forgetHistory() { history_ = {}; }

    /// The pulse nearest to the trigger in the middle third, every lane as large as it can be; asked again, the whole
    /// record. Without a measured pulse always the whole. There must be a capture.
    void fit(const Scene& scene);
    /// Time alone, if it is the whole record that is shown. Returns whether it did.
    bool frameFirstPulse(const Scene& scene);

    /// Becomes the view, after remembering the present one under `kind`. Returns whether it is another.
    bool go(const Scene& scene, const Viewport& next, const QString& kind);
    /// Changes the view without remembering it.
    void become(const Scene& scene, const Viewport& next);
    void remember() { history_.remember(view_, {}); }
    bool undo(const Scene& scene);
    [[nodiscard]] bool canUndo() const noexcept { return !history_.empty(); }

    /// The view for the bench's first capture, instead of a fitted one.
    void setChosen(ChosenView chosen) { chosen_ = std::move(chosen); }
    [[nodiscard]] ChosenView chosen(const Scene& scene) const;
    /// Another source comes: the bench's view is kept until it is back.
    void keepChosen(const Scene& scene) { chosen_ = chosen(scene); }

private:
    void fitTime(const Scene& scene, Viewport& view) const;
    void framePulse(const Scene& scene, Viewport& view) const;
    void followTime(const Scene& scene, const ShownCapture& before);
    void growAndRoll(const Scene& scene);
    void takeChosen(const Scene& scene);
    [[nodiscard]] bool showsWhole(const ShownCapture& shown) const;

    Viewport view_;
    ChosenView chosen_;
    ViewHistory history_;
    /// The part of time that the next captures show.
    enum class TimeView { Whole, Pulse, Chosen };
    TimeView timeView_ = TimeView::Whole;
    bool untouched_ = true;  ///< the scales are a fit and were not changed: they grow with the signal
};

}  // namespace tacto::gui
