// A whole board whatever it hears and feels, and whenever it is stopped: no fault of memory or arithmetic; no train
// beyond profile and ceilings (hazard H1); none after a stop, nor by the board itself once a host has spoken (H2); none
// while a sensor is silent (H7); and what it says is sound.
//
//     bits of the setup, changes of it, then events: a kind (bits 0 to 2) with flags (bits 3 to 7), and what it needs
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <deque>
#include <memory>

#include "drivers/sensor_board/EncoderProfile.h"
#include "drivers/sensor_board/Messages.h"
#include "resources/firmware/tactile_board/tactile_board.h"
#include "resources/firmware/tactile_board/tactile_pulses.h"
#include "tests/fuzz/FuzzTarget.h"

namespace tacto::fuzz::BoardFuzz {

namespace {

using namespace tacto::sensorboard;
using tacto::sensorboard::Command;

constexpr double kLowest_ohm = 800, kTicksPerUs = 25;
constexpr std::uint64_t kRound_us = 10'000;

class Input {
public:
    Input(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}
    [[nodiscard]] bool over() const { return size_ == 0; }
    template <class Value>
    Value take() {
        Value value{};
        const std::size_t used = std::min(sizeof value, size_);
        std::memcpy(&value, data_, used);
        data_ += used;
        size_ -= used;
        return value;
    }

private:
    const std::uint8_t* data_;
    std::size_t size_;
};

const te_profile& sound() {
    static const te_profile profile = [] {
        const std::vector<StreamInfo> streams{
            {StreamKind::Acceleration, StreamUnit::MetrePerSecondSquared, 1, 500, "acceleration"},
            {StreamKind::Force, StreamUnit::Newton, 1, 100, "force"},
            {StreamKind::Taxels, StreamUnit::Pascal, 4, 100, "taxels"}};
        EncoderOutput output;
        output.source.amplitudeMax = 60;
        output.load = LoadRange::declared(Load::resistor(Ohms(1000)));
        output.ceilings.push_back({Quantity::RmsCurrent5s, 2.0F});
        return encoderProfile(streams, {}, {}, output).value();
    }();
    return profile;
}

class Board {
public:
    explicit Board(Input& in) {
        const auto bits = in.take<std::uint8_t>();
        setup_.name = setup_.serial = setup_.firmware = "fuzz";
        setup_.streams = 3;
        configure(0, TSB_KIND_ACCELERATION, TSB_UNIT_METRE_PER_SECOND_SQUARED, 1, 500'000, 0.005F);
        configure(1, TSB_KIND_FORCE, TSB_UNIT_NEWTON, 1, 100'000, 0.001F);
        configure(2, TSB_KIND_TAXELS, TSB_UNIT_PASCAL, 4, 100'000, 2);
        if ((bits & 4U) != 0) std::fill_n(setup_.range, TB_STREAMS, tb_range{-4087, 4087});
        for (int changes = bits >> 5U; changes > 0; --changes) change(in);
        setup_.profile = (bits & 8U) != 0 ? nullptr : &sound();
        setup_.alone = bits & 1U;
        setup_.rested = (bits & 2U) != 0;
        hardware_.context = this;
        hardware_.now_us = [](void* self) { return of(self).interrupted().now_us_; };
        hardware_.read = [](void* self, tb_samples* into) { return of(self).interrupted().read(into); };
        hardware_.hear = [](void* self, std::uint8_t* bytes, std::size_t most) {
            return of(self).interrupted().hear(bytes, most);
        };
        hardware_.say = [](void* self, const std::uint8_t* frame, std::size_t size) {
            return of(self).say(std::span(frame, size));
        };
        hardware_.play = [](void* self, const te_train* train) { return of(self).play(train); };
        if ((bits & 16U) != 0) hardware_.play = nullptr;
        is_ = tb_init(board_.get(), &setup_, &hardware_) != 0;
    }

    [[nodiscard]] bool is() const { return is_; }

    void event(Input& in) {
        const auto kind = in.take<std::uint8_t>();
        const unsigned flags = kind >> 3U;
        switch (kind & 7U) {
            case 0:
                deaf_ = (flags & 1U) != 0;
                plays_ = (flags & 2U) == 0;
                now_us_ += in.take<std::uint16_t>() * ((flags & 4U) != 0 ? 1000U : 10U);
                break;
            case 1:
                for (int i = in.take<std::uint8_t>() % 64; i > 0; --i) toBoard_.push_back(in.take<std::uint8_t>());
                break;
            case 2:
                command(in);
                break;
            case 3:
                inject(in, flags);
                break;
            case 4:
                if (flags == 0) stop();
                stopIn_ = flags;  // calls of the board's functions, as an interrupt would
                break;
            default:
                // Most of an input: a finger that rests or slides, one of whose sensors may fail.
                for (int rounds = in.take<std::uint8_t>(); rounds > 0 && rounds_ < kMaxRounds; --rounds, ++rounds_)
                    round(flags);
                return;
        }
        step();
    }

private:
    static constexpr int kMaxRounds = 1500;

    static Board& of(void* self) { return *static_cast<Board*>(self); }
    void configure(std::uint8_t stream, std::uint8_t kind, std::uint8_t unit, std::uint8_t columns, std::uint32_t mHz,
                   float scale) {
        auto& c = setup_.configuration[stream];
        c = {stream, TSB_STREAM_ENABLED, kind, unit, TSB_FORMAT_INT16, columns, mHz, {}, {}};
        std::fill_n(c.scale, columns, scale);
        setup_.calibration[stream] = {stream, 0, columns, "", "", {}};
    }
    void change(Input& in) {
        auto& c = setup_.configuration[in.take<std::uint8_t>() % TB_STREAMS];
        const auto what = in.take<std::uint8_t>();
        const auto value = in.take<std::uint32_t>();
        const auto byte = static_cast<std::uint8_t>(value);
        switch (what % 8) {
            case 0:
                c.kind = byte;
                break;
            case 1:
                c.unit = byte;
                break;
            case 2:
                c.format = byte;
                break;
            case 3:
                c.columns = byte;
                break;
            case 4:
                c.rate_mhz = value;
                break;
            case 5:
                std::memcpy(&c.scale[what / 8 % TSB_COLUMNS_MOST], &value, sizeof value);
                break;
            case 6:
                setup_.range[c.stream % TB_STREAMS].low = static_cast<std::int32_t>(value);
                break;
            default:
                c.flags = byte;
                break;
        }
    }

    /// Where a stop may come: between any two calls of the board's functions.
    Board& interrupted() {
        if (stopIn_ > 0 && --stopIn_ == 0) stop();
        return *this;
    }
    void stop() {
        tb_stop(board_.get());
        stopped_ = true;
        require(!loaded_);
    }
    void step() {
        tb_step(board_.get());
        require(!loaded_ || !(stopped_ || hostSpoke_));
    }

    void command(Input& in) {
        const auto type = static_cast<std::uint8_t>(in.take<std::uint8_t>() % 12);
        std::vector<std::uint8_t> payload;
        if (type == TSB_SET_CONFIGURATION) {
            const auto stream = in.take<std::uint8_t>() % TB_STREAMS;
            const auto& c = setup_.configuration[stream];
            StreamConfiguration wanted{static_cast<std::uint8_t>(stream),
                                       true,
                                       StreamKind::Acceleration,
                                       StreamUnit::Count,
                                       SampleFormat::Int16,
                                       c.rate_mhz,
                                       {}};
            for (int i = 0; i < c.columns; ++i) wanted.columns.push_back({double{c.scale[i]}, double{c.offset[i]}});
            payload = configurationPayload(wanted);
            payload[2] = c.kind;
            payload[3] = c.unit;
            payload[4] = c.format;
            const auto at = in.take<std::uint8_t>();
            const auto value = in.take<std::uint8_t>();
            payload[at % payload.size()] ^= value;
        } else {
            for (int i = in.take<std::uint8_t>() % 4; i > 0; --i) payload.push_back(in.take<std::uint8_t>());
        }
        const auto bytes = encodeCommand(static_cast<Command>(type), 7, payload);
        toBoard_.insert(toBoard_.end(), bytes.begin(), bytes.end());
    }
    void inject(Input& in, unsigned flags) {
        constexpr std::array kExtremes{0,       1,         4095,      -4096,         32'767,
                                       -32'768, INT32_MAX, INT32_MIN, INT32_MIN + 1, 16'777'217};
        tb_samples made{};
        made.stream = in.take<std::uint8_t>() % 4;
        made.count = in.take<std::uint8_t>();
        made.lost = (flags & 1U) != 0 ? in.take<std::uint32_t>() : 0;
        made.first_us = (flags & 2U) != 0 ? in.take<std::uint64_t>() : now_us_;
        made.interval_ns = (flags & 4U) != 0 ? in.take<std::uint32_t>() : 2'000'000;
        for (auto& value : made.raw) {
            if (in.over()) break;
            const auto code = in.take<std::uint8_t>();
            value = (flags & 8U) != 0 ? kExtremes[code % kExtremes.size()] : (code - 128) * 16;
        }
        felt_.push_back(made);
        if ((flags & 16U) != 0) felt_.push_back(made);
    }

    [[nodiscard]] std::int32_t noise(std::int32_t most) {
        chance_ = chance_ * 1664525U + 1013904223U;
        return static_cast<std::int32_t>(chance_ >> 16U) % (2 * most + 1) - most;
    }
    /// 10 ms. `flags`: bit 0: touched; bits 1 and 2: the stream that fails, or none; bits 3 and 4: how.
    void round(unsigned flags) {
        const bool touched = (flags & 1U) != 0;
        now_us_ += kRound_us / 2;
        step();
        now_us_ += kRound_us / 2;
        for (std::uint8_t s = 0; s < 3; ++s) {
            const bool fails = ((flags >> 1U) & 3U) == s + 1U;
            const auto& c = setup_.configuration[s];
            tb_samples made{};
            made.stream = s;
            made.count = s == 0 ? 5 : 1;
            made.interval_ns = s == 0 ? 2'000'000 : 10'000'000;
            made.first_us = now_us_ - (made.count - 1U) * 2000U;
            const int values = std::min<int>(made.count * c.columns, TB_VALUES);
            for (int i = 0; i < values; ++i)
                made.raw[i] = s == 0   ? noise(touched ? 400 : 6)
                              : s == 1 ? noise(4) + (touched ? 1500 : 0)
                                       : 250 + noise(5) + (touched ? 1500 + 150 * i : 0);
            if (fails && flags >> 3U == 0) continue;
            if (fails && flags >> 3U == 1) felt_.push_back(made);
            if (fails && flags >> 3U == 2) std::fill_n(made.raw, values, held_[s]);
            if (fails && flags >> 3U == 3) std::for_each_n(made.raw, values, [&](auto& raw) { raw = 4095 - noise(1); });
            held_[s] = made.raw[0];
            felt_.push_back(made);
        }
        step();
    }

    int read(tb_samples* into) {
        if (felt_.empty()) return 0;
        *into = felt_.front();
        felt_.pop_front();
        const auto newest_us = into->first_us + std::uint64_t{into->count} * into->interval_ns / 1000;
        if (into->stream < TB_STREAMS) newest_us_[into->stream] = std::max(newest_us_[into->stream], newest_us);
        return 1;
    }
    std::size_t hear(std::uint8_t* bytes, std::size_t most) {
        const auto count = std::min(most, toBoard_.size());
        std::copy_n(toBoard_.begin(), count, bytes);
        toBoard_.erase(toBoard_.begin(), toBoard_.begin() + static_cast<std::ptrdiff_t>(count));
        return count;
    }

    int say(std::span<const std::uint8_t> frame) {
        require(frame.size() <= TSB_FRAME_MOST);
        const auto said = decoder_.take(frame);
        require(said && frame.empty() && decoder_.counts().bad() == 0);
        if (said->is(Reply::Data)) {
            require(running_ && readBlock(*said).has_value());
        } else if (said->is(Reply::Reading)) {
            require(running_ && mode_ && readReading(*said).has_value());
        } else if (said->is(Reply::Silent)) {
            require(running_ && mode_ && readSilence(*said).has_value());
        } else if (said->is(Reply::Train)) {
            const auto train = readTrain(*said);
            require(running_ && mode_ && !stopped_ && train.has_value());
            judge(train->amplitude, train->interval_s, static_cast<double>(train->onset_us) * 1e-6);
            require(train->width_us == double{sound().width_us} && train->pulses == sound().pulses);
        } else if (!said->is(Reply::Status) || tokenOf(*said) != 0) {
            answered(*said);
        }
        interrupted();
        return deaf_ ? 0 : 1;
    }
    void answered(const Frame& said) {
        hostSpoke_ = true;
        require(!loaded_);
        if (said.is(Reply::Encoder)) mode_ = readEncoder(said).value().encodes;
        if (said.is(Reply::Status)) require(readStatus(said).value().running == running_);
        if (!said.is(Reply::Done)) return;
        running_ = said.payload[1] == TSB_START;
        // What stops it while it starts stands.
        if (running_) stopped_ = board_->stopped != 0;
        if (running_) newest_us_ = {};
    }

    int play(const te_train* train) {
        if (train == nullptr) {
            loaded_ = false;
            return 1;
        }
        require(!stopped_ && !hostSpoke_ && setup_.alone != 0);
        require(train->width_us == sound().width_us && train->pulses == sound().pulses);
        judge(double{train->amplitude}, double{train->interval_s}, static_cast<double>(train->onset_ns) * 1e-9);
        tp_pulses pulses{};
        require(tp_begin(&pulses, train, static_cast<float>(kTicksPerUs)) != 0);
        std::uint64_t all = 0;
        std::uint32_t ticks = 0;
        for (float level = 0; tp_next(&pulses, &level, &ticks) != 0; all += ticks)
            require(std::abs(level) <= sound().amplitude_max_v);
        require(static_cast<double>(all) <= double{TE_MAX_TRAIN_S} * 1e6 * kTicksPerUs);
        loaded_ = true;
        interrupted();
        return plays_ ? 1 : 0;
    }
    void judge(double amplitude, double interval_s, double onset_s) {
        const auto& profile = sound();
        require(amplitude >= double{profile.amplitude_min_v} * 0.899 && amplitude <= double{profile.amplitude_max_v});
        require(interval_s >= double{profile.interval_min_s} && interval_s <= double{profile.interval_max_s});
        require(onset_s >= static_cast<double>(now_us_) * 1e-6 - 1e-6);
        require(onset_s <= static_cast<double>(now_us_) * 1e-6 + 5e-3);
        require(onset_s - onset_s_ >= double{profile.interval_min_s} * 0.9999);
        onset_s_ = onset_s;
        for (const auto newest_us : newest_us_) require(now_us_ <= newest_us + 100'000);
        const double amps = amplitude / kLowest_ohm;
        const double width_s = 2 * double{profile.width_us} * 1e-6 * profile.pulses;
        delivered_.emplace_back(onset_s, amps * amps * width_s);
        double sum = 0;
        for (const auto& [at_s, square] : delivered_) sum += at_s > onset_s - 5 ? square : 0;
        require(std::sqrt(sum / 5) <= 2e-3);
    }

    tb_setup setup_{};
    tb_hardware hardware_{};
    std::unique_ptr<tb_board> board_ = std::make_unique<tb_board>();
    bool is_ = false;
    std::uint64_t now_us_ = 0;
    std::deque<std::uint8_t> toBoard_;
    std::deque<tb_samples> felt_;
    FrameDecoder decoder_;
    std::array<std::uint64_t, TB_STREAMS> newest_us_{};
    std::array<std::int32_t, TB_STREAMS> held_{};
    std::vector<std::pair<double, double>> delivered_;  // onset in s, A2 s
    double onset_s_ = -1e9;
    std::uint32_t chance_ = 1;
    unsigned stopIn_ = 0;
    int rounds_ = 0;
    bool deaf_ = false, plays_ = true;
    bool loaded_ = false;  // a timer has a train
    bool stopped_ = false, hostSpoke_ = false, running_ = false, mode_ = false;
};

}  // namespace

TACTO_FUZZ(BoardFuzz, const std::uint8_t* data, std::size_t size) {
    Input in(data, size);
    Board board(in);
    while (board.is() && !in.over()) board.event(in);
    return 0;
}

}  // namespace tacto::fuzz::BoardFuzz
