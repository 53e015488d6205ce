// Whatever befalls a board's sensors and clock, what its timer plays is never longer, stronger or denser than the
// profile and the ceilings allow: judged by the edges themselves, into the smallest load, on a clock that is true
// (hazards H1, H7). A reading that is not a number cannot come out of a converter; HealthTest gives it to the encoder.
#include <algorithm>
#include <cmath>
#include <deque>
#include <gtest/gtest.h>
#include <iostream>
#include <memory>

#include "core/base/Random.h"
#include "drivers/sensor_board/EncoderProfile.h"
#include "resources/firmware/tactile_board/tactile_board.h"
#include "resources/firmware/tactile_board/tactile_pulses.h"

namespace tacto::test {
namespace {

constexpr double kLoad_ohm = 1000, kLowest_ohm = 800;
constexpr float kTicksPerUs = 25;
constexpr std::uint64_t kRound_us = 10'000;
constexpr std::int32_t kEnd = 8191;  // of the converters

enum class Flaw { Dropped, Doubled, Shifted, Stuck, Saturated, Pulled, Late, Jumping, None };

/// One flaw of one sensor, or of the clock, for a while.
struct Spell {
    Flaw flaw = Flaw::None;
    std::uint8_t stream = 0;
    int column = 0;  // of a stream that is pulled out; one that it does not have: all
    std::uint64_t begin_us = 0, end_us = 0;
};

class BadBoard {
public:
    explicit BadBoard(Random& random) : random_(random), drift_(1 + 0.1 * (random.uniform() - 0.5)) {
        const std::vector<StreamInfo> streams{
            {StreamKind::Acceleration, StreamUnit::MetrePerSecondSquared, 2, 1000, "acceleration"},
            {StreamKind::Force, StreamUnit::Newton, 1, 100, "force"},
            {StreamKind::Taxels, StreamUnit::Pascal, 4, 100, "taxels"}};
        EncoderOutput output;  // whose accuracy is not stated: ± 5 %
        output.source.amplitudeMax = 100;
        output.load = LoadRange::declared(Load::resistor(Ohms(kLoad_ohm)));
        rms_mA_ = 0.3 + 4 * random.uniform();
        output.ceilings.push_back({Quantity::RmsCurrent5s, static_cast<float>(rms_mA_)});
        profile_ = encoderProfile(streams, {}, {}, output).value();
        setup_.name = setup_.serial = setup_.firmware = "campaign";
        setup_.streams = 3;
        configure(0, TSB_KIND_ACCELERATION, TSB_UNIT_METRE_PER_SECOND_SQUARED, 2, 1'000'000, 0.005F);
        configure(1, TSB_KIND_FORCE, TSB_UNIT_NEWTON, 1, 100'000, 0.001F);
        configure(2, TSB_KIND_TAXELS, TSB_UNIT_PASCAL, 4, 100'000, 2);
        std::fill_n(setup_.range, 3, tb_range{-kEnd + 8, kEnd - 8});
        setup_.profile = &profile_;
        setup_.alone = 1;
        setup_.rested = 1;
        hardware_.context = this;
        hardware_.now_us = [](void* self) { return of(self).now_us_; };
        hardware_.read = [](void* self, tb_samples* into) { return of(self).next(into); };
        hardware_.hear = [](void*, std::uint8_t*, std::size_t) { return std::size_t{0}; };
        hardware_.say = [](void*, const std::uint8_t*, std::size_t) { return 1; };
        hardware_.play = [](void* self, const te_train* train) { return of(self).play(train); };
        EXPECT_EQ(tb_init(board_.get(), &setup_, &hardware_), 1);
    }

    void run(std::uint64_t us) {
        for (const auto end = now_us_ + us; now_us_ < end;) {
            now_us_ += 1000;
            if (now_us_ >= spell_.end_us) draw();
            if (now_us_ % kRound_us == 0) feel();
            tb_step(board_.get());
        }
    }

    std::uint64_t trains = 0;
    [[nodiscard]] std::uint64_t refusedByItself() const { return board_->encoder.trains_refused; }

private:
    struct Delivered {
        double end_s, square;  // A2 s
    };

    static BadBoard& of(void* self) { return *static_cast<BadBoard*>(self); }
    void configure(std::uint8_t stream, std::uint8_t kind, std::uint8_t unit, std::uint8_t columns, std::uint32_t mHz,
                   float scale) {
        auto& c = setup_.configuration[stream];
        c = {stream, TSB_STREAM_ENABLED, kind, unit, TSB_FORMAT_INT16, columns, mHz, {}, {}};
        std::fill_n(c.scale, columns, scale);
    }
    void draw() {
        spell_.flaw = random_.below(3) == 0 ? Flaw::None : static_cast<Flaw>(random_.below(8));
        spell_.stream = static_cast<std::uint8_t>(random_.below(3));
        spell_.column = static_cast<int>(random_.below(5));
        spell_.begin_us = now_us_;
        spell_.end_us = now_us_ + 50'000 + random_.below(3'000'000);
        if (spell_.flaw == Flaw::Jumping) now_us_ += random_.below(400'000) / 1000 * 1000;
    }
    [[nodiscard]] std::int32_t noise(double size) {
        return static_cast<std::int32_t>(std::lround(size * random_.normal()));
    }
    void feel() {
        const bool touches = now_us_ % 4'000'000 > 700'000;
        give(0, 10, 1000, [&](int) { return noise(touches ? 200 : 4); });
        give(1, 1, 10'000, [&](int) { return noise(2) + (touches ? 1500 : 0); });
        give(2, 1, 10'000, [&](int i) { return 250 + noise(3) + (touches ? 1500 + 150 * i : 0); });
    }
    template <class Value>
    void give(std::uint8_t stream, std::uint8_t count, std::uint32_t interval_us, Value value) {
        tb_samples made{};
        made.stream = stream;
        made.count = count;
        made.first_us = now_us_ - std::min<std::uint64_t>(now_us_, (count - 1U) * interval_us);
        made.interval_ns = interval_us * 1000;
        const int values = count * setup_.configuration[stream].columns;
        for (int i = 0; i < values; ++i) made.raw[i] = value(i);
        std::uint64_t due = now_us_;
        if (spell_.stream == stream) {
            switch (spell_.flaw) {
                case Flaw::Dropped:
                    return;
                case Flaw::Doubled:
                    waiting_.emplace_back(due, made);
                    break;
                case Flaw::Shifted:
                    made.first_us += random_.below(100'000);
                    made.first_us -= std::min<std::uint64_t>(made.first_us, 50'000);
                    break;
                case Flaw::Stuck:
                    if (held_[stream].count > 0) std::copy_n(held_[stream].raw, values, made.raw);
                    break;
                case Flaw::Saturated:
                    for (int i = 0; i < values; ++i) made.raw[i] = made.raw[i] < 0 ? -32'768 : 32'767;
                    break;
                case Flaw::Pulled:
                    for (int i = 0; i < values; ++i) {
                        const int columns = setup_.configuration[stream].columns;
                        if (i % columns == spell_.column || spell_.column >= columns)
                            made.raw[i] = kEnd - static_cast<std::int32_t>(random_.below(4));
                    }
                    break;
                case Flaw::Late:
                    due += 20'000 + random_.below(400'000);
                    break;
                default:
                    break;
            }
        }
        held_[stream] = made;
        waiting_.emplace_back(due, made);
    }
    int next(tb_samples* into) {
        const auto found = std::ranges::find_if(waiting_, [&](const auto& one) { return one.first <= now_us_; });
        if (found == waiting_.end()) return 0;
        *into = found->second;
        waiting_.erase(found);
        const int columns = setup_.configuration[into->stream].columns;
        bool sound = true;
        for (int column = 0; column < columns; ++column) {
            bool any = false;
            for (int i = column; i < into->count * columns; i += columns)
                any = any || std::abs(into->raw[i]) < kEnd - 7;
            auto& sound_us = sound_us_[into->stream][static_cast<std::size_t>(column)];
            if (any) sound_us = now_us_;
            sound = sound && now_us_ - sound_us <= 50'000;
        }
        if (!sound) return 1;
        auto& given_us = given_us_[into->stream];
        given_us = std::max(given_us, into->first_us + (into->count - 1U) * into->interval_ns / 1000);
        return 1;
    }

    /// A timer that plays the train; the referee looks at its edges.
    int play(const te_train* train) {
        if (train == nullptr) return 1;
        tp_pulses pulses{};
        EXPECT_EQ(tp_begin(&pulses, train, kTicksPerUs), 1);
        const double onset_s = static_cast<double>(train->onset_ns) * 1e-9 * drift_;
        double passed_s = 0, square = 0, charge = 0, worst = 0, peak = 0;
        std::uint32_t phases = 0, ticks = 0;
        for (float level = 0; tp_next(&pulses, &level, &ticks) != 0;) {
            const double length_s = ticks / (1e6 * double{kTicksPerUs}) * drift_;
            const double amps = std::abs(double{level}) / kLowest_ohm;
            passed_s += length_s;
            square += amps * amps * length_s;
            charge = amps * length_s;
            worst = std::max(worst, charge);
            peak = std::max(peak, amps);
            phases += level != 0 ? 1 : 0;
        }
        const std::uint32_t perPulse = profile_.shape == TE_MONOPHASIC ? 1 : 2;
        EXPECT_LE(phases, profile_.pulses * perPulse) << "longer than the profile";
        EXPECT_LE(passed_s, std::min(0.5, profile_.pulses / double{profile_.pulse_hz}) * 1.0501);
        EXPECT_LE(peak, double{profile_.amplitude_max_v} / kLowest_ohm * (1 + 1e-6)) << "stronger than the profile";
        EXPECT_LE(peak, 0.1);
        EXPECT_LE(worst, 20e-6);
        EXPECT_GE(onset_s, lastEnd_s_ - 1e-6) << "two at once";
        EXPECT_GE(onset_s - lastOnset_s_, double{profile_.interval_min_s} * 0.9499) << "denser than the profile";
        lastOnset_s_ = onset_s;
        lastEnd_s_ = onset_s + passed_s;
        delivered_.push_back({lastEnd_s_, square});
        double sum = 0;
        for (const auto& one : delivered_) sum += one.end_s > lastEnd_s_ - 5 ? one.square : 0;
        EXPECT_LT(std::sqrt(sum / 5) * 1e3, rms_mA_) << "more than the ceiling over 5 s";
        // Silence: no stream is older than 0.1 s, and 10 ms for a block and a step. One that was pulled out for 50 ms
        // gives nothing.
        for (const auto at_us : given_us_)
            EXPECT_LE(static_cast<double>(now_us_) - static_cast<double>(at_us), 110'000)
                << "of a stream that is silent";
        ++trains;
        return 1;
    }

    Random& random_;
    const double drift_;  // seconds of the board's clock in a true one: ± 5 %
    double rms_mA_ = 0;
    te_profile profile_{};
    tb_setup setup_{};
    tb_hardware hardware_{};
    std::unique_ptr<tb_board> board_ = std::make_unique<tb_board>();
    std::uint64_t now_us_ = 0;
    Spell spell_;
    std::deque<std::pair<std::uint64_t, tb_samples>> waiting_;
    std::array<tb_samples, 3> held_{};
    std::array<std::uint64_t, 3> given_us_{};
    std::array<std::array<std::uint64_t, 4>, 3> sound_us_{};
    std::vector<Delivered> delivered_;
    double lastOnset_s_ = -1e9, lastEnd_s_ = -1e9;
};

}  // namespace

TEST(FaultCampaign, NothingMakesATrainLongerStrongerOrDenser) {
    RecordProperty("hazard", "H1");
    std::uint64_t trains = 0, refused = 0, drawn = 0;
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        Random random(seed, "fault campaign");
        BadBoard board(random);
        board.run(60'000'000);
        trains += board.trains;
        refused += board.refusedByItself();
        drawn += board.trains > 0 ? 1 : 0;
        if (testing::Test::HasFailure()) break;
    }
    std::cout << trains << " trains, " << refused << " refused by the board's gate\n";
    EXPECT_GE(trains, 500U);
    EXPECT_GE(refused, 50U);
    EXPECT_GE(drawn, 30U);
}

}  // namespace tacto::test
