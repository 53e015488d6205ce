// StripPlots.h - everything over one time axis: acceleration, force, taxels, spectrum, R and P, the encoded train and
// what was measured of it. A strip whose stream the sensor does not have is left out.
//
// Where a stream has stopped coming its strip is hatched from the last sample on; where samples are missing the trace
// is broken. A frozen picture is drawn from a copy: it can be looked at for as long as one likes.
//
// Thread-safety: the GUI thread.
#pragma once

#include <memory>
#include <qcustomplot.h>

#include "app/gui/live/LiveHistory.h"
#include "app/gui/live/RollingGraph.h"
#include "app/gui/live/Spectrogram.h"
#include "app/gui/live/StripCaption.h"

namespace tacto::gui {

class StripPlots final : public QCustomPlot {
    Q_OBJECT
public:
    explicit StripPlots(const LiveHistory& history, QWidget* parent = nullptr);
    /// Another bench. What is simulated has the watermark: a recording's touch is not, the trains it makes may be.
    /// `commandUnit` is the source's own, V or mA.
    void begin(bool simulatedTouch, bool simulatedSource, const QString& commandUnit);
    void setWindow(double seconds);
    [[nodiscard]] double window() const { return window_s_; }
    /// The picture stands still and can be dragged and zoomed in time; the bench goes on.
    void setFrozen(bool frozen);
    [[nodiscard]] bool frozen() const { return frozen_ != nullptr; }
    /// An amplitude that the oscilloscope measured, in the source's unit.
    void addScopeReading(double t_s, double amplitude);
    void redraw();

    [[nodiscard]] QCPRange shownTime() const;
    /// True when the strip of this kind is there, and when it is hatched as stale.
    [[nodiscard]] bool has(StreamKind kind) const;
    [[nodiscard]] bool stale(StreamKind kind) const;
    [[nodiscard]] const Spectrogram& spectrogram() const { return *spectrogram_; }
    /// Amplitudes of the trains that are drawn, as delivered.
    [[nodiscard]] std::vector<double> shownTrains() const;
    /// Corners of the command's line, and the oscilloscope's readings within the window; in the source's unit.
    [[nodiscard]] std::vector<double> shownCommand() const;
    [[nodiscard]] std::vector<double> scopeReadings() const;

protected:
    void changeEvent(QEvent* event) override;

private:
    struct Strip {
        QCPAxisRect* axes = nullptr;
        QString title;
        QString unit;
        QCPItemText* watermark = nullptr;
        StripCaption* caption = nullptr;  ///< title, then a key for each thing drawn, in its colour
        QCPItemRect* hatch = nullptr;
        double scale = 1;  ///< from samples to the axis
        double least = 0;  ///< the value axis never shows a smaller span
        bool fromZero = false;
        bool present = true;
        bool simulated = false;
    };
    void makeStrip(std::size_t index, const QString& title, double least, bool fromZero);
    [[nodiscard]] const LiveHistory& shown() const { return frozen_ ? *frozen_ : history_; }
    void attach();
    void colour();
    void layOut();
    void fit(Strip& strip, std::span<RollingGraph* const> graphs, const QCPRange& time);
    void hatch(Strip& strip, const Series* series, double now_s);
    void drawTrains(const QCPRange& time);
    void drawCommand(const QCPRange& time);
    void write();
    void shareTime(const QCPRange& range);

    const LiveHistory& history_;
    std::unique_ptr<LiveHistory> frozen_;  // while the picture stands still
    double window_s_ = 10;
    bool sharing_ = false;
    int frame_ = 0;
    std::vector<Strip> strips_;  // acceleration, force, taxels, spectrum, R and P, trains
    std::vector<RollingGraph*> acceleration_, force_, taxels_;
    RollingGraph* roughness_ = nullptr;
    RollingGraph* pressure_ = nullptr;
    std::unique_ptr<Spectrogram> spectrogram_;
    QCPGraph* command_ = nullptr;
    QCPBars* delivered_ = nullptr;
    QCPGraph* measured_ = nullptr;
    QCPGraph* scoped_ = nullptr;
    QCPGraph* failed_ = nullptr;
    static constexpr std::size_t kReadings = 256;
    std::vector<QCPGraphData> readings_;  // of the oscilloscope, a ring
    std::size_t nextReading_ = 0;
    QVector<double> at_, value_, measuredAt_, measuredValue_, failedAt_, failedValue_;  // reused
};

}  // namespace tacto::gui
