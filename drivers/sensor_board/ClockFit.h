// ClockFit.h - the board's time on the session's clock, and by how much the two run apart.
//
// The host sees a moment of the board only when its message arrives: the moment plus a delay that is never negative,
// mostly short and now and then very long (a busy host). So the true line lies under all points, and the lowest ones
// tell of it.
//
// Method: the lowest point of every 2 s of board time, and of every 0.25 s of the first four (as in Paxson, "On
// calibrating measurements of packet transit times", SIGMETRICS 1998), over the last 10 minutes; of these the half
// nearest the line, three times over, so that the line settles on the lower envelope (the line under all points of
// Moon, Skelly and Towsley, "Estimation and removal of clock skew from network delay measurements", INFOCOM 1999);
// least squares through what is left. Its uncertainty is twice the spread about the line, plus how much earlier a
// message may have come than it was seen, over the extent in time: the steepest and the flattest line that miss none of
// the points by more than that spread differ from it by so much. The spread is that of the points of one halving
// before, for the lowest few lie together by choice. Before 2 s there is no drift to speak of: none is reported and
// none applied; while its uncertainty is not small beside 100 ppm, only a part of it is.
//
// The offset is that of the shortest delay seen in the last half minute, less a margin: stamps are late by that delay,
// or early by the margin at most, which makes data look older, never fresher. The margin is kMargin_s, or what a
// message may have come earlier than it was seen, if that is more.
//
// Mapping: what is learnt is applied by turning the clock faster or slower by at most 0.5 %, so that stamps stay evenly
// spaced. One thing is done at once: a message that arrived before its own moment, as mapped, shifts the mapping back
// over its last 8 ms, for no sample is ever stamped ahead of now (hazard H7); such steps are counted.
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
    /// How much faster the board's clock runs than the host's, parts per million; nothing before it is known.
    std::optional<double> drift_ppm;
    std::optional<double> uncertainty_ppm;  ///< the drift is known to ± this
    double span_s = 0;                      ///< board time that the estimate stands on
    std::uint64_t steps = 0;                ///< times that the mapping was shifted back at once by 0.1 ms or more
    double largestStep_s = 0;
    double correction_s = 0;  ///< applied now: session time minus board time, less what it was at first
};

class ClockFit {
public:
    ClockFit();

    /// Something that the board did or wrote at `device_us` (µs since its power-up) was seen at `arrival`. `doubt`: how
    /// much earlier it may have come, where the line is only looked at now and then.
    void observe(std::uint64_t device_us, Instant arrival, Seconds doubt = Seconds(0));
    /// Session time of a moment of the board, seconds. Meaningful after the first observe(); asked for moments not much
    /// later than the last one observed and at most a second or so before it.
    [[nodiscard]] double toSession(double device_us) const noexcept;
    /// How much later `device_us`, as mapped, is than its own message's arrival: above 0 only where the board's time
    /// jumped, or a message was quicker than any before. Meaningful after the first observe().
    [[nodiscard]] double early_s(std::uint64_t device_us, Instant arrival) const noexcept;
    /// Puts the mapping where it belongs by what has been observed, at once. For before the first sample.
    void settle() noexcept;
    [[nodiscard]] bool started() const noexcept { return started_; }
    [[nodiscard]] const ClockReport& report() const noexcept { return report_; }

    static constexpr double kWindow_s = 2;
    static constexpr double kFirstWindow_s = 0.25;
    static constexpr std::size_t kFirstWindows = 16;
    static constexpr std::size_t kWindows = 300;   ///< 10 minutes, nearly
    static constexpr std::size_t kMinWindows = 8;  ///< needed before there is a drift
    static constexpr double kMaxSlew = 0.005;
    static constexpr double kMargin_s = 0.5e-3;

private:
    struct Point {
        double x;  // board seconds since the first observation
        double y;  // arrival minus that
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

    std::vector<Point> windows_;  // a ring of kWindows, oldest first from begin_
    std::size_t begin_ = 0;
    std::vector<Point> kept_;     // fit()'s own
    std::vector<Point> wider_;    // fit()'s own: one halving before
    std::vector<double> misses_;  // fit()'s own
    Point lowest_{};              // the lowest point of the open window
    double windowEnds_ = 0;
    double doubt_s_ = 0;  // smoothed
    double slope_ = 0;    // slope of y over x; nearly the negative drift
    double base_ = 0;     // y of the line at x = 0

    static constexpr std::size_t kKnots = 32;
    static constexpr double kKnotEvery_s = 0.05;
    std::array<Knot, kKnots> knots_{};  // a ring, newest at newest_; corrections between them are interpolated
    std::size_t newest_ = 0;
    std::size_t knotCount_ = 0;
    double rate_ = 0;  // how fast the correction grows beyond the newest knot
    ClockReport report_;
};

}  // namespace tacto::sensorboard
