// LiveHistory.h - the last minute of what the bench showed: samples, roughness frames, the encoder's command, trains,
// the operator's marks. What the live plots draw.
//
// Bounded: each series is a ring of fixed size that forgets its oldest. Times are the session's, in seconds.
//
// Thread-safety: the GUI thread; the one reader of the bench's tap.
#pragma once

#include <QTime>
#include <array>
#include <cstddef>
#include <deque>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/gui/theme/MarkLines.h"
#include "core/base/Stream.h"
#include "core/bench/Telemetry.h"
#include "core/bench/sensing/BenchTap.h"

namespace tacto::gui {

/// Samples of a few channels on one time axis, oldest first.
class Series {
public:
    Series(std::size_t channels, std::size_t capacity);
    /// A stamp that is not later than the newest is left out (two values cannot stand at one time); one more than a
    /// second before it is another clock, and starts over.
    void push(double t_s, std::span<const float> values);
    void clear() noexcept { count_ = head_ = 0; }
    [[nodiscard]] bool empty() const noexcept { return count_ == 0; }
    [[nodiscard]] std::size_t size() const noexcept { return count_; }
    [[nodiscard]] std::size_t channels() const noexcept { return channels_; }
    [[nodiscard]] std::size_t capacity() const noexcept { return times_.size(); }
    /// `i` < size(), 0 the oldest; NaN where the sensor sent none.
    [[nodiscard]] double time(std::size_t i) const noexcept { return times_[at(i)]; }
    [[nodiscard]] float value(std::size_t i, std::size_t channel) const noexcept {
        return values_[at(i) * channels_ + channel];
    }
    /// Samples that lie one after the other in memory: `values` has channels() for each time.
    struct Piece {
        const double* times = nullptr;
        const float* values = nullptr;
        std::size_t size = 0;
    };
    /// The samples from `first` up to `end` <= size(): in two pieces where the ring turns over, for who reads many.
    [[nodiscard]] std::array<Piece, 2> pieces(std::size_t first, std::size_t end) const noexcept;
    /// Time of the newest; not to be asked of an empty one.
    [[nodiscard]] double newest() const noexcept { return time(count_ - 1); }
    /// The first sample at or after `t_s`; size() when all are earlier.
    [[nodiscard]] std::size_t firstFrom(double t_s) const noexcept;

private:
    [[nodiscard]] std::size_t at(std::size_t i) const noexcept {
        const auto place = head_ + times_.size() - count_ + i;
        return place >= times_.size() ? place - times_.size() : place;
    }
    std::size_t channels_;
    std::vector<double> times_;
    std::vector<float> values_;
    std::size_t head_ = 0;  // where the next goes
    std::size_t count_ = 0;
};

class LiveHistory {
public:
    static constexpr double kKept_s = 60;
    static constexpr std::size_t kMaxMarks = 64;    ///< the newest marks in the kept time
    static constexpr std::size_t kMaxTrains = 512;  ///< the newest trains
    /// Columns of frames(): R, P, h, v; contact and sliding are 0 or 1.
    enum Column : std::size_t { kRoughness, kPressure, kSpectral, kSpatial, kContact, kSliding, kColumns };
    /// Columns of commands(): what the encoder asked for, and |Z| at that time; NaN while it asked for nothing.
    enum Command : std::size_t { kAmplitude_v, kInterval_s, kImpedance_ohm, kCommandColumns };

    LiveHistory();
    /// Forgets everything, as another bench is open. `streams` as its sensor names them.
    void begin(const std::vector<StreamInfo>& streams);
    /// Takes what came since the last call; `clock`: the time of day.
    void take(BenchTap& tap, const Telemetry& telemetry, QTime clock = QTime::currentTime());

    [[nodiscard]] const std::vector<StreamInfo>& streams() const noexcept { return streams_; }
    /// Null when the sensor has no such stream.
    [[nodiscard]] const Series* samples(StreamKind kind) const noexcept;
    [[nodiscard]] const StreamInfo* info(StreamKind kind) const noexcept;
    [[nodiscard]] const Series& frames() const noexcept { return frames_; }
    [[nodiscard]] const Series& commands() const noexcept { return commands_; }
    /// Oldest first, impedance checks included.
    [[nodiscard]] const std::deque<TrainReport>& trains() const noexcept { return trains_; }
    /// The operator's marks, in the order in which they were made.
    [[nodiscard]] const std::vector<PlotMark>& marks() const noexcept { return marks_; }
    void addMark(PlotMark mark);
    /// Time of the bench at the last take().
    [[nodiscard]] double now_s() const noexcept { return now_s_; }
    /// The last fault; nothing without one since begin(). Nothing is delivered from `at_s` to `until_s`.
    struct Fault {
        double at_s = 0;
        double until_s = std::numeric_limits<double>::infinity();  ///< its reset
        FixedText<200> why;
        QTime clock;  ///< the clock as it was seen
    };
    [[nodiscard]] const std::optional<Fault>& fault() const noexcept { return fault_; }
    /// Samples left out of the picture because the window looked too rarely; the recording has them.
    [[nodiscard]] std::uint64_t missed() const noexcept { return missed_; }

private:
    std::vector<StreamInfo> streams_;
    std::vector<Series> samples_;
    Series frames_;
    Series commands_;
    std::deque<TrainReport> trains_;
    std::vector<PlotMark> marks_;  // kMaxMarks at most
    double now_s_ = 0;
    std::uint64_t missed_ = 0;
    std::optional<Fault> fault_;
    bool faulted_ = false;
};

}  // namespace tacto::gui
