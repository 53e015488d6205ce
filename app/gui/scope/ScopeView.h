// ScopeView.h - the oscilloscope's screen: lanes (channels, what is calculated from them, stored references) on ten by
// eight divisions, moved and measured with mouse and keys.
//
// Mouse: the wheel zooms time, Ctrl+wheel the level of the active lane, dragging pans, Shift+drag (or the box tool)
// zooms into a box, a double click fits, handles are dragged. Keys: arrows nudge the focused cursor, or pan without
// one;
// + and - zoom, Home fits, Ctrl+Z goes back, 1 to 4 focus a cursor.
//
// Time on the axis counts from the trigger; in roll mode it is the session's.
//
// Thread-safety: the GUI thread.
#pragma once

#include <array>
#include <deque>
#include <memory>
#include <optional>
#include <qcustomplot.h>

#include "app/gui/scope/EnvelopeGraph.h"
#include "app/gui/scope/Graticule.h"
#include "app/gui/scope/ScopeOverlay.h"
#include "app/gui/scope/Viewport.h"

namespace tacto::gui {

/// What the controls show of a lane.
struct LaneInfo {
    QString key;
    QString title;
    QString letter;  ///< on its handle
    QString unit;
    QColor colour;
    bool shown = true;
    bool reference = false;  ///< drawn with the scale of the lane it was stored from
    LaneScale scale;
};

/// NaN where there is no cursor or no value.
struct CursorReadout {
    double x1_s = kNotMeasured, x2_s = kNotMeasured;
    double at1 = kNotMeasured, at2 = kNotMeasured;  ///< the active lane's samples there
    double y1 = kNotMeasured, y2 = kNotMeasured;
    QString unit;  ///< of the active lane
    [[nodiscard]] double dx_s() const noexcept { return x2_s - x1_s; }
    [[nodiscard]] double dy() const noexcept { return y2 - y1; }
};

/// What the user chose to see of the bench's captures, where it is not the whole.
struct ChosenView {
    struct Time {
        double left_s = 0, perDivision_s = 0;
    };
    std::optional<Time> time;
    std::map<QString, LaneScale> lanes;  ///< empty: fitted
};

class ScopeView final : public QCustomPlot {
    Q_OBJECT
public:
    static constexpr int kMaxBehind = 32;

    explicit ScopeView(QWidget* parent = nullptr);

    /// The newest capture. The first one, and one with other channels, is fitted.
    void show(ShownPtr shown);
    /// The same captures with other calculations.
    void replaceMath(ShownPtr shown);
    void clear();
    [[nodiscard]] const ShownPtr& shown() const noexcept { return shown_; }
    using QCustomPlot::show;

    [[nodiscard]] std::vector<LaneInfo> lanes() const;
    [[nodiscard]] const EnvelopeGraph* graph(const QString& lane) const;
    void setLaneShown(const QString& lane, bool shown);
    void setLaneScale(const QString& lane, double perDivision);
    void setLanePosition(const QString& lane, double position);
    void setActiveLane(const QString& lane);
    [[nodiscard]] QString activeLane() const { return active_; }

    [[nodiscard]] const Viewport& viewport() const noexcept { return view_; }
    void setTimePerDivision(double perDivision_s);
    void setTimeCentre(double centre_s);
    void fit();
    void fitTime();
    bool undoZoom();
    [[nodiscard]] bool canUndo() const noexcept { return !history_.empty(); }
    void setBoxZoom(bool on);
    /// For the bench's first capture, instead of a fit: from an earlier session, or from before a file was looked at.
    void setChosenView(ChosenView chosen) { chosen_ = std::move(chosen); }
    [[nodiscard]] ChosenView chosenView() const;

    /// Captures before the newest that stay, faded.
    void setPersistence(int captures);
    /// Captures one after the other on the session's time.
    void setRoll(bool roll);
    [[nodiscard]] bool roll() const noexcept { return roll_; }

    /// Level in the lane's unit; `held`: it cannot be dragged. An empty lane shows no level.
    void setTrigger(const QString& lane, double level, bool held);
    /// Fraction of the record before the trigger, for dragging the moment; nothing: a record that is not ours to set.
    void setPreTrigger(std::optional<double> fraction);

    void setTimeCursors(bool on);
    void setLevelCursors(bool on);
    void focusCursor(int cursor);
    [[nodiscard]] CursorReadout readout() const;

    /// The active lane as it is now. Returns its key; empty where there is nothing to store.
    QString storeReference();
    void removeReference(const QString& key);
    [[nodiscard]] TracePtr trace(const QString& lane) const;

