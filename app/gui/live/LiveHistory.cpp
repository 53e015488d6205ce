#include "app/gui/live/LiveHistory.h"

#include <algorithm>
#include <cmath>

namespace tacto::gui {

namespace {

constexpr std::size_t kFrames = 8192;           // a minute at 62.5 Hz, with room for faster settings
constexpr std::size_t kCommands = 4096;         // a minute at 60 updates per second
constexpr double kCommandStep_s = 60.0 / 4096;  // least time between commands; slowed time brings more updates
constexpr double kOtherClock_s = 1;
constexpr double kSameFrame_s = 4e-3;  // between the bench's stamp and the board's, mapped to the bench's clock

}  // namespace

Series::Series(std::size_t channels, std::size_t capacity)
    : channels_(std::max<std::size_t>(1, channels)),
      times_(std::max<std::size_t>(1, capacity)),
      values_(times_.size() * channels_) {}

void Series::push(double t_s, std::span<const float> values) {
    if (!std::isfinite(t_s)) return;
    if (count_ > 0 && t_s <= newest()) {
        if (t_s > newest() - kOtherClock_s) return;
        clear();
    }
    times_[head_] = t_s;
    for (std::size_t c = 0; c < channels_; ++c)
        values_[head_ * channels_ + c] = c < values.size() ? values[c] : std::nanf("");
    head_ = head_ + 1 == times_.size() ? 0 : head_ + 1;
    count_ = std::min(count_ + 1, times_.size());
}

std::array<Series::Piece, 2> Series::pieces(std::size_t first, std::size_t end) const noexcept {
    std::array<Piece, 2> found;
    if (first >= end) return found;
    const std::size_t from = at(first), n = end - first;
    const std::size_t before = std::min(n, times_.size() - from);  // up to the end of the ring
    found[0] = {times_.data() + from, values_.data() + from * channels_, before};
    if (n > before) found[1] = {times_.data(), values_.data(), n - before};
    return found;
}

std::size_t Series::firstFrom(double t_s) const noexcept {
    std::size_t low = 0, high = count_;
    while (low < high) {
        const auto middle = (low + high) / 2;
        if (time(middle) < t_s)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

LiveHistory::LiveHistory()
    : frames_(kColumns, kFrames), boardFrames_(kBoardColumns, kFrames), commands_(kCommandColumns, kCommands) {}

void LiveHistory::begin(const std::vector<StreamInfo>& streams) {
    streams_ = streams;
    samples_.clear();
    for (const auto& stream : streams) {
        const auto rate = std::clamp(stream.rate_hz, 10.0, 20'000.0);
        samples_.emplace_back(std::min(stream.channels, TapSample::kMaxChannels),
                              static_cast<std::size_t>(rate * kKept_s));
    }
    frames_.clear();
    boardFrames_.clear();
    commands_.clear();
    trains_.clear();
    boardTrains_.clear();
    marks_.clear();
    now_s_ = 0;
    missed_ = 0;
    fault_.reset();
    faulted_ = false;
}

void LiveHistory::take(BenchTap& tap, const Telemetry& telemetry, QTime clock) {
    now_s_ = toSeconds(telemetry.at);
    while (const auto sample = tap.samples.pop()) {
        if (sample->stream >= samples_.size()) continue;  // a sample for a bench opened meanwhile
        samples_[sample->stream].push(sample->t_s, {sample->values.data(), sample->channels});
    }
    while (const auto frame = tap.frames.pop()) {
        const float columns[kColumns] = {static_cast<float>(frame->R), static_cast<float>(frame->P),
                                         static_cast<float>(frame->h), static_cast<float>(frame->v),
                                         frame->contact ? 1.F : 0.F,   frame->sliding ? 1.F : 0.F};
        frames_.push(frame->t_s, columns);
    }
    takeBoard(tap);
    while (const auto train = tap.trains.pop()) {
        if (trains_.size() == kMaxTrains) trains_.pop_front();
        trains_.push_back(*train);
    }
    if (commands_.empty() || now_s_ >= commands_.newest() + kCommandStep_s) {
        const float columns[kCommandColumns] = {static_cast<float>(telemetry.amplitude_v),
                                                static_cast<float>(telemetry.interval_s),
                                                static_cast<float>(telemetry.impedance_ohm)};
        commands_.push(now_s_, columns);
    }
    missed_ = tap.samples.dropped();
    const bool faulted = telemetry.state == InterlockState::Faulted;
    if (faulted && !faulted_) fault_ = Fault{.at_s = now_s_, .why = telemetry.reason, .clock = clock};
    if (!faulted && faulted_) fault_->until_s = now_s_;
    faulted_ = faulted;
}

/// A board's frame comes no earlier than the bench's of the same samples.
void LiveHistory::takeBoard(BenchTap& tap) {
    while (const auto frame = tap.boardFrames.pop()) {
        const auto i = frames_.firstFrom(frame->t_s - kSameFrame_s);
        const bool same = i < frames_.size() && frames_.time(i) <= frame->t_s + kSameFrame_s;
        const auto above = [&](double board, Column column) {
            return same ? static_cast<float>(board) - frames_.value(i, column) : std::nanf("");
        };
        const float columns[kBoardColumns] = {static_cast<float>(frame->R), static_cast<float>(frame->P),
                                              above(frame->R, kRoughness), above(frame->P, kPressure)};
        boardFrames_.push(frame->t_s, columns);
    }
    while (const auto train = tap.boardTrains.pop()) {
        if (boardTrains_.size() == kMaxTrains) boardTrains_.pop_front();
        boardTrains_.push_back(*train);
    }
}

void LiveHistory::addMark(PlotMark mark) {
    if (marks_.size() == kMaxMarks) marks_.erase(marks_.begin());
    marks_.push_back(std::move(mark));
}

const Series* LiveHistory::samples(StreamKind kind) const noexcept {
    for (std::size_t i = 0; i < streams_.size(); ++i) {
        if (streams_[i].kind == kind) return &samples_[i];
    }
    return nullptr;
}

const StreamInfo* LiveHistory::info(StreamKind kind) const noexcept {
    const auto found = std::find_if(streams_.begin(), streams_.end(), [&](const auto& s) { return s.kind == kind; });
    return found == streams_.end() ? nullptr : &*found;
}

}  // namespace tacto::gui
