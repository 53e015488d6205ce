// ScopeFrame.h - which part of time and levels is on the oscilloscope's screen: the whole record, one pulse, or the
// part that the user chose. The view follows new captures, and a zoom can be undone.
//
// Thread-safety: none; one owner, ScopeModel.
#pragma once

#include <deque>

#include "app/gui/scope/model/Remembered.h"
#include "app/gui/scope/model/ScopeLanes.h"

namespace tacto::gui {

class ScopeFrame {
public:
    /// All that can be shown; valid only during a call.
    struct Scene {
        const ShownPtr& shown;  ///< may be null
        const std::deque<ShownPtr>& older;
        const ScopeLanes& lanes;
        const QString& active;  ///< the lane whose pulse fills the screen
        bool roll = false;
    };

    [[nodiscard]] const Viewport& view() const noexcept { return view_; }
    /// In roll mode the screen ends with the newest capture. Returns the time at its left edge. Needs a capture.
    [[nodiscard]] static double rollLeft(const Scene& scene, double perDivision_s);

    /// Shows the first capture of its kind: fitted, or for the bench in the view that the user chose.
    void begin(const Scene& scene);
    /// Follows a capture that comes after `before`: a view of the whole record still shows the whole record after its
    /// length or pre-trigger changed; a view of a pulse still shows the pulse after its width or place changed.
    void follow(const Scene& scene, const ShownCapture& before);
    /// Gives each new lane a scale that shows all of its signal; the other lanes do not move.
    void addLanes(const Scene& scene);
    void changeMode(const Scene& scene);  ///< enters or leaves roll mode
    void forgetHistory() { history_ = {}; }

    /// Shows the pulse nearest to the trigger in the middle third, with every lane as large as possible. A second call
    /// shows the whole record, as does a call without a measured pulse. Needs a capture.
    void fit(const Scene& scene);
    /// Frames the first pulse in time only, if the whole record is shown. Returns true if it did.
    bool frameFirstPulse(const Scene& scene);

    /// Changes the view and keeps the old one for undo() under `kind`. Returns true if the view changed.
    bool go(const Scene& scene, const Viewport& next, const QString& kind);
    /// Changes the view without an entry for undo().
    void become(const Scene& scene, const Viewport& next);
    void remember() { history_.remember(view_, {}); }
    bool undo(const Scene& scene);
    [[nodiscard]] bool canUndo() const noexcept { return !history_.empty(); }

    /// Sets the view for the bench's first capture, which is then not fitted.
    void setChosen(ChosenView chosen) { chosen_ = std::move(chosen); }
    [[nodiscard]] ChosenView chosen(const Scene& scene) const;
    /// Keeps the view of the bench's captures while another source is shown.
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
    /// The part of the time axis that the next captures show.
    enum class TimeView { Whole, Pulse, Chosen };
    TimeView timeView_ = TimeView::Whole;
    bool untouched_ = true;  ///< the user has not changed the fitted scales: they grow with the signal
};

}  // namespace tacto::gui
