// LiveHistory.h - the last minute of a bench, as drawn by the live plots: samples, roughness frames, the encoder's
// command, trains, and the operator's marks.
//
// Bounded: each series is a ring of fixed size that overwrites its oldest samples. Times are session times in seconds.
//
// Thread-safety: the GUI thread; this is the only reader of the bench's tap.
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
    /// Adds a sample. Ignores one that is not later than the newest; a time more than a second before the newest comes
    /// from another clock, and the series starts over.
    void push(double t_s, std::span<const float> values);
    void clear() noexcept { count_ = head_ = 0; }
    [[nodiscard]] bool empty() const noexcept { return count_ == 0; }
    [[nodiscard]] std::size_t size() const noexcept { return count_; }
    [[nodiscard]] std::size_t channels() const noexcept { return channels_; }
    [[nodiscard]] std::size_t capacity() const noexcept { return times_.size(); }
    /// `i` < size(), 0 is the oldest; NaN if the sensor sent no value.
    [[nodiscard]] double time(std::size_t i) const noexcept { return times_[at(i)]; }
    [[nodiscard]] float value(std::size_t i, std::size_t channel) const noexcept {
        return values_[at(i) * channels_ + channel];
    }
    /// Samples stored one after the other in memory: `values` has channels() entries for each time.
    struct Piece {
        const double* times = nullptr;
        const float* values = nullptr;
        std::size_t size = 0;
    };
    /// Returns the samples from `first` up to `end` <= size(): two pieces if they pass the ring's end.
    [[nodiscard]] std::array<Piece, 2> pieces(std::size_t first, std::size_t end) const noexcept;
    /// Returns the time of the newest sample; the series must not be empty.
    [[nodiscard]] double newest() const noexcept { return time(count_ - 1); }
    /// Returns the index of the first sample at or after `t_s`; size() if all are earlier.
    [[nodiscard]] std::size_t firstFrom(double t_s) const noexcept;

private:
    [[nodiscard]] std::size_t at(std::size_t i) const noexcept {
        const auto place = head_ + times_.size() - count_ + i;
        return place >= times_.size() ? place - times_.size() : place;
    }
    std::size_t channels_;
    std::vector<double> times_;
    std::vector<float> values_;
    std::size_t head_ = 0;  // where the next sample goes
    std::size_t count_ = 0;
};

class LiveHistory {
public:
    static constexpr double kKept_s = 60;
    static constexpr std::size_t kMaxMarks = 64;    ///< the newest marks within kKept_s
    static constexpr std::size_t kMaxTrains = 512;  ///< the newest trains
    /// Columns of frames(): R (roughness), P (pressure), h, v; contact and sliding are 0 or 1.
    enum Column : std::size_t { kRoughness, kPressure, kSpectral, kSpatial, kContact, kSliding, kColumns };
    /// Columns of commands(): what the encoder asked for, and |Z| at that time; NaN if it asked for nothing.
    enum Command : std::size_t { kAmplitude_v, kInterval_s, kImpedance_ohm, kCommandColumns };

    /// Columns of boardFrames(): as the board's own encoder sees them, and how much they are above the bench's; NaN
    /// where the bench has no such frame.
    enum BoardColumn : std::size_t { kBoardRoughness, kBoardPressure, kAboveR, kAboveP, kBoardColumns };

    LiveHistory();
    /// Forgets everything, since another bench is open. `streams`: as named by the bench's sensor.
    void begin(const std::vector<StreamInfo>& streams);
    /// Takes all data since the last call; `clock`: the time of day.
    void take(BenchTap& tap, const Telemetry& telemetry, QTime clock = QTime::currentTime());

    [[nodiscard]] const std::vector<StreamInfo>& streams() const noexcept { return streams_; }
    /// Returns null if the sensor has no such stream.
    [[nodiscard]] const Series* samples(StreamKind kind) const noexcept;
    [[nodiscard]] const StreamInfo* info(StreamKind kind) const noexcept;
    [[nodiscard]] const Series& frames() const noexcept { return frames_; }
    /// Empty unless a board encodes, as are boardTrains().
    [[nodiscard]] const Series& boardFrames() const noexcept { return boardFrames_; }
    [[nodiscard]] const std::deque<EncodedTrain>& boardTrains() const noexcept { return boardTrains_; }
    [[nodiscard]] const Series& commands() const noexcept { return commands_; }
    /// The trains, oldest first, including impedance checks.
    [[nodiscard]] const std::deque<TrainReport>& trains() const noexcept { return trains_; }
    /// The operator's marks, in the order of their creation.
    [[nodiscard]] const std::vector<PlotMark>& marks() const noexcept { return marks_; }
    void addMark(PlotMark mark);
    /// Returns the bench's time at the last take().
    [[nodiscard]] double now_s() const noexcept { return now_s_; }
    /// The last fault since begin(), if any. Nothing is delivered from `at_s` to `until_s`.
    struct Fault {
        double at_s = 0;
        double until_s = std::numeric_limits<double>::infinity();  ///< time of the fault's reset
        FixedText<200> why;
        QTime clock;  ///< time of day at which the fault was seen
    };
    [[nodiscard]] const std::optional<Fault>& fault() const noexcept { return fault_; }
    /// Returns how many samples are missing from the plots because the window read too rarely; the recording has them.
    [[nodiscard]] std::uint64_t missed() const noexcept { return missed_; }

private:
    void takeBoard(BenchTap& tap);

    std::vector<StreamInfo> streams_;
    std::vector<Series> samples_;
    Series frames_;
    Series boardFrames_;
    Series commands_;
    std::deque<TrainReport> trains_;
    std::deque<EncodedTrain> boardTrains_;
    std::vector<PlotMark> marks_;  // at most kMaxMarks
    double now_s_ = 0;
    std::uint64_t missed_ = 0;
    std::optional<Fault> fault_;
    bool faulted_ = false;
};

}  // namespace tacto::gui
