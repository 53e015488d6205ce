#include "drivers/sensor_board/FirmwareBoard.h"

#include <algorithm>
#include <cmath>
#include <thread>

namespace tacto::sensorboard {

namespace {

constexpr std::uint64_t kStep_us = 1000;
constexpr std::uint64_t kLate_us = 15'000;  // a block that does not fill leaves by then
constexpr double kBlock_s = 0.01;
constexpr std::size_t kLineBytes = 65536;  // what the line holds until it is read
constexpr std::chrono::milliseconds kLookEvery(1);

tsb_kind kindOf(StreamKind kind) noexcept {
    return kind == StreamKind::Acceleration ? TSB_KIND_ACCELERATION
           : kind == StreamKind::Force      ? TSB_KIND_FORCE
                                            : TSB_KIND_TAXELS;
}

tsb_unit unitOf(const StreamInfo& info) noexcept {
    if (info.unit == StreamUnit::Count) return TSB_UNIT_COUNT;
    return static_cast<tsb_unit>(static_cast<int>(kindOf(info.kind)) + TSB_UNIT_METRE_PER_SECOND_SQUARED);
}

double stepOf(const StreamInfo& info) noexcept {
    return info.unit == StreamUnit::Count ? 1 : FirmwareBoard::kSteps[kindOf(info.kind)];
}

}  // namespace

class FirmwareBoard::Line final : public Transport {
public:
    explicit Line(std::shared_ptr<FirmwareBoard> board) : board_(std::move(board)) {}

    Result<void> write(std::span<const std::uint8_t> bytes, Seconds /*timeout*/) override {
        board_->hear(bytes);
        return {};
    }
    void writeUrgent(std::span<const std::uint8_t> bytes) noexcept override { board_->hear(bytes); }

