// StripPlots.h - everything over one time axis: acceleration, force, taxels, spectrum, R and P, the encoded train and
// its measurement. A strip whose stream the sensor does not have is left out.
//
// Where a stream has stopped, its strip is hatched from the last sample on; where samples are missing the trace is
// broken. A fault is a line at its instant in every strip. A frozen picture is drawn from a copy: it can be looked at
// for as long as one likes.
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
    /// Begins with another bench. What is simulated has the watermark: a recording's touch has none, but the trains it
    /// makes may have it. `commandUnit` is the source's own, V or mA.
    void begin(bool simulatedTouch, bool simulatedSource, const QString& commandUnit);
    void setWindow(double seconds);
    [[nodiscard]] double window() const { return window_s_; }
    /// The picture stands still and can be dragged and zoomed in time; the bench keeps running.
    void setFrozen(bool frozen);
    [[nodiscard]] bool frozen() const { return frozen_ != nullptr; }
    /// A frozen picture: all of it again, or the view before the last drag or zoom.
    void fit();
    void undoZoom();
    [[nodiscard]] bool canUndo() const;
    /// An amplitude that the oscilloscope measured, in the source's unit.
    void addScopeReading(double t_s, double amplitude);
    void redraw();
    /// "last 10 s · Force (N) 0 to 2 · …", and "Force 1.00 N · …": what is shown, as a line each.
    [[nodiscard]] QString scalesText() const;
    [[nodiscard]] QString readingsText() const;
    /// When a frozen picture was frozen, else now.
    [[nodiscard]] QDateTime takenAt() const;

    [[nodiscard]] QCPRange shownTime() const;
    /// True when the strip of this kind is there, and when it is hatched as stale.
    [[nodiscard]] bool has(StreamKind kind) const { return stripOf(kind).present(); }
    [[nodiscard]] bool stale(StreamKind kind) const { return stripOf(kind).stale(); }
    [[nodiscard]] const Spectrogram& spectrogram() const { return *spectrogram_; }
    [[nodiscard]] const TrainGraphs& trains() const { return *trains_; }
    [[nodiscard]] const MarkLines& marks() const { return marks_; }
    /// The text at the instant of a fault; empty where none is seen.
    [[nodiscard]] QString faultSaid() const { return fault_->visible() ? fault_->text() : QString(); }

signals:
    /// Another part of a frozen picture is shown, or it is not frozen any longer.
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
    void shareTime(const QCPRange& range);

    const LiveHistory& history_;
    std::unique_ptr<LiveHistory> frozen_;  // the history as it was when the picture was frozen
    QDateTime frozenAt_;
    QCPRange whole_;               // the whole range of the axis
    std::vector<QCPRange> views_;  // before each drag and zoom of it, the latest last
    double window_s_ = 10;
    bool sharing_ = false;
    int frame_ = 0;
    QSharedPointer<QCPAxisTicker> ticker_;  // shared by the time axes of all strips
    std::deque<Strip> strips_;              // acceleration, force, taxels, spectrum, R and P, trains
    std::vector<RollingGraph*> acceleration_, force_, taxels_;
    RollingGraph* roughness_ = nullptr;
    RollingGraph* pressure_ = nullptr;
    std::unique_ptr<Spectrogram> spectrogram_;
    std::unique_ptr<TrainGraphs> trains_;
    MarkLines marks_{*this};
    QCPItemText* fault_ = nullptr;  // why there is a fault; owned by the plot
};

}  // namespace tacto::gui
