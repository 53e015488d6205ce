// ScopeModel.h - the contents of the oscilloscope's screen, without a widget: captures and lanes, the visible part and
// its undo steps, cursors, and the trigger. ScopeScreen draws the model, ScopeGestures changes it.
//
// Times are seconds on the screen's axis, on which the trigger is 0; in roll mode they are the session's times. Heights
// are divisions above the middle.
#pragma once

#include <QObject>
#include <memory>

#include "app/gui/controller/FirstOutput.h"
#include "app/gui/scope/model/ScopeCursors.h"
#include "app/gui/scope/model/ScopeFrame.h"
#include "app/gui/scope/model/ScopeLanes.h"
#include "app/gui/scope/model/ShownCaptures.h"
#include "app/gui/scope/model/Trace.h"

namespace tacto::gui {

class ScopeModel final : public QObject {
    Q_OBJECT
public:
    static constexpr int kMaxBehind = ShownCaptures::kMaxBehind;
    using QObject::QObject;

    /// Returns a copy of the present contents, which does not change later.
    [[nodiscard]] std::unique_ptr<ScopeModel> still() const;

    /// Shows the newest capture. Fits the view for the first capture and for one with other channels.
    void show(ShownPtr shown);
    /// Shows nothing, as before the first capture; keeps the references.
    void clear();
    /// Replaces the newest capture by the same capture with other calculations.
    void replaceMath(ShownPtr shown);
    [[nodiscard]] const ShownPtr& shown() const noexcept { return captures_.newest(); }
    /// Sets how many older captures stay on the screen, faded.
    void setPersistence(int captures);
    /// Roll mode: shows captures one after the other on the session's time.
    void setRoll(bool roll);
    [[nodiscard]] bool roll() const noexcept { return captures_.roll(); }
    /// True if the output is off and its last train is shown, faintly, until the next capture.
    [[nodiscard]] bool held() const { return held_ || coming(); }
    void setHeld(bool held);
    /// Sets the first train that an armed output will give; nothing if that train is unknown.
    void setComing(const std::optional<ComingTrain>& coming);
    /// The coming train, drawn over the bench's last train on the time from the trigger; nothing if it is hidden.
    [[nodiscard]] std::optional<ComingTrain> coming() const;
    /// The session time at which the screen's axis is 0.
    [[nodiscard]] double zero_s() const noexcept { return roll() || !shown() ? 0 : shown()->zero_s; }

    [[nodiscard]] const std::vector<ScopeLane>& lanes() const noexcept { return lanes_.all(); }
    /// Returns null if there is no such lane; other functions with a key then return nothing or do nothing.
    [[nodiscard]] const ScopeLane* lane(const QString& key) const { return lanes_.find(key); }
    /// The key of the first channel in this unit; empty if there is none.
    [[nodiscard]] QString channelIn(const QString& unit) const;
    [[nodiscard]] LaneScale scaleOf(const ScopeLane& lane) const { return viewport().scale(lane.scaleKey()); }
    [[nodiscard]] TracePtr trace(const QString& lane) const;
    [[nodiscard]] const QString& activeLane() const noexcept { return active_; }
    void setActiveLane(const QString& lane);
    /// Activates the lane whose trace is nearest, within `reach` divisions.
    void pickLane(double from_s, double to_s, double height, double reach);
    void setLaneShown(const QString& lane, bool shown);
    void setLaneScale(const QString& lane, double perDivision);
    void setLanePosition(const QString& lane, double position);
    /// Stores the active lane as a reference. Returns the reference's key; empty if there is nothing to store.
    QString storeReference();
    void removeReference(const QString& key);

    [[nodiscard]] const Viewport& viewport() const noexcept { return frame_.view(); }
    /// The time that does not move when the time base changes: the trigger if it is in view, else the middle.
    [[nodiscard]] double restingTime_s() const;
    void setTimePerDivision(double perDivision_s);
    /// The smallest useful time base: below it the samples show no shape.
    [[nodiscard]] double leastTimePerDivision_s() const;
    void setTimeCentre(double centre_s);
    void fit();              ///< see ScopeFrame::fit()
    void frameFirstPulse();  ///< see ScopeFrame::frameFirstPulse()
    /// Zooms out if `steps` is above 0. Steps with the same `kind` in quick succession are undone together.
    void zoomTime(int steps, double anchor_s, const QString& kind);
    void zoomLevel(int steps, double anchorHeight, const QString& kind);
    void zoomToBox(double from_s, double to_s, double bottom, double top);
    void pan(double time_s, double height, const QString& kind);
    /// Moves the view during a drag that began with the view `from`.
    void dragView(const Viewport& from, double time_s, double height);
    void dragLane(const Viewport& from, const QString& lane, double height);
    /// Adds the present view to the undo steps.
    void remember() { frame_.remember(); }
    bool undoZoom();
    [[nodiscard]] bool canUndo() const noexcept { return frame_.canUndo(); }
    void setChosenView(ChosenView chosen) { frame_.setChosen(std::move(chosen)); }
    [[nodiscard]] ChosenView chosenView() const { return frame_.chosen(scene()); }