    Result<std::size_t> read(std::span<std::uint8_t> into, Seconds timeout) override {
        const Instant until = board_->clock_.now() + toInstant(timeout);
        for (;;) {
            const auto taken = board_->say(into);
            if (!taken || *taken > 0) return taken;
            if (board_->clock_.isVirtual() || board_->clock_.now() >= until)
                return fail(ErrorCode::Timeout, "the board says nothing");
            std::this_thread::sleep_for(kLookEvery);
        }
    }
    std::uint64_t dropped() const noexcept override { return 0; }  // the board waits, and counts what it drops

private:
    const std::shared_ptr<FirmwareBoard> board_;
};

Result<std::shared_ptr<FirmwareBoard>> FirmwareBoard::make(std::unique_ptr<TactileSensor> sensors, std::string serial,
                                                           std::string firmware, const Clock& clock, double drift_ppm) {
    std::shared_ptr<FirmwareBoard> board(
        new FirmwareBoard(std::move(sensors), std::move(serial), std::move(firmware), clock, drift_ppm));
    if (!board->describe())
        return fail(ErrorCode::Unsupported, "no sensor board has the streams of {}", board->sensors_->identity().name);
    return board;
}

FirmwareBoard::FirmwareBoard(std::unique_ptr<TactileSensor> sensors, std::string serial, std::string firmware,
                             const Clock& clock, double drift_ppm)
    : sensors_(std::move(sensors)),
      serial_(std::move(serial)),
      firmware_(std::move(firmware)),
      clock_(clock),
      rate_(1 + drift_ppm * 1e-6),
      waiting_(sensors_->streams().size()),
      blocks_(sensors_->streams().size()) {
    hardware_.context = this;
    hardware_.now_us = [](void* self) { return static_cast<FirmwareBoard*>(self)->now_us_; };
    hardware_.read = [](void* self, tb_samples* into) {
        return static_cast<FirmwareBoard*>(self)->next(*into) ? 1 : 0;
    };
    hardware_.hear = [](void* self, std::uint8_t* bytes, std::size_t most) {
        auto& from = static_cast<FirmwareBoard*>(self)->toBoard_;
        const auto count = std::min(most, from.size());
        std::copy_n(from.begin(), count, bytes);
        from.erase(from.begin(), from.begin() + static_cast<std::ptrdiff_t>(count));
        return count;
    };
    hardware_.say = [](void* self, const std::uint8_t* frame, std::size_t size) {
        auto& to = static_cast<FirmwareBoard*>(self)->toHost_;
        if (to.size() + size > kLineBytes) return 0;
        to.insert(to.end(), frame, frame + size);
        return 1;
    };
}

/// Says what the board is; false if none can be so.
bool FirmwareBoard::describe() {
    const auto streams = sensors_->streams();
    if (streams.size() > TB_STREAMS) return false;
    setup_.name = "simulated sensor board";
    setup_.serial = serial_.c_str();
    setup_.firmware = firmware_.c_str();
    setup_.streams = static_cast<std::uint8_t>(streams.size());
    for (std::size_t s = 0; s < streams.size(); ++s) {
        const auto& info = streams[s];
        if (info.channels == 0 || info.channels > TSB_COLUMNS_MOST) return false;
        auto& c = setup_.configuration[s];
        c.stream = static_cast<std::uint8_t>(s);
        c.flags = TSB_STREAM_ENABLED;
        c.kind = static_cast<std::uint8_t>(kindOf(info.kind));
        c.unit = static_cast<std::uint8_t>(unitOf(info));
        c.format = TSB_FORMAT_INT32;
        c.columns = static_cast<std::uint8_t>(info.channels);
        c.rate_mhz = static_cast<std::uint32_t>(std::llround(info.rate_hz * 1000));
        std::fill_n(c.scale, info.channels, static_cast<float>(stepOf(info)));
        setup_.calibration[s].date = "";
        setup_.calibration[s].reference = "";
        waiting_[s].block = static_cast<std::uint8_t>(
            std::clamp<double>(info.rate_hz * kBlock_s, 1, tsb_block_most(c.columns, TSB_FORMAT_INT32)));
    }
    return tb_init(board_.get(), &setup_, &hardware_) != 0;
}

void FirmwareBoard::restart(const te_profile* profile, bool rested) {
    const std::scoped_lock lock(mutex_);
    if (profile != nullptr) profile_ = *profile;
    setup_.profile = profile != nullptr ? &profile_ : nullptr;
    setup_.rested = rested ? 1 : 0;
    powered_s_ = toSeconds(clock_.now());
    now_us_ = 0;
    toBoard_.clear();
    toHost_.clear();
    for (auto& stream : waiting_) {
        stream.samples.clear();
        stream.first_s.reset();
        stream.next = 0;
    }
    static_cast<void>(tb_init(board_.get(), &setup_, &hardware_));  // describe() has seen that it can be
}

std::unique_ptr<Transport> FirmwareBoard::line() { return std::make_unique<Line>(shared_from_this()); }

double FirmwareBoard::boardTime_us(double session_s) const noexcept { return (session_s - powered_s_) * rate_ * 1e6; }

void FirmwareBoard::hear(std::span<const std::uint8_t> bytes) noexcept {
    const std::scoped_lock lock(mutex_);
    toBoard_.insert(toBoard_.end(), bytes.begin(), bytes.end());
}

Result<std::size_t> FirmwareBoard::say(std::span<std::uint8_t> into) {
    const std::scoped_lock lock(mutex_);
    if (const auto ran = run(); !ran) return failure(ran);
    const auto count = std::min(into.size(), toHost_.size());
    std::copy_n(toHost_.begin(), count, into.begin());
    toHost_.erase(toHost_.begin(), toHost_.begin() + static_cast<std::ptrdiff_t>(count));
    return count;
}

/// Lets the board go on up to now.
Result<void> FirmwareBoard::run() {
    if (auto fetched = fetch(); !fetched) return fetched;
    const double now = std::max(0.0, boardTime_us(toSeconds(clock_.now())));
    while (now_us_ + kStep_us <= static_cast<std::uint64_t>(now)) {
        now_us_ += kStep_us;
        step();
    }
    while (!toBoard_.empty()) step();
    return {};
}

void FirmwareBoard::step() { tb_step(board_.get()); }

/// Takes what the sensors have made up to now.
Result<void> FirmwareBoard::fetch() {
    for (auto& block : blocks_) block.clear();
    if (auto read = sensors_->read(blocks_); !read) return read;
    const auto streams = sensors_->streams();
    for (std::size_t s = 0; s < blocks_.size(); ++s) {
        const auto channels = streams[s].channels;
        const double step = stepOf(streams[s]);
        for (std::size_t i = 0; i < blocks_[s].samples(); ++i) {
            const double at = boardTime_us(blocks_[s].t_s[i]);
            if (!(at >= 0)) continue;
            Waiting::Sample sample{};
            sample.at_us = static_cast<std::uint64_t>(std::llround(at));
            if (!waiting_[s].first_s) waiting_[s].first_s = blocks_[s].t_s[i];
            const double since_s = blocks_[s].t_s[i] - *waiting_[s].first_s;
            sample.number = static_cast<std::uint64_t>(std::llround(since_s * streams[s].rate_hz));
            bool sound = true;
            for (std::size_t c = 0; c < channels; ++c) {
                const double raw = std::round(blocks_[s].values[i * channels + c] / step);
                sound = sound && std::abs(raw) <= INT32_MAX;
                if (sound) sample.raw[c] = static_cast<std::int32_t>(raw);
            }
            if (sound) waiting_[s].samples.push_back(sample);
        }
    }
    return {};
}

bool FirmwareBoard::next(tb_samples& into) {
    for (std::size_t s = 0; s < waiting_.size(); ++s)
        if (cut(s, into)) return true;
    return false;
}

/// Cuts the oldest block of a stream: one that is full, or that a gap ends, or that waits for too long.
bool FirmwareBoard::cut(std::size_t stream, tb_samples& into) {
    auto& samples = waiting_[stream].samples;
    auto& next = waiting_[stream].next;
    const std::size_t block = waiting_[stream].block;
    const auto& info = sensors_->streams()[stream];
    std::size_t count = 0;
    bool ended = false;
    for (; count < std::min(samples.size(), block) && samples[count].at_us <= now_us_; ++count) {
        ended = count > 0 && samples[count].number != samples[count - 1].number + 1;
        if (ended) break;
    }
    if (count == 0 || (count < block && !ended && samples.front().at_us + kLate_us > now_us_)) return false;
    const auto& first = samples.front();
    into.stream = static_cast<std::uint8_t>(stream);
    into.count = static_cast<std::uint8_t>(count);
    into.lost = next > 0 && first.number > next ? static_cast<std::uint32_t>(first.number - next) : 0;
    into.first_us = first.at_us;
    into.interval_ns = static_cast<std::uint32_t>(std::llround(1e9 * rate_ / info.rate_hz));
    next = samples[count - 1].number + 1;
    for (std::size_t i = 0; i < count; ++i)
        std::copy_n(samples[i].raw.begin(), info.channels, into.raw + i * info.channels);
    samples.erase(samples.begin(), samples.begin() + static_cast<std::ptrdiff_t>(count));
    return true;
}

}  // namespace tacto::sensorboard
