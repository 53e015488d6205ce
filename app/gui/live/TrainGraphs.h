// TrainGraphs.h - draws the trains: the command as a line, each train as delivered, its values as read back and as
// measured by the oscilloscope, trains not delivered, and those of a board that encodes. While a fault holds the output
// off, the background is shaded with a notice, and the command is not drawn.
#pragma once

#include <deque>
#include <optional>
#include <qcustomplot.h>
#include <vector>

#include "app/gui/live/Strip.h"

namespace tacto::gui {

class TrainGraphs {
public:
    /// Draws into `strip`, which must outlive this.
    explicit TrainGraphs(Strip& strip);
    /// Starts anew for another bench, without oscilloscope readings.
    void begin();
    /// Adds an amplitude measured by the oscilloscope, in the stimulator's unit.
    void addScopeReading(double t_s, double amplitude);
    /// Draws in the strip's unit: volts, or milliamps computed with the impedance at each time.
    void draw(const LiveHistory& history, const QCPRange& time);
    /// Applies the colours of the current theme.
    void colour();
    void caption() const;

    /// Returns the amplitudes of the trains drawn as delivered.
    [[nodiscard]] std::vector<double> shownTrains() const;
    /// Return the corners of the command's line, and the oscilloscope's readings shown, in the stimulator's unit.
    [[nodiscard]] std::vector<double> shownCommand() const;
    [[nodiscard]] std::vector<double> scopeReadings() const;
    /// Returns the amplitudes of the board's trains.
    [[nodiscard]] std::vector<double> boardTrains() const;
    /// Returns the onsets of the trains drawn as not delivered.
    [[nodiscard]] QVector<double> shownFailures() const { return failedAt_; }
    /// Returns the shaded time without output in seconds; nothing if no fault is visible.
    [[nodiscard]] std::optional<QCPRange> shownOff() const;
    /// True if the shaded area has room for its words.
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
    QCPGraph* board_ = nullptr;
    QCPItemRect* off_ = nullptr;
    QCPItemText* offSays_ = nullptr;
    static constexpr std::size_t kReadings = 256;
    std::deque<QCPGraphData> readings_;                                                 // newest oscilloscope readings
    QVector<double> at_, value_, measuredAt_, measuredValue_, failedAt_, failedValue_;  // buffers, reused
};

}  // namespace tacto::gui
