// TrainGraphs.h - what is drawn of the trains: the command as a line, each train as delivered, what the source read
// back and the oscilloscope measured of it, and those that were not delivered. While a fault holds the output off, the
// ground is shaded and says so, and what was asked for is not drawn.
#pragma once

#include <deque>
#include <optional>
#include <qcustomplot.h>
#include <vector>

#include "app/gui/live/Strip.h"

namespace tacto::gui {

class TrainGraphs {
public:
    /// Draws into `strip`, which outlives this.
    explicit TrainGraphs(Strip& strip);
    /// Begins another bench: the oscilloscope has measured nothing.
    void begin();
    /// An amplitude that the oscilloscope measured, in the source's unit.
    void addScopeReading(double t_s, double amplitude);
    /// Draws in the strip's unit: volts, or the milliamps that they become through the impedance of the time.
    void draw(const LiveHistory& history, const QCPRange& time);
    /// Takes the colours of the current theme.
    void colour();
    void caption() const;

    /// Amplitudes of the trains that are drawn, as delivered.
    [[nodiscard]] std::vector<double> shownTrains() const;
    /// Corners of the command's line, and the oscilloscope's readings within the window; in the source's unit.
    [[nodiscard]] std::vector<double> shownCommand() const;
    [[nodiscard]] std::vector<double> scopeReadings() const;
    /// Onsets of the trains drawn as not delivered.
    [[nodiscard]] QVector<double> shownFailures() const { return failedAt_; }
    /// The shaded time without output, in seconds; nothing where no fault is in sight.
    [[nodiscard]] std::optional<QCPRange> shownOff() const;
    /// Whether the words stand in what is shaded: they have room there.
    [[nodiscard]] bool saysOff() const { return offSays_->visible(); }

private:
    void drawCommand(const LiveHistory& history, const QCPRange& time);
    void drawTrains(const LiveHistory& history, const QCPRange& time);
    void drawOff(const LiveHistory& history, const QCPRange& time);

    Strip& strip_;
    QCPGraph* command_;
    QCPBars* delivered_;
    QCPGraph* measured_ = nullptr;
    QCPGraph* scoped_ = nullptr;
    QCPGraph* failed_ = nullptr;
    QCPItemRect* off_ = nullptr;
    QCPItemText* offSays_ = nullptr;
    static constexpr std::size_t kReadings = 256;
    std::deque<QCPGraphData> readings_;                                                 // the oscilloscope's newest
    QVector<double> at_, value_, measuredAt_, measuredValue_, failedAt_, failedValue_;  // reused
};

}  // namespace tacto::gui
