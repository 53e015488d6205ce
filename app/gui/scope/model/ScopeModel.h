// ScopeModel.h - what the oscilloscope shows, without a widget: captures and their lanes, the part of them that is on
// the screen and the way back from a zoom, cursors, and the trigger. ScopeScreen draws it, ScopeGestures changes it.
//
// Times are seconds on the screen's axis: from the trigger, in roll mode the session's. Heights are divisions above the
// middle.
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

    /// A copy of all of it as it is now; what is shown later does not change it.
    [[nodiscard]] std::unique_ptr<ScopeModel> still() const;

    /// The newest capture. The first one, and one with other channels, is fitted.
    void show(ShownPtr shown);
    /// Shows nothing any longer, as before the first capture; references stay.
    void clear();
    /// Shows the same captures with other calculations.
    void replaceMath(ShownPtr shown);
    [[nodiscard]] const ShownPtr& shown() const noexcept { return captures_.newest(); }
    /// Captures before the newest that stay, faded.
    void setPersistence(int captures);
    /// Captures one after the other on the session's time.
    void setRoll(bool roll);
    [[nodiscard]] bool roll() const noexcept { return captures_.roll(); }
    /// What is shown is the last train of an output that is off: faint, until another capture comes.
    [[nodiscard]] bool held() const { return held_ || coming(); }
    void setHeld(bool held);
    /// The train that follows first from an armed output; nothing: none is known.
    void setComing(const std::optional<ComingTrain>& coming);
    /// The coming train, drawn over the bench's last one, on the time from the trigger; nothing where that is hidden.
    [[nodiscard]] std::optional<ComingTrain> coming() const;
    /// Time 0 of the axis on the session's time base.
    [[nodiscard]] double zero_s() const noexcept { return roll() || !shown() ? 0 : shown()->zero_s; }

    [[nodiscard]] const std::vector<ScopeLane>& lanes() const noexcept { return lanes_.all(); }
    /// Null without one; so for all that take a key.
    [[nodiscard]] const ScopeLane* lane(const QString& key) const { return lanes_.find(key); }
    /// The first channel in this unit; empty without one.
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
    /// The active lane as it is now. Returns its key; empty where there is nothing to store.
    QString storeReference();
    void removeReference(const QString& key);

    [[nodiscard]] const Viewport& viewport() const noexcept { return frame_.view(); }
    /// The time that stays in place under another time base: the trigger; where that is not in view, the middle.
    [[nodiscard]] double restingTime_s() const;
    void setTimePerDivision(double perDivision_s);
    /// Below this the samples shown have no shape: a zoom and a time base end there.
    [[nodiscard]] double leastTimePerDivision_s() const;
    void setTimeCentre(double centre_s);
    void fit();              ///< as ScopeFrame's
    void frameFirstPulse();  ///< as ScopeFrame's
    /// Steps above 0 show more. Steps with the same `kind` that follow at once are undone together.
    void zoomTime(int steps, double anchor_s, const QString& kind);
    void zoomLevel(int steps, double anchorHeight, const QString& kind);
    void zoomToBox(double from_s, double to_s, double bottom, double top);
    void pan(double time_s, double height, const QString& kind);
    /// A drag that began with the view `from` has come so far.
    void dragView(const Viewport& from, double time_s, double height);
    void dragLane(const Viewport& from, const QString& lane, double height);
    /// The present view is one to go back to.
    void remember() { frame_.remember(); }
    bool undoZoom();
    [[nodiscard]] bool canUndo() const noexcept { return frame_.canUndo(); }
    void setChosenView(ChosenView chosen) { frame_.setChosen(std::move(chosen)); }
    [[nodiscard]] ChosenView chosenView() const { return frame_.chosen(scene()); }

    [[nodiscard]] const ScopeCursors& cursors() const noexcept { return cursors_; }
    void setTimeCursors(bool on);
    void setLevelCursors(bool on);
    void focusCursor(int cursor);
    /// Drags it to a time or height, or to an edge or level of rest nearer than `reach`.
    void dragTimeCursor(int which, double time_s, double reach_s);
    void dragLevelCursor(int which, double height, double reach);
    /// Moves the focused cursor, if it is one across time (level). Returns whether it is.
    bool nudgeTimeCursor(double by_s);
    bool nudgeLevelCursor(double byHeight);
    /// Jumps to the next edge: `direction` is 1 or -1.
    bool jumpTimeCursor(double direction);
    [[nodiscard]] CursorReadout readout() const;
    /// The values at the time cursors in each lane shown, references excluded; empty without time cursors.
    [[nodiscard]] std::vector<CursorValue> cursorValues() const;
    /// Reads width and interval at a moment, or nothing.
    void hover(std::optional<double> time_s);
    [[nodiscard]] const std::optional<EdgeReading>& hovered() const noexcept { return hovered_; }

    /// Marks of the bench's session.
    void addMark(MomentMark mark);
    void clearMarks();
    /// The marks that the axis reaches, with their time on it; none where a file is shown.
    [[nodiscard]] std::vector<MomentMark> marksOnAxis() const;
    /// ScopeMarks::beside() for the capture that is shown; empty in roll mode.
    [[nodiscard]] QString markBeside() const;

    [[nodiscard]] const ScopeTrigger& trigger() const noexcept { return trigger_; }
    void setTrigger(const QString& lane, double level, bool held);
    void setPreTrigger(std::optional<double> fraction) { trigger_.setFraction(fraction); }
    void dragTriggerLevel(double height);
    void dragTriggerMoment(double time_s);
    void dropTrigger();

signals:
    void tracesChanged();  ///< lanes or what they show; viewChanged() follows
    void lanesChanged();   ///< the lanes are other ones, or are shown differently
    void viewChanged();    ///< scales, positions, time
    void activeLaneChanged();
    void cursorsChanged();
    void heldChanged();
    void overlayChanged();  ///< cursors, trigger or what is hovered over
    void triggerLevelChosen(double level);
    void preTriggerChosen(double fraction);

private:
    [[nodiscard]] const ScopeLane* active() const { return lanes_.find(active_); }
    [[nodiscard]] bool takeLanes();  ///< whether the lanes are other ones than before
    void chooseActive();
    void fillLanes();
    /// False for a file, which has a time of its own.
    [[nodiscard]] bool showsBench() const { return shown() && shown()->source.isEmpty(); }
    void tellTraces(bool lanesToo);
    [[nodiscard]] ScopeFrame::Scene scene() const {
        return {captures_.newest(), captures_.behind(), lanes_, active_, captures_.roll()};
    }
    void movedBy(Viewport& view, double time_s, double height) const;
    /// Becomes the view, after remembering the present one under `kind`.
    void go(const Viewport& next, const QString& kind);
    void become(const Viewport& next);
    void tellCursors();

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
