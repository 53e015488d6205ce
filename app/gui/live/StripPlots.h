// StripPlots.h - the live plots over one time axis: acceleration, force, taxels, spectrum, R and P, the encoded train
// and its measurement. A strip is left out if the sensor lacks its stream. The R, P and trains of a board that encodes
// are drawn over the bench's, with the difference in words.
//
// If a stream has stopped, its strip is hatched from the last sample on; missing samples break the trace. A fault is a
// line at its time in every strip. A frozen picture is drawn from a copy, so it can be viewed for any length of time.
#pragma once

#include <deque>
#include <memory>
#include <qcustomplot.h>

#include "app/gui/live/LiveHistory.h"
#include "app/gui/live/RollingGraph.h"
#include "app/gui/live/Spectrogram.h"
#include "app/gui/live/Strip.h"
#include "app/gui/live/TrainGraphs.h"
#include "app/gui/theme/MarkLines.h"

namespace tacto::gui {

class StripPlots final : public QCustomPlot {
    Q_OBJECT
public:
    explicit StripPlots(const LiveHistory& history, QWidget* parent = nullptr);
    /// Starts anew for another bench. Simulated data has a watermark: a recording's touch has none, but its trains may
    /// have one. `commandUnit`: the stimulator's unit, V or mA.
    void begin(bool simulatedTouch, bool simulatedSource, const QString& commandUnit);
    void setWindow(double seconds);
    [[nodiscard]] double window() const { return window_s_; }
    /// Freezes the picture, which can then be dragged and zoomed in time; the bench keeps running.
    void setFrozen(bool frozen);
    [[nodiscard]] bool frozen() const { return frozen_ != nullptr; }
    /// In a frozen picture: shows all of it again, or (undoZoom) the view before the last drag or zoom.
    void fit();
    void undoZoom();
    [[nodiscard]] bool canUndo() const;
    /// Adds an amplitude measured by the oscilloscope, in the stimulator's unit.
    void addScopeReading(double t_s, double amplitude);
    void redraw();
    /// Return the text of what is shown: "last 10 s · Force (N) 0 to 2 · …", and "Force 1.00 N · …", each in one line.
    [[nodiscard]] QString scalesText() const;
    [[nodiscard]] QString readingsText() const;
    /// Returns the time at which the picture was frozen; otherwise the present time.
    [[nodiscard]] QDateTime takenAt() const;

    [[nodiscard]] QCPRange shownTime() const;
    /// True if the strip of this kind is present, and if it is hatched because its samples are old.
    [[nodiscard]] bool has(StreamKind kind) const { return stripOf(kind).present(); }
    [[nodiscard]] bool stale(StreamKind kind) const { return stripOf(kind).stale(); }
    [[nodiscard]] const Spectrogram& spectrogram() const { return *spectrogram_; }
    [[nodiscard]] const TrainGraphs& trains() const { return *trains_; }
    [[nodiscard]] const MarkLines& marks() const { return marks_; }
    /// Returns the text at a fault's time; empty if no fault is visible.
    [[nodiscard]] QString faultSaid() const { return fault_->visible() ? fault_->text() : QString(); }

signals:
    /// Another part of a frozen picture is shown, or the picture is no longer frozen.
    void viewChanged();

private:
    [[nodiscard]] const LiveHistory& shown() const { return frozen_ ? *frozen_ : history_; }
    void rememberView();
    void attach();
    void dress();
    [[nodiscard]] const Strip& stripOf(StreamKind kind) const;
    void markFault(const QCPRange& time);
    void write();
    [[nodiscard]] QString taxelText(const Series& taxels) const;
    [[nodiscard]] QString indicesText() const;
    void shareTime(const QCPRange& range);

    const LiveHistory& history_;
    std::unique_ptr<LiveHistory> frozen_;  // copy of the history from the moment of freezing
    QDateTime frozenAt_;
    QCPRange whole_;               // the whole range of the axis
    std::vector<QCPRange> views_;  // the views before each drag and zoom, latest last
    double window_s_ = 10;
    bool sharing_ = false;
    int frame_ = 0;
    QSharedPointer<QCPAxisTicker> ticker_;  // shared by the time axes of all strips
    std::deque<Strip> strips_;              // acceleration, force, taxels, spectrum, R and P, trains
    std::vector<RollingGraph*> acceleration_, force_, taxels_;
    RollingGraph* roughness_ = nullptr;
    RollingGraph* pressure_ = nullptr;
    RollingGraph *boardRoughness_ = nullptr, *boardPressure_ = nullptr;  // over the bench's, if a board encodes
    std::unique_ptr<Spectrogram> spectrogram_;
    std::unique_ptr<TrainGraphs> trains_;
    MarkLines marks_{*this};
    QCPItemText* fault_ = nullptr;  // the cause of a fault; owned by the plot
};

}  // namespace tacto::gui