    [[nodiscard]] const ScopeCursors& cursors() const noexcept { return cursors_; }
    void setTimeCursors(bool on);
    void setLevelCursors(bool on);
    void focusCursor(int cursor);
    /// Drags a cursor to a time or height. An edge or resting level nearer than `reach` attracts the cursor.
    void dragTimeCursor(int which, double time_s, double reach_s);
    void dragLevelCursor(int which, double height, double reach);
    /// Moves the focused cursor if it is a time (or level) cursor. Returns true if it is.
    bool nudgeTimeCursor(double by_s);
    bool nudgeLevelCursor(double byHeight);
    /// Moves the focused time cursor to the next edge: `direction` is 1 or -1.
    bool jumpTimeCursor(double direction);
    [[nodiscard]] CursorReadout readout() const;
    /// The values of each visible lane at the time cursors, without references; empty without time cursors.
    [[nodiscard]] std::vector<CursorValue> cursorValues() const;
    /// Reads width and interval around a moment; nothing: the mouse left the plot.
    void hover(std::optional<double> time_s);
    [[nodiscard]] const std::optional<EdgeReading>& hovered() const noexcept { return hovered_; }

    /// Adds a mark for a moment in the bench's session.
    void addMark(MomentMark mark);
    void clearMarks();
    /// The marks within the axis, with their time on the axis; none if a file is shown.
    [[nodiscard]] std::vector<MomentMark> marksOnAxis() const;
    /// Returns ScopeMarks::beside() for the shown capture; empty in roll mode.
    [[nodiscard]] QString markBeside() const;

    [[nodiscard]] const ScopeTrigger& trigger() const noexcept { return trigger_; }
    /// `held`: the user cannot set the level.
    void setTrigger(const QString& lane, const SampleTrigger& trigger, bool held);
    void setPreTrigger(std::optional<double> fraction) { trigger_.setFraction(fraction); }
    void dragTriggerLevel(double height, bool other = false);  ///< see ScopeTrigger::dragLevel()
    void dragTriggerMoment(double time_s);
    void dropTrigger();
    /// Shows the trigger at this time until another capture is shown; nothing: where it was before.
    void markTrigger(std::optional<double> time_s);

signals:
    void tracesChanged();  ///< the lanes or their contents changed; viewChanged() follows
    void lanesChanged();   ///< there are other lanes, or lanes are shown differently
    void viewChanged();    ///< scales, positions, time
    void activeLaneChanged();
    void cursorsChanged();
    void heldChanged();
    void overlayChanged();  ///< cursors, the trigger or the edge reading under the mouse changed
    void triggerLevelChosen(double level);
    void triggerUpperChosen(double level);
    void preTriggerChosen(double fraction);

private:
    [[nodiscard]] const ScopeLane* active() const { return lanes_.find(active_); }
    [[nodiscard]] bool takeLanes();  ///< returns true if the lanes changed
    void chooseActive();
    void fillLanes();
    /// False for a file, which has its own time base.
    [[nodiscard]] bool showsBench() const { return shown() && shown()->source.isEmpty(); }
    void tellTraces(bool lanesToo);
    [[nodiscard]] ScopeFrame::Scene scene() const {
        return {captures_.newest(), captures_.behind(), lanes_, active_, captures_.roll()};
    }
    void movedBy(Viewport& view, double time_s, double height) const;
    /// Changes the view and keeps the old one for undo under `kind`.
    void go(const Viewport& next, const QString& kind);
    void become(const Viewport& next);
    void tellCursors();
    /// Onset and end of the pulse in sight, nearest to the trigger; where the cursors begin.
    [[nodiscard]] std::optional<std::pair<double, double>> pulseInSight() const;
    /// The active lane's resting level and the level of the leading phase of that pulse.
    [[nodiscard]] std::optional<std::pair<double, double>> levelsInSight() const;

    ShownCaptures captures_;
    ScopeLanes lanes_;
    QString active_;
    bool held_ = false;
    std::optional<ComingTrain> coming_;

    ScopeFrame frame_;
    ScopeCursors cursors_;
    ScopeTrigger trigger_;
    std::optional<EdgeReading> hovered_;
    ScopeMarks marks_;
};

}  // namespace tacto::gui
