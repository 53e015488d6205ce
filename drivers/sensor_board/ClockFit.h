// ClockFit.h - maps the board's time to the session's clock, and estimates how much faster one runs than the other.
//
// The host sees an event of the board only when its message arrives: after a delay that is never negative, mostly short
// and sometimes very long (a busy host). So the true line lies below all points, and the lowest points show it.
//
// Method: take the lowest point of every 2 s of board time (in the first 4 s: of every 0.25 s; as in Paxson, "On
// calibrating measurements of packet transit times", SIGMETRICS 1998) over the last 10 minutes. Three times, keep the
// half of them nearest the line, so that the line settles on the lower envelope (the line under all points of Moon,
// Skelly and Towsley, "Estimation and removal of clock skew from network delay measurements", INFOCOM 1999); fit the
// rest by least squares. Uncertainty: twice the spread about the line, plus how much earlier a message may have come
// than it was seen, divided by the extent in time. This bounds every line that misses no point by more than that
// spread. The spread is that of the points one halving earlier, because the last few were chosen to lie together.
// Before 2 s no drift is reported or applied; while its uncertainty is not small compared to 100 ppm, only a part of it
// is applied.
//
// The offset comes from the shortest delay of the last half minute, less a margin: stamps are late by less than that
// delay, or early by at most the margin (data then look older than they are). The margin is kMargin_s, or 1.1 times the
// smoothed `doubt` of observe() if that is more.
//
// Mapping: corrections change the clock's rate by at most 0.5 %, so that stamps stay evenly spaced. Exception: if a
// message arrived before its own mapped time, the last 8 ms of the mapping are shifted back at once, because no sample
// may ever be stamped ahead of now (hazard H7); such steps are counted.
//
// Thread-safety: none; one owner. Never allocates after construction.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/Units.h"

namespace tacto::sensorboard {

struct ClockReport {
    /// How much faster the board's clock runs than the host's, parts per million; empty until known.
    std::optional<double> drift_ppm;
    std::optional<double> uncertainty_ppm;  ///< uncertainty of the drift, ±
    double span_s = 0;                      ///< length of board time behind the estimate
    std::uint64_t steps = 0;                ///< how often the mapping was shifted back at once by 0.1 ms or more
    double largestStep_s = 0;
    double correction_s = 0;  ///< current correction: session time minus board time, less its first value
};

class ClockFit {
public:
    ClockFit();

    /// Takes an event of the board at `device_us` (µs since its power-up) that was seen at `arrival`. `doubt`: how much
    /// earlier the message may have come, if the line is read only now and then.
    void observe(std::uint64_t device_us, Instant arrival, Seconds doubt = Seconds(0));
    /// Maps a board time to session time in seconds. Valid after the first observe(), for times not much later than the
    /// last observed time and at most about a second before it.
    [[nodiscard]] double toSession(double device_us) const noexcept;
    /// Returns by how much the mapped `device_us` is later than its message's arrival: above 0 only if the board's time
    /// jumped or a message was quicker than any before. Valid after the first observe().
    [[nodiscard]] double early_s(std::uint64_t device_us, Instant arrival) const noexcept;
    /// Moves the mapping at once to where the observations put it. For use before the first sample.
    void settle() noexcept;
    [[nodiscard]] bool started() const noexcept { return started_; }
    [[nodiscard]] const ClockReport& report() const noexcept { return report_; }

    static constexpr double kWindow_s = 2;
    static constexpr double kFirstWindow_s = 0.25;
    static constexpr std::size_t kFirstWindows = 16;
    static constexpr std::size_t kWindows = 300;   ///< nearly 10 minutes
    static constexpr std::size_t kMinWindows = 8;  ///< windows needed to give a drift
    static constexpr double kMaxSlew = 0.005;
    static constexpr double kMargin_s = 0.5e-3;

private:
    struct Point {
        double x;  // board seconds since the first observation
        double y;  // arrival time minus x
    };
    struct Knot {
        double x;
        double correction;
    };
    struct Line {
        double slope = 0;
        double uncertainty = 0;
        double extent = 0;
    };
    void closeWindow();
    [[nodiscard]] std::optional<Line> fit();
    void place();
    void follow(double x, double y);
    void shiftBack(double x, double early) noexcept;
    void pushKnot(const Knot& knot) noexcept;
    [[nodiscard]] double correctionAt(double x) const noexcept;
    [[nodiscard]] double margin() const noexcept;

    bool started_ = false;
    std::uint64_t first_us_ = 0;
    double firstArrival_s_ = 0;

    std::vector<Point> windows_;  // a ring of kWindows, beginning at begin_
    std::size_t begin_ = 0;
    std::vector<Point> kept_;     // only used in fit()
    std::vector<Point> wider_;    // only used in fit(): the points one halving earlier
    std::vector<double> misses_;  // only used in fit()
    Point lowest_{};              // the lowest point of the open window
    double windowEnds_ = 0;
    double doubt_s_ = 0;  // smoothed doubt
    double slope_ = 0;    // slope of y over x; nearly minus the drift
    double base_ = 0;     // y of the line at x = 0

    static constexpr std::size_t kKnots = 32;
    static constexpr double kKnotEvery_s = 0.05;
    std::array<Knot, kKnots> knots_{};  // a ring, newest at newest_; corrections between them are interpolated
    std::size_t newest_ = 0;
    std::size_t knotCount_ = 0;
    double rate_ = 0;  // slope of the correction after the newest knot
    ClockReport report_;
};

}  // namespace tacto::sensorboard