    /// Seconds on the axis of a moment of the session, and back.
    [[nodiscard]] double zero_s() const noexcept { return roll_ || !shown_ ? 0 : shown_->zero_s; }
    [[nodiscard]] const OverlayState& overlay() const { return overlay_->state; }

signals:
    void lanesChanged();  ///< there are others, or they are shown otherwise
    void viewChanged();   ///< scales, positions, time
    void activeLaneChanged();
    void cursorsChanged();
    void boxZoomEnded();
    void triggerLevelChosen(double level);
    void preTriggerChosen(double fraction);

protected:
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void mouseReleaseEvent(QMouseEvent* event) override;
    void mouseDoubleClickEvent(QMouseEvent* event) override;
    void wheelEvent(QWheelEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    void leaveEvent(QEvent* event) override;
    void changeEvent(QEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;
    void focusInEvent(QFocusEvent* event) override;
    void focusOutEvent(QFocusEvent* event) override;

private:
    struct Lane {
        QString key, title, letter, unit;
        QString follows;  ///< a reference's source
        TracePtr stored;  ///< a reference's own trace
        bool shown = true;
        EnvelopeGraph* graph = nullptr;
        std::vector<EnvelopeGraph*> behind;  ///< older captures, newest first
    };
    /// What the pressed mouse does.
    enum class Drag { None, Undecided, Pan, Box, Grip };

    Lane* lane(const QString& key);
    [[nodiscard]] const Lane* lane(const QString& key) const;
    [[nodiscard]] LaneScale scaleOf(const Lane& lane) const;
    [[nodiscard]] QColor colourOf(const Lane& lane) const;
    void takeLanes();
    void dropOldest();
    [[nodiscard]] Lane* gripLane(int number);
    void fitLanes(Viewport& view) const;
    [[nodiscard]] bool showsWhole(const ShownCapture& shown) const;
    void takeChosenView();
    [[nodiscard]] bool outgrown() const;
    /// Where the screen begins in roll mode: the newest capture ends it.
    [[nodiscard]] double rollLeft(double perDivision_s) const;
    void fillGraphs();
    void removeLane(QString key);  // by value: the lane that owns it goes
    /// Becomes the view, after remembering the present one under `kind`.
    void go(const Viewport& next, const QString& kind);
    void apply();
    void applyAxes();
    void restyle();
    void fillOverlay();
    void refreshOverlay();

    [[nodiscard]] double timeAt(double x) const;
    [[nodiscard]] double heightAt(double y) const;
    [[nodiscard]] double pixelTime() const;
    void dragGrip(const QPointF& pixel);
    void endBox();
    void hover(const QPointF& pixel);
    void pickLane(const QPointF& pixel);
    [[nodiscard]] std::optional<OverlayState::Hover> hoverAt(double time_s) const;
    [[nodiscard]] double nextEdge(double time_s, double direction) const;
    [[nodiscard]] double snappedTime(double time_s) const;
    [[nodiscard]] double snappedLevel(double level) const;
    void nudge(int key, Qt::KeyboardModifiers modifiers);
    void panBy(double time_s, double height);

    ShownPtr shown_;
    std::deque<ShownPtr> older_;  ///< newest first: for persistence, or the roll with shown_ left out
    std::vector<std::unique_ptr<Lane>> lanes_;
    QString active_;
    int references_ = 0;
    int persistence_ = 0;
    bool roll_ = false;

    Viewport view_;
    ChosenView chosen_;
    ViewHistory history_;
    bool untouched_ = true;  ///< the view is a fit and was not changed: it grows with the signal
    bool boxZoom_ = false;
    Drag drag_ = Drag::None;
    GripAt grip_;
    QPointF pressedAt_;
    Viewport pressedView_;

    QString triggerLane_;
    double triggerLevel_ = 0;
    bool triggerHeld_ = false;
    std::optional<double> preTrigger_;
    std::optional<double> wantedMoment_s_;  ///< while the trigger's moment is dragged
    QString triggerText_;

    std::optional<std::array<double, 2>> timeCursors_;   ///< seconds on the axis
    std::optional<std::array<double, 2>> levelCursors_;  ///< in the active lane's unit
    int focusedCursor_ = -1;
    std::optional<OverlayState::Hover> hover_;
    std::optional<QRectF> box_;

    QSharedPointer<GraticuleTicker> timeTicker_, leftTicker_, rightTicker_;
    QCPItemText* watermark_ = nullptr;  ///< owned by the plot
    RecordGround* ground_ = nullptr;    ///< owned by the plot
    ScopeOverlay* overlay_ = nullptr;   ///< owned by the plot
};

}  // namespace tacto::gui
