// The board's encoder refuses whatever the bench's gate refuses, and nothing that it lets out exceeds a limit in a body
// that is computed independently.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <iostream>
#include <limits>
#include <memory>
#include <numbers>
#include <random>
#include <zlib.h>

#include "core/base/Csv.h"
#include "core/base/Statistics.h"
#include "core/safety/SafetyGate.h"
#include "drivers/sensor_board/EncoderProfile.h"
#include "resources/firmware/tactile_encoder/te_parts.h"
#include "tests/safety/Dice.h"
#include "tests/safety/IndependentBody.h"
#include "tests/support/Limits.h"
#include "tests/support/Support.h"
#include "tests/support/Trials.h"

namespace tacto::test {
namespace {

constexpr double kSlack = 1 + 2e-5;  // single precision, and the referee's quadrature
constexpr double kRms_A = 0.010, kPeak_A = 0.100, kCharge_C = 20e-6;

const std::vector<StreamInfo> kStreams{{StreamKind::Acceleration, StreamUnit::MetrePerSecondSquared, 1, 500, "a"},
                                       {StreamKind::Force, StreamUnit::Newton, 1, 100, "force"},
                                       {StreamKind::Taxels, StreamUnit::Pascal, 2, 100, "taxels"}};

/// The board's ring of bookings and the bench's gate, on one clock and set up alike, and a body that takes the trains.
class Rig {
public:
    explicit Rig(Dice& dice, EncodingProfile encoding = {}) : dice_(dice), gate_(clock_) {
        clock_.advanceTo(std::chrono::hours(1));
        output_.source.drive = dice.chance(0.5) ? Drive::Current : Drive::Voltage;
        output_.source.amplitudeMax = 1000;
        output_.source.amplitudeStep = dice.chance(0.3) ? 0 : single(dice.decade(0.001, 1));
        output_.source.widthStep = Micros(kWidthSteps_us[dice.pick(4)]);
        output_.source.widthMin = output_.source.widthStep * static_cast<double>(1 + dice.pick(2));
        encoding.train.phaseWidth = Micros(onGrid_us(encoding.train.phaseWidth.count()));
        output_.source.compliance = Volts(dice.chance(0.3) ? 60 : 1000);
        const auto error = [&] { return Spread{static_cast<float>(dice.chance(0.3) ? 0 : dice.between(0, 0.06)), 0}; };
        const Spread width = error();
        output_.source.accuracy = {error(), width, width, error(), error()};
        output_.load = LoadRange::declared(Load::resistor(Ohms(static_cast<float>(dice.decade(60, 20'000)))));
        if (dice.chance(0.3)) output_.ceilings.push_back({Quantity::PeakCurrent, single(dice.decade(1, 100))});
        if (dice.chance(0.3)) output_.ceilings.push_back({Quantity::PhaseCharge, single(dice.decade(0.1, 20))});
        if (dice.chance(0.3)) output_.ceilings.push_back({Quantity::RmsCurrent5s, single(dice.decade(0.1, 10))});
        auto made = encoderProfile(kStreams, {}, encoding, output_);
        EXPECT_TRUE(made) << made.error().message;
        profile = *made;
        GateSetup setup;
        setup.source = output_.source;
        setup.load = output_.load;
        setup.limits = limitSets();
        setup.ceilings = output_.ceilings;
        const auto configured = gate_.configure(setup);
        EXPECT_TRUE(configured) << configured.error().message;
        atWorst_ = dice.chance(0.7);
        body_.fit({(output_.load.nominal.series * (atWorst_ ? 0.8 : dice.between(0.8, 1.2))).value(), 0, 0});
    }

    /// As the stimulator can play it: on its steps of width and amplitude.
    [[nodiscard]] te_train played(te_train train) const {
        const double step = output_.source.amplitudeStep;
        train.width_us = static_cast<float>(onGrid_us(double{train.width_us}));
        if (train.gap_us > 0) train.gap_us = static_cast<float>(onGrid_us(double{train.gap_us}));
        if (step > 0) train.amplitude = static_cast<float>(std::floor(double{train.amplitude} / step) * step);
        return train;
    }
    [[nodiscard]] std::int64_t now_ns() const { return clock_.now().count(); }
    void waitUntil(std::int64_t at_ns) { clock_.advanceTo(Instant(at_ns)); }

    /// The bench's word on a train that the board let out, and the referee's.
    void judge(const te_train& out) {
        const PulseTrain train = trainOf(out);
        if (const double step = output_.source.amplitudeStep; step > 0)
            ASSERT_NEAR(std::remainder(double{out.amplitude} / step, 1), 0, 0.02) << "between two steps";
        const auto approved = gate_.approve({train, Seconds(double{out.interval_s}), clock_.now()});
        ASSERT_TRUE(approved) << "the bench's gate refuses what the board lets out: " << approved.error().message;
        const auto& accuracy = output_.source.accuracy;
        const auto worst = [&](double x, const std::optional<Spread>& spread) {
            return x * (1 + spread->relative * (atWorst_ ? 1 : dice_.between(-1, 1)));
        };
        PulseTrain delivered = withAmplitude(train, [&](double a) { return worst(a, accuracy.amplitude); });
        delivered.phaseWidth = Micros(worst(train.phaseWidth.count(), accuracy.phaseWidth));
        delivered.rate = Hertz(worst(train.rate.value(), accuracy.rate));
        // A clock that is fast brings trains closer.
        const double start = toSeconds(clock_.now()) * (1 - accuracy.interval->relative);
        const auto facts = body_.deliver(delivered, {}, start);
        ASSERT_LE(facts.peakI, kPeak_A * kSlack);
        ASSERT_LE(facts.phaseCharge, kCharge_C * kSlack);
        ASSERT_LE(out.command_v, 40);
        const double rms = std::sqrt(body_.worstI2(5) / 5);
        ASSERT_LT(rms, kRms_A * kSlack);
        if (rms > 0.95 * kRms_A) ++close;
        if (facts.peakI > 0.95 * 1e-3 * profile.ceiling_peak_ma) ++close;
        if (facts.phaseCharge > 0.95 * 1e-6 * profile.ceiling_charge_uc) ++close;
        if (out.command_v > 0.95 * 40) ++close;
        ++trains;
    }

    te_profile profile{};
    std::uint64_t trains = 0, close = 0;

private:
    static constexpr double kWidthSteps_us[] = {1, 2, 5, 10};
    [[nodiscard]] double onGrid_us(double us) const {
        const double step = output_.source.widthStep.count();
        return std::max(output_.source.widthMin.count(), std::round(us / step) * step);
    }
    static double single(double x) { return static_cast<float>(x); }
    [[nodiscard]] PulseTrain trainOf(const te_train& out) const {
        PulseTrain train;
        // The step as the bench has it, of which the board's is single.
        const double step = output_.source.amplitudeStep;
        const double level = step > 0 ? std::round(double{out.amplitude} / step) * step : double{out.amplitude};
        train.amplitude = profile.current_source != 0 ? Amplitude(Milliamps(level)) : Amplitude(Volts(level));
        train.shape = static_cast<PulseShape>(out.shape);
        train.polarity = out.negative != 0 ? Polarity::Negative : Polarity::Positive;
        train.phaseWidth = Micros(double{out.width_us});
        train.interPhaseGap = Micros(double{out.gap_us});
        train.rechargeRatio = double{out.recharge_ratio};
        train.pulses = static_cast<int>(out.pulses);
        train.rate = Hertz(double{out.pulse_hz});
        return train;
    }

    Dice& dice_;
    VirtualClock clock_;
    SafetyGate gate_;
    EncoderOutput output_;
    IndependentBody body_;
    bool atWorst_ = false;
};

te_train randomTrain(Dice& dice, const te_profile& profile, std::int64_t now_ns) {
    te_train train{};
    train.onset_ns = now_ns;
    train.shape = static_cast<std::uint32_t>(dice.pick(3));
    train.negative = dice.chance(0.5) ? 1 : 0;
    train.width_us = static_cast<float>(std::round(dice.decade(20, 1200)));
    train.gap_us = dice.chance(0.3) ? 0 : static_cast<float>(std::round(dice.between(0, 200)));
    train.recharge_ratio = static_cast<float>(std::round(dice.between(2, 10)));
    const bool dense = dice.chance(0.05);  // hardly a pause: only so the limit into 500 ohm is met first
    train.pulses = dense              ? 20 + static_cast<std::uint32_t>(dice.pick(200))
                   : dice.chance(0.5) ? 1
                                      : 1 + static_cast<std::uint32_t>(dice.pick(12));
    const double widths = train.shape == TE_ASYMMETRIC ? 1 + double{train.recharge_ratio} : 2;
    const double pulse_s = (widths * double{train.width_us} + double{train.gap_us}) * 1e-6;
    train.pulse_hz = static_cast<float>(1 / (pulse_s * (dense ? dice.between(1.15, 1.5) : dice.decade(1, 30))));
    const double shortest = train.pulses / double{train.pulse_hz};
    train.interval_s =
        static_cast<float>(std::max(shortest * dice.decade(1, dense ? 1.3 : 3), dice.decade(0.03, dense ? 0.1 : 3)));
    // About the tightest of the limits, and often the command itself.
    const double low = double{profile.load_low_ohm};
    const double square = widths * double{train.width_us} * 1e-6 * train.pulses;
    const double count = std::floor(5 / double{train.interval_s}) + 1;
    double peak =
        std::min({1e-3 * double{profile.ceiling_rms_ma} / std::sqrt(square * count / 5),
                  1e-3 * double{profile.ceiling_peak_ma}, double{profile.ceiling_charge_uc} / double{train.width_us}});
    peak *= dice.chance(0.3) ? dice.between(0.2, 0.8) : dice.between(0.85, 1.15);
    const double volts = std::min(peak * (profile.current_source != 0 ? double{profile.load_ohm} : low),
                                  dice.chance(0.5) ? 40.0 : dice.between(0, 42));
    train.command_v = static_cast<float>(volts);
    train.amplitude = static_cast<float>(profile.current_source != 0 ? volts / double{profile.load_ohm} * 1e3 : volts);
    return train;
}

/// A sequence of trains, as close together as their intervals allow.
void sequenceOfTrains(Dice& dice, std::uint64_t& trains, std::uint64_t& refused, std::uint64_t& close) {
    Rig rig(dice);
    te_gate gate{};
    te_train train = rig.played(randomTrain(dice, rig.profile, rig.now_ns()));
    const int commands = 2 + dice.pick(10);
    for (int k = 0; k < commands && !testing::Test::HasFatalFailure(); ++k) {
        if (dice.chance(0.4)) train = rig.played(randomTrain(dice, rig.profile, rig.now_ns()));
        train.onset_ns = rig.now_ns();
        if (te_train_judge(&rig.profile, &gate, &train, rig.now_ns()) == TE_ACCEPTED) {
            te_train_book(&rig.profile, &gate, &train, rig.now_ns());
            rig.judge(train);
        } else {
            ++refused;
        }
        const double wait = dice.chance(0.8) ? double{train.interval_s} : dice.decade(0.05, 6);
        rig.waitUntil(rig.now_ns() + static_cast<std::int64_t>(wait * 1e9) + 1);
    }
    trains += rig.trains;
    close += rig.close;
}

/// A profile that may ask for more than is allowed.
EncodingProfile randomEncoding(Dice& dice) {
    EncodingProfile encoding;
    encoding.amplitudeMax = Volts(dice.between(12, 40));
    encoding.intervalMin = Seconds(dice.decade(0.05, 1));
    encoding.intervalMax = Seconds(encoding.intervalMin.count() * dice.between(1.1, 4));
    encoding.amplitudeCurve.kind = static_cast<CurveKind>(dice.pick(3));
    encoding.intervalCurve.kind = static_cast<CurveKind>(dice.pick(3));
    encoding.amplitudeRatioPerTrain = dice.chance(0.5) ? 0 : dice.between(1.05, 3);
    encoding.intervalRatioPerTrain = dice.chance(0.5) ? 0 : dice.between(1.05, 3);
    encoding.amplitudeSlew_V_per_s = dice.chance(0.7) ? 0 : dice.decade(1, 100);
    encoding.train.shape = static_cast<PulseShape>(dice.pick(3));
    encoding.train.phaseWidth = Micros(std::round(dice.decade(20, 400)));
    encoding.train.rechargeRatio = 5;
    encoding.train.pulses = 1 + dice.pick(4);
    encoding.train.rate = Hertz(dice.between(120, 300));
    return encoding;
}

/// A finger whose sensors fail now and then, each for a while.
class FailingFinger {
public:
    FailingFinger(Dice& dice, te_state& state) : dice_(dice), state_(state) {}

    /// Gives the samples of one step of 10 ms that ends at `now_ns`.
    void step(std::int64_t now_ns) {
        if (dice_.chance(0.02)) force_ = dice_.chance(0.3) ? 0 : dice_.decade(0.2, 10);
        stream(TE_ACCELERATION, now_ns, 2'000'000, 5, 1,
               [&] { return 9.8 + 0.03 * gauss() + (force_ > 0 ? 0.5 * force_ * gauss() : 0); });
        stream(TE_FORCE, now_ns, 10'000'000, 1, 1, [&] { return force_ + 0.002 * gauss(); });
        stream(TE_TAXEL_ARRAY, now_ns, 10'000'000, 1, 2,
               [&] { return 900 + 5 * gauss() + 4000 * force_ * dice_.unit(); });
        te_reading frame{};
        while (te_frame(&state_, &frame) != 0) {
            if (!std::isnan(frame.R)) EXPECT_TRUE(frame.R >= 0 && frame.R <= 1) << frame.R;
            if (!std::isnan(frame.P)) EXPECT_TRUE(frame.P >= 0 && frame.P <= 1) << frame.P;
        }
    }

    /// True where no train may come now: a stream was silent, not a number or out of all proportion, or stood still.
    [[nodiscard]] bool isBad(std::int64_t now_ns) const {
        return std::ranges::any_of(fails_, [&](const Fail& fail) {
            if (fail.kind == Kind::None) return false;
            const auto since = now_ns - fail.since_ns;
            if (fail.kind == Kind::NotANumber || fail.kind == Kind::Beyond) return true;
            if (fail.kind == Kind::Stuck) return &fail == fails_.data() && since > 200'000'000;
            return since > 110'000'000;
        });
    }

private:
    enum class Kind { None, Silent, Stuck, NotANumber, Beyond };
    struct Fail {
        Kind kind = Kind::None;
        std::int64_t since_ns = 0;
        std::vector<float> last;
    };

    double gauss() {
        return std::sqrt(-2 * std::log(1 - dice_.unit())) * std::cos(2 * std::numbers::pi * dice_.unit());
    }

    template <class Value>
    void stream(te_stream stream, std::int64_t now_ns, std::int32_t step_ns, int count, int columns, Value value) {
        auto& fail = fails_[stream];
        if (dice_.chance(fail.kind == Kind::None ? 0.003 : 0.04)) {
            fail.kind = fail.kind != Kind::None ? Kind::None : static_cast<Kind>(1 + dice_.pick(4));
            fail.since_ns = now_ns;
        }
        std::vector<float> values;
        for (int i = 0; i < count * columns; ++i) values.push_back(static_cast<float>(value()));
        if (fail.kind == Kind::Silent) return;
        if (fail.kind == Kind::Stuck && fail.last.size() == values.size())
            for (std::size_t i = 0; i < values.size(); ++i)
                values[i] = fail.last[i % static_cast<std::size_t>(columns)];
        if (fail.kind == Kind::NotANumber) values.back() = static_cast<float>(kNaN);
        if (fail.kind == Kind::Beyond)
            values.back() = dice_.chance(0.5) ? 1e9F : -std::numeric_limits<float>::infinity();
        fail.last = values;
        te_samples(&state_, stream, now_ns - std::int64_t{count - 1} * step_ns, step_ns, values.data(),
                   static_cast<std::uint32_t>(count));
    }

    Dice& dice_;
    te_state& state_;
    std::array<Fail, 3> fails_;
    double force_ = 0;
};

/// Returns the trains of eight seconds of a finger whose sensors fail.
std::uint64_t trainsOfAFailingFinger(Dice& dice) {
    Rig rig(dice, randomEncoding(dice));
    const auto state = std::make_unique<te_state>();
    EXPECT_EQ(te_init(state.get(), &rig.profile), TE_ACCEPTED);
    if (dice.chance(0.9)) te_rested(state.get());
    FailingFinger finger(dice, *state);
    for (int k = 0; k < 800 && !testing::Test::HasFailure(); ++k) {
        rig.waitUntil(rig.now_ns() + 10'000'000);
        finger.step(rig.now_ns());
        te_train train{};
        if (te_next_train(state.get(), rig.now_ns(), &train) == 0) continue;
        EXPECT_FALSE(finger.isBad(rig.now_ns())) << "a train while a sensor fails";
        rig.judge(train);
    }
    return rig.trains;
}

/// Runs `count` sequences, each from a seed of its own; stops at the first that fails.
void eachSequence(std::uint64_t count, const std::function<void(Dice&)>& run) {
    Dice seeds(static_cast<std::uint64_t>(std::random_device()()));
    for (std::uint64_t k = 0; k < count && !testing::Test::HasFailure(); ++k) {
        const auto seed = static_cast<std::uint64_t>(seeds.unit() * 0x1p53);
        SCOPED_TRACE(fmt::format("seed {}", seed));
        Dice dice(seed);
        run(dice);
    }
}

}  // namespace

TEST(EncoderGate, RefusesWhateverTheBenchsGateRefuses) {
    RecordProperty("hazard", "H1");
#ifdef TACTOSCOPE_SANITIZED
    const std::uint64_t count = 10'000;  // as of the bench's gate
#else
    const auto count = trials<std::uint64_t>({.local = 100'000, .ci = 1'000'000, .campaign = 10'000'000});
#endif
    std::uint64_t trains = 0, refused = 0, close = 0;
    eachSequence(count, [&](Dice& dice) { sequenceOfTrains(dice, trains, refused, close); });
    std::cout << count << " sequences: " << trains << " trains, " << refused << " refused, " << close
              << " within 5 % of a limit\n";
    EXPECT_GT(trains, count);
    EXPECT_GT(refused, count);
    EXPECT_GT(close, count / 5);
}

TEST(EncoderGate, CountsATrainUntilItsEndHasLeftTheWindow) {
    RecordProperty("hazard", "H1");
    Dice dice(1);
    int tried = 0;
    for (int k = 0; k < 1000; ++k) {
        Rig rig(dice);
        const te_profile& p = rig.profile;
        // A train that takes `share` of the 5 s limit, at the worst of its errors.
        const auto trainOf = [&](std::uint32_t pulses, double share) {
            te_train train{};
            train.onset_ns = rig.now_ns();
            train.width_us = 200;
            train.pulses = pulses;
            train.pulse_hz = 50;
            train.interval_s = 10;
            const double square = share * 5e-6 * std::pow(double{p.ceiling_rms_ma}, 2);
            const double seconds = pulses * 400e-6 * (1 + double{p.width_error});
            const double peak_A = std::sqrt(square / seconds) / (1 + double{p.amplitude_error});
            const double volts = peak_A * double{p.load_low_ohm};
            train.amplitude = static_cast<float>(p.current_source != 0 ? 1e3 * peak_A : volts);
            train.command_v = static_cast<float>(volts);
            return train;
        };
        te_gate gate{};
        const te_train first = trainOf(24, 0.8);
        if (te_train_judge(&p, &gate, &first, rig.now_ns()) != TE_ACCEPTED) continue;
        te_train_book(&p, &gate, &first, rig.now_ns());
        rig.waitUntil(rig.now_ns() + static_cast<std::int64_t>(dice.between(5, 5.8) * 1e9));
        const te_train second = trainOf(1, 0.3);
        const te_gate empty{};
        if (te_train_judge(&p, &empty, &second, rig.now_ns()) != TE_ACCEPTED) continue;
        ++tried;
        EXPECT_EQ(te_train_judge(&p, &gate, &second, rig.now_ns()), TE_ABOVE_RMS);
    }
    EXPECT_GT(tried, 50);
}

TEST(EncoderGate, LetsNothingOutWhileASensorFails) {
    RecordProperty("hazard", "H7");
    const auto count = trials<std::uint64_t>({.local = 400, .ci = 4'000, .campaign = 100'000});
    std::uint64_t trains = 0;
    eachSequence(count, [&](Dice& dice) { trains += trainsOfAFailingFinger(dice); });
    std::cout << count << " fingers, " << trains << " trains\n";
    EXPECT_GT(trains, count);
}

TEST(EncoderGate, RefusesAProfileInWhichAnyValueIsNotANumber) {
    RecordProperty("hazard", "H1");
    Dice dice(1);
    EncodingProfile encoding;
    encoding.train.shape = PulseShape::AsymmetricBiphasic;
    const Rig rig(dice, encoding);
    const auto state = std::make_unique<te_state>();
    std::array<std::uint32_t, sizeof(te_profile) / 4> words{};
    static_assert(sizeof words == sizeof(te_profile));
    std::size_t used = 0;
    for (std::size_t i = 2; i < words.size(); ++i) {
        std::memcpy(words.data(), &rig.profile, sizeof words);
        if (words[i] == 0 && i >= offsetof(te_profile, taxel_scale) / 4) continue;  // of a taxel that is not there
        for (const std::uint32_t bad : {0x7FC00000U, 0xFF800000U, 0x7F800000U}) {
            words[i] = bad;
            te_profile profile{};
            std::memcpy(&profile, words.data(), sizeof profile);
            profile.hash = te_hash(&profile);
            EXPECT_NE(te_init(state.get(), &profile), TE_ACCEPTED) << "word " << i;
            te_train train{};
            EXPECT_EQ(te_next_train(state.get(), 0, &train), 0);
            EXPECT_EQ(te_fault(state.get(), 0), TE_FAULT_PROFILE);
        }
        ++used;
    }
    EXPECT_GE(used, 60U);
}

TEST(EncoderGate, RefusesATrainInWhichAnyValueIsNotANumber) {
    RecordProperty("hazard", "H1");
    Dice dice(2);
    const Rig rig(dice);
    const te_gate gate{};
    te_train sound{.onset_ns = rig.now_ns(),
                   .interval_s = 2,
                   .command_v = 0.1F,
                   .amplitude = 0.1F,
                   .shape = TE_ASYMMETRIC,
                   .negative = 0,
                   .width_us = 200,
                   .gap_us = 100,
                   .recharge_ratio = 5,
                   .pulses = 1,
                   .pulse_hz = 100};
    EXPECT_EQ(te_train_judge(&rig.profile, &gate, &sound, rig.now_ns()), TE_ACCEPTED);
    for (const auto value : {&te_train::interval_s, &te_train::command_v, &te_train::amplitude, &te_train::width_us,
                             &te_train::gap_us, &te_train::recharge_ratio, &te_train::pulse_hz}) {
        for (const double bad : {kNaN, std::numeric_limits<double>::infinity(), -1.0}) {
            te_train train = sound;
            train.*value = static_cast<float>(bad);
            EXPECT_NE(te_train_judge(&rig.profile, &gate, &train, rig.now_ns()), TE_ACCEPTED);
        }
    }
}

TEST(EncoderGate, AnotherContentHasAnotherHash) {
    Dice dice(3);
    const Rig rig(dice);
    const auto state = std::make_unique<te_state>();
    te_profile changed = rig.profile;
    changed.amplitude_max_v = 20;
    EXPECT_EQ(te_init(state.get(), &changed), TE_BAD_HASH);
    const auto crc = crc32(0, reinterpret_cast<const Bytef*>(&rig.profile) + 8, offsetof(te_profile, taxel_scale) - 8);
    std::array<float, 4> taxels{rig.profile.taxel_scale[0], rig.profile.taxel_scale[1], rig.profile.taxel_offset[0],
                                rig.profile.taxel_offset[1]};
    EXPECT_EQ(rig.profile.hash, crc32(crc, reinterpret_cast<const Bytef*>(taxels.data()), sizeof taxels));
}

TEST(EncoderProfile, TravelsAsBytes) {
    Dice dice(5);
    const Rig rig(dice);
    const auto bytes = profileBytes(rig.profile);
    const auto* const from = reinterpret_cast<const std::uint8_t*>(bytes.data());
    const auto size = static_cast<std::uint32_t>(bytes.size());
    te_profile read{};
    EXPECT_EQ(te_read_profile(&read, from, size), TE_ACCEPTED);
    EXPECT_EQ(std::memcmp(&read, &rig.profile, sizeof read), 0);
    for (std::uint32_t shorter = 0; shorter < size; ++shorter)
        EXPECT_EQ(te_read_profile(&read, from, shorter), TE_BAD_LAYOUT);
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        auto changed = bytes;
        changed[i] = static_cast<char>(changed[i] ^ 1);
        EXPECT_NE(te_read_profile(&read, reinterpret_cast<const std::uint8_t*>(changed.data()), size), TE_ACCEPTED)
            << i;
    }
}

TEST(EncoderProfile, TravelsAsAHeader) {
    Dice dice(6);
    const Rig rig(dice);
    const ScratchDir scratch;
    scratch.write("profile.h", profileHeader(rig.profile, "our */ profile"));
    scratch.write("main.c",
                  "#include <stdio.h>\n#include \"profile.h\"\nint main(void) {\n"
                  "    return fwrite(&tactile_profile, sizeof tactile_profile, 1, stdout) == 1 ? 0 : 1;\n}\n");
    const auto folder = scratch.path().string();
    const auto command =
        fmt::format("cd '{}' && " TACTO_C_COMPILER
                    " -std=c99 -Wall -Wextra -Wpedantic -Wno-missing-field-initializers -Werror "
                    "-DTE_TAXELS=32U -I'{}/resources/firmware/tactile_encoder' main.c -o main && ./main > made",
                    folder, sourceDir().string());
    ASSERT_EQ(std::system(command.c_str()), 0);
    const auto made = readTextFile(scratch.path() / "made", 10'000);
    ASSERT_TRUE(made) << made.error().message;
    ASSERT_EQ(made->size(), sizeof(te_profile));
    EXPECT_EQ(std::memcmp(made->data(), &rig.profile, sizeof(te_profile)), 0);
    EXPECT_THAT(profileHeader(rig.profile, ""),
                testing::HasSubstr(fmt::format("#if TE_TAXELS < {}U\n#error", rig.profile.taxels)));
}

TEST(EncoderProfile, TakesAnAbsoluteErrorOfTheSmallestValueThatMayComeOut) {
    RecordProperty("hazard", "H1");
    EncoderOutput output;
    output.source.drive = Drive::Current;
    output.source.amplitudeMax = 100;
    output.source.accuracy.amplitude = Spread{0.01, 0.25};   // mA
    output.source.accuracy.phaseWidth = Spread{0.02, 4e-6};  // s
    output.source.accuracy.gap = Spread{0, 2e-6};
    output.source.accuracy.interval = Spread{0, 0.001};
    output.source.accuracy.rate = Spread{0.001, 0.1};
    output.load = LoadRange::declared(Load::resistor(Ohms(2000)));
    const auto made = encoderProfile(kStreams, {}, {}, output);
    ASSERT_TRUE(made) << made.error().message;
    // 10 V into 2 kohm, less a rounding of 10 %, are 4.5 mA; 200 us and 100 us; 0.5 s; 100 Hz.
    EXPECT_FLOAT_EQ(made->amplitude_error, 0.01F + 0.25F / 4.5F);
    EXPECT_FLOAT_EQ(made->width_error, 0.02F + 4.0F / 200);
    EXPECT_FLOAT_EQ(made->interval_error, 0.001F / 0.5F);
    EXPECT_FLOAT_EQ(made->rate_error, 0.001F + 0.1F / 100);
}

TEST(EncoderProfile, RefusesByNameWhatTheBoardCannotDo) {
    using testing::HasSubstr;
    RecordProperty("hazard", "H1");
    EncoderOutput output;
    output.source.amplitudeMax = 60;
    output.load = LoadRange::declared(Load::resistor(Ohms(1000)));
    EncodingProfile encoding;
    const auto refusal = [&](std::span<const StreamInfo> streams = kStreams) {
        const auto made = encoderProfile(streams, {}, encoding, output);
        return made ? std::string() : made.error().message;
    };
    EXPECT_EQ(refusal(), "");
    encoding.amplitudeMax = Volts(41);
    EXPECT_THAT(refusal(), HasSubstr("40 V"));
    encoding = {};
    encoding.hold = Hold::Charge;
    EXPECT_THAT(refusal(), HasSubstr("charge"));
    encoding = {};
    output.ceilings = {{Quantity::PulseEnergy, 1}};
    EXPECT_THAT(refusal(), HasSubstr("energy"));
    output.ceilings = {{Quantity::CommandVoltage, 30}};
    EXPECT_THAT(refusal(), HasSubstr("30 V"));
    output.ceilings.clear();
    output.load = LoadRange::declared(Load::skin(Ohms(200), Ohms(10'000), Nanofarads(50)));
    EXPECT_THAT(refusal(), HasSubstr("a resistance"));
    output.load = LoadRange::declared(Load::resistor(Ohms(1000)));
    output.source.accuracy.amplitude = Spread{0.01, 5};
    EXPECT_THAT(refusal(), HasSubstr("errors of at most 20 %"));
    output.source.accuracy = {};
    auto fast = kStreams;
    fast[0].rate_hz = 8000;
    EXPECT_THAT(refusal(fast), HasSubstr("4007 Hz"));
    output.source.widthStep = Micros(30);
    EXPECT_THAT(refusal(), HasSubstr("a phase of 180 us, a gap of 90 us"));
    output.source.widthStep = Micros(1);
    output.source.widthMin = Micros(300);
    EXPECT_THAT(refusal(), HasSubstr("300 to 4000"));
    output.source.widthMin = Micros(10);
    encoding.train.pulses = 5;
    output.source.pulsesMax = 4;
    EXPECT_THAT(refusal(), HasSubstr("pulses"));
}

TEST(EncoderGate, AStopLasts) {
    RecordProperty("hazard", "H2");
    Dice dice(4);
    const Rig rig(dice);
    const auto state = std::make_unique<te_state>();
    ASSERT_EQ(te_init(state.get(), &rig.profile), TE_ACCEPTED);
    te_stop(state.get());
    EXPECT_NE(te_fault(state.get(), 0) & TE_FAULT_STOPPED, 0U);
    ASSERT_EQ(te_init(state.get(), &rig.profile), TE_ACCEPTED);
    EXPECT_EQ(te_fault(state.get(), 0) & TE_FAULT_STOPPED, 0U);
}

}  // namespace tacto::test
