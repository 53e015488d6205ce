// StripPlots.h - everything over one time axis: acceleration, force, taxels, spectrogram, R and P, the encoded train
// and what was measured of it.
//
// Thread-safety: the GUI thread.
#pragma once

#include <qcustomplot.h>

#include "app/gui/live/LiveHistory.h"
#include "app/gui/live/RollingGraph.h"
#include "app/gui/live/Spectrogram.h"

namespace tacto::gui {

class StripPlots final : public QCustomPlot {
    Q_OBJECT
public:
    explicit StripPlots(const LiveHistory& history, QWidget* parent = nullptr);
    /// Another bench: `simulated` puts the watermark on every strip.
    void begin(bool simulated);
    void setWindow(double seconds);
    [[nodiscard]] double window() const { return window_s_; }
    /// The picture stands still; the bench does not.
    void setFrozen(bool frozen) { frozen_ = frozen; }
    /// A train's command, in volts, is what telemetry says; a train's report is in the source's own unit.
    void setCommandUnit(const QString& unit);
    void redraw();

protected:
    void changeEvent(QEvent* event) override;

private:
    struct Strip {
        QCPAxisRect* axes;
        QString title;
        QString unit;
        QCPItemText* watermark;
        double least = 0;  ///< the value axis never shows less than this
    };
    [[nodiscard]] Strip makeStrip(const QString& title, const QString& unit, double least);
    void colour();
    void fit(Strip& strip, std::span<RollingGraph* const> graphs, bool fromZero);
    void drawTrains(double from_s);

    const LiveHistory& history_;
    double window_s_ = 10;
    bool frozen_ = false;
    bool simulated_ = false;
    std::vector<Strip> strips_;  // acceleration, force, taxels, spectrogram, R and P, trains
    std::vector<RollingGraph*> acceleration_, force_, taxels_;
    RollingGraph* roughness_ = nullptr;
    RollingGraph* pressure_ = nullptr;
    std::unique_ptr<Spectrogram> spectrogram_;
    QCPBars* commanded_ = nullptr;
    QCPGraph* measured_ = nullptr;
    QCPGraph* refused_ = nullptr;
    QCPItemText* empty_ = nullptr;
};

}  // namespace tacto::gui
