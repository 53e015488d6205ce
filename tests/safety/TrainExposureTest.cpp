#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <vector>

#include "core/base/Statistics.h"
#include "core/safety/DeliveryBounds.h"
#include "core/safety/SafetyGate.h"
#include "core/safety/SourceTraits.h"
#include "core/safety/TrainExposure.h"
#include "tests/safety/Dice.h"
#include "tests/safety/GateFixtures.h"
#include "tests/safety/IndependentBody.h"
#include "tests/support/Figures.h"
#include "tests/support/Refused.h"
#include "tests/support/Trials.h"

namespace tacto::test {

namespace {

TrainExposure into(double ohm, const PulseTrain& train, double interval) {
    return exposureOf(train, Seconds(interval), Load::resistor(Ohms(ohm)), voltageSource(), kNaN);
}
}  // namespace

TEST(TrainExposure, RoughHighInto500OhmIsThePublishedFigure) {
    // 40 V into 500 Ω gives 80 mA for 0.4 ms, ten times in 5 s.
    const auto e = into(500, volts(40), 0.5);
    EXPECT_NEAR(e.at(Quantity::RmsCurrent5s), std::sqrt(10 * 0.08 * 0.08 * 4e-4 / 5) * 1e3, 1e-9);
    EXPECT_NEAR(e.at(Quantity::RmsCurrentTrain), 16, 1e-9);
    EXPECT_NEAR(e.at(Quantity::RmsCurrent1s), std::sqrt(2 * 0.08 * 0.08 * 4e-4) * 1e3, 1e-9);
    EXPECT_NEAR(e.at(Quantity::PeakVoltage), 40, 1e-12);
    EXPECT_NEAR(e.at(Quantity::PeakCurrent), 80, 1e-9);
    EXPECT_NEAR(e.at(Quantity::PhaseCharge), 16, 1e-9);
    EXPECT_NEAR(e.at(Quantity::NetCharge), 0, 1e-9);
    EXPECT_NEAR(e.at(Quantity::PulseEnergy), 40 * 0.08 * 4e-4 * 1e3, 1e-9);
    EXPECT_NEAR(e.at(Quantity::DcCurrent), 0, 1e-9);
    EXPECT_NEAR(e.at(Quantity::RmsVoltage5s), 40 * std::sqrt(4e-3 / 5), 1e-9);
    EXPECT_TRUE(std::isnan(e.at(Quantity::CurrentDensity))) << "no area, no density";
    EXPECT_TRUE(std::isnan(e.at(Quantity::PowerDensity)));
}

TEST(TrainExposure, RoughHighInto100OhmIs11Point3) {
    EXPECT_NEAR(into(100, volts(40), 0.5).at(Quantity::RmsCurrent5s), std::sqrt(10 * 0.4 * 0.4 * 4e-4 / 5) * 1e3, 1e-9);
}

TEST(TrainExposure, DensitiesFollowTheArea) {
    const auto e = exposureOf(volts(40), Seconds(0.5), Load::resistor(Ohms(500)), voltageSource(), 2.0);
    EXPECT_NEAR(e.at(Quantity::CurrentDensity), std::sqrt(10 * 0.08 * 0.08 * 4e-4 / 5) * 1e3 / 2, 1e-9);
    EXPECT_NEAR(e.at(Quantity::PowerDensity), 2 * 40 * 0.08 * 4e-4 / 2, 1e-12);
}

TEST(TrainExposure, WorstSlidingWindowHoldsWholeTrains) {
    // Interval 0.4 s: 5 s hold 12.5 intervals, and a window can touch 13 trains.
    EXPECT_NEAR(into(500, volts(40), 0.4).at(Quantity::RmsCurrent5s), std::sqrt(13 * 0.08 * 0.08 * 4e-4 / 5) * 1e3,
                1e-9);
    // Interval 7 s: 5 s never hold more than one train.
    EXPECT_NEAR(into(500, volts(40), 7).at(Quantity::RmsCurrent5s), std::sqrt(0.08 * 0.08 * 4e-4 / 5) * 1e3, 1e-9);
    // 100 pulses at 10 Hz last 10 s: any 5 s hold 50 of them, any second 10.
    PulseTrain train = volts(40);
    train.pulses = 100;
    train.rate = Hertz(10);
    const auto e = into(500, train, 10);
    EXPECT_NEAR(e.at(Quantity::RmsCurrent5s), std::sqrt(50 * 0.08 * 0.08 * 4e-4 / 5) * 1e3, 1e-9);
    EXPECT_NEAR(e.at(Quantity::RmsCurrent1s), std::sqrt(10 * 0.08 * 0.08 * 4e-4) * 1e3, 1e-9);
}

TEST(TrainExposure, RcLoadPeaksAsScienceMdSays) {
    SourceTraits source = voltageSource();
    PulseTrain train = volts(40);
    const Load rc = benchRcLoad();
    // A high-impedance gap keeps the capacitor charged; a gap held at zero discharges it (tests/reference/loads.py).
    const auto& scipy = figuresOf("loads").at("bench_load_40_v");
    source.gap = GapState::HighImpedance;
    EXPECT_NEAR(exposureOf(train, Seconds(0.5), rc, source, kNaN).at(Quantity::PeakCurrent),
                scipy.at("second_ma_high_impedance").get<double>(), 1e-6);
    train.interPhaseGap = Micros(0);
    EXPECT_NEAR(exposureOf(train, Seconds(0.5), rc, source, kNaN).at(Quantity::PeakCurrent),
                scipy.at("second_ma_no_gap").get<double>(), 1e-6);
    train.interPhaseGap = Micros(100);
    source.gap = GapState::HoldsZero;
    EXPECT_NEAR(exposureOf(train, Seconds(0.5), rc, source, kNaN).at(Quantity::PeakCurrent),
                scipy.at("second_ma_zero").get<double>(), 1e-6);
}

TEST(TrainExposure, HighImpedanceGapLeaves58PercentOfAPhase) {
    SourceTraits source = voltageSource();
    source.gap = GapState::HighImpedance;
    const auto e = exposureOf(volts(40), Seconds(0.5), benchRcLoad(), source, kNaN);
    // Relative to the leading phase's charge, which the second phase exceeds.
    IndependentBody body;
    body.fit({200, 10'000, 50e-9});
    PulseTrain leading = volts(40);
    leading.shape = PulseShape::Monophasic;
    const double phase = body.deliver(leading, {true, 1e9}, 0).phaseCharge * 1e6;
    EXPECT_NEAR(e.at(Quantity::NetCharge) / phase, -figuresOf("loads").at("bench_load_net_charge").get<double>(), 0.01);
}

// Compared with the independent model: all shapes, sources and gaps, into the RC load, from rest.
TEST(TrainExposure, AgreesWithTheIndependentModel) {
    RecordProperty("hazard", "H1");
    for (const auto shape : {PulseShape::SymmetricBiphasic, PulseShape::AsymmetricBiphasic, PulseShape::Monophasic}) {
        for (const bool current : {false, true}) {
            for (const auto gap : {GapState::HoldsZero, GapState::HighImpedance}) {
                for (const int pulses : {1, 7}) {
                    SourceTraits source = current ? currentSource() : voltageSource();
                    source.gap = gap;
                    PulseTrain train = current ? milliamps(3) : volts(30);
                    train.shape = shape;
                    train.pulses = pulses;
                    train.rate = Hertz(380);  // 2.6 ms: the RC load (0.5 ms) keeps a little charge between pulses
                    const auto e = exposureOf(train, Seconds(1), benchRcLoad(), source, 1);
                    IndependentBody body;
                    body.fit({200, 10'000, 50e-9});
                    const PulseFacts facts = body.deliver(train, {gap == GapState::HighImpedance, 1e9}, 0);
                    const std::string where = fmt::format("shape {} {} gap {} n {}", static_cast<int>(shape), current,
                                                          static_cast<int>(gap), pulses);
                    EXPECT_NEAR(e.at(Quantity::PeakCurrent) / (facts.peakI * 1e3), 1, 1e-6) << where;
                    EXPECT_NEAR(e.at(Quantity::PeakVoltage) / facts.peakV, 1, 1e-6) << where;
                    EXPECT_NEAR(e.at(Quantity::PhaseCharge) / (facts.phaseCharge * 1e6), 1, 1e-6) << where;
                    EXPECT_NEAR(e.at(Quantity::PulseEnergy) / (facts.energy * 1e3), 1, 1e-6) << where;
                    EXPECT_NEAR(e.at(Quantity::RmsCurrent5s) / (std::sqrt(body.worstI2(100) * 5 / 5) * 1e3), 1, 1e-6)
                        << where;
                    // After the whole train the load is discharged: the energy it took is heat; but a window may end
                    // with the capacitor full.
                    EXPECT_NEAR(e.at(Quantity::PowerDensity) / (body.netEnergy() + body.mostStored()), 1, 1e-6)
                        << where;
                    EXPECT_LE(body.worstEnergy(1), e.at(Quantity::PowerDensity)) << where;
                    EXPECT_NEAR(e.at(Quantity::NetCharge), facts.netCharge * 1e6, 1e-3 * facts.phaseCharge * 1e6)
                        << where;
                }
            }
        }
    }
}

// Found by random sequences: the second phase takes back part of the energy stored by the first, so a window of a
// second that ends between the phases holds 5 % more than the same number of whole pulses.
TEST(TrainExposure, ASecondMayEndWithTheCapacitorFull) {
    RecordProperty("hazard", "H1");
    SourceTraits source = currentSource();
    source.gap = GapState::HoldsZero;
    source.compliance = Volts(148);
    const auto& scipy = figuresOf("loads").at("worst_second");
    PulseTrain train = milliamps(scipy.at("amplitude_ma"));
    train.phaseWidth = Micros(scipy.at("width_us"));
    train.interPhaseGap = Micros(0);
    train.rate = Hertz(scipy.at("rate_hz"));
    train.pulses = scipy.at("pulses");
    constexpr double kArea = 0.060847491826668404;
    const auto& circuit = scipy.at("load");
    const Body body{circuit.at("series_ohm"), circuit.at("parallel_ohm"), circuit.at("capacitance_f")};
    const Load load = Load::skin(Ohms(body.rs), Ohms(body.rp), Nanofarads(body.c * 1e9));
    const auto e = exposureOf(train, Seconds(5.118), load, source, kArea);
    IndependentBody truth;
    truth.fit(body);
    truth.deliver(train, {false, 148}, 0);
    const double worst = truth.worstEnergy(1) / kArea;
    EXPECT_NEAR(worst, scipy.at("energy_j").get<double>() / kArea, 1e-4 * worst);
    EXPECT_GE(e.at(Quantity::PowerDensity), worst);
    EXPECT_LE(e.at(Quantity::PowerDensity), 1.05 * worst) << "and not much more than that";
}

/// Draws a pulse of any shape, with phases of 20 us to `widest`.
void drawPulse(PulseTrain& train, Dice& dice, Micros widest) {
    train.shape = std::array{PulseShape::SymmetricBiphasic, PulseShape::Monophasic,
                             PulseShape::AsymmetricBiphasic}[static_cast<std::size_t>(3 * dice.unit())];
    train.rechargeRatio = 2 + 8 * dice.unit();
    train.phaseWidth = Micros(dice.decade(20, widest.count()));
    train.interPhaseGap = Micros(dice.chance(0.3) ? 0 : 200 * dice.unit());
}

/// A train longer than a second, at 1 V or 1 mA, with the body that receives it, and what the gate books for it.
struct LongTrain {
    Body body;
    PulseTrain train;
    SourceTraits source;
    /// Draws a case: a current source with probability `currents`, a capacitance (F) in this range; no train yet.
    static LongTrain drawn(Dice& dice, double currents, std::array<double, 2> capacitance) {
        const bool current = dice.chance(currents);
        const double rs = dice.decade(80, 2000), rp = dice.decade(1000, 50'000);
        LongTrain some{{rs, rp, dice.decade(capacitance[0], capacitance[1])},
                       current ? milliamps(1) : volts(1),
                       current ? currentSource() : voltageSource()};
        some.source.gap = dice.chance(0.5) ? GapState::HoldsZero : GapState::HighImpedance;
        some.source.compliance = Volts(1e9);
        return some;
    }
    [[nodiscard]] TrainSums booked() const { return booked({train, train}); }
    [[nodiscard]] TrainSums booked(const TrainRange& range) const {
        return exposureOf(range, 2 * range.sparsest.duration(), load(), source, 1).in1s;
    }
    [[nodiscard]] Load load() const { return Load::skin(Ohms(body.rs), Ohms(body.rp), Nanofarads(body.c * 1e9)); }
    [[nodiscard]] IndependentBody delivered() const {
        IndependentBody truth;
        truth.fit(body);
        truth.deliver(train, {source.gap == GapState::HighImpedance, 1e9}, 0);
        return truth;
    }
};

// In the first pulse, which starts from rest, the second phase takes the most; in later pulses the leading phase does.
// A second that begins within the first pulse and ends within the ninth holds more than eight times the largest pulse.
TEST(TrainExposure, ASecondMayBeginAndEndWithinAPulse) {
    RecordProperty("hazard", "H1");
    LongTrain late{{200, 48'000, 1.75e-6}, volts(1), voltageSource()};
    late.source.gap = GapState::HighImpedance;
    late.train.phaseWidth = Micros(220);
    late.train.interPhaseGap = Micros(0);
    late.train.pulses = 11;
    late.train.rate = Hertz(7.999999);  // eight periods are slightly more than a second
    double most = 0;
    for (int only = 1; only <= 9; ++only) {
        IndependentBody truth;
        truth.fit(late.body);
        PulseTrain some = late.train;
        some.pulses = only;
        truth.deliver(some, {true, 1e9}, 0);
        const double all = truth.worstI2(100);
        some.pulses = only - 1;
        IndependentBody before;
        before.fit(late.body);
        if (only > 1) before.deliver(some, {true, 1e9}, 0);
        most = std::max(most, all - before.worstI2(100));
    }
    const double worst = late.delivered().worstI2(1);
    EXPECT_GT(worst, 1.002 * 8 * most) << "the largest pulse eight times does not hold it";
    EXPECT_GE(late.booked().currentSquared_A2s, worst);
    EXPECT_LE(late.booked().currentSquared_A2s, 1.05 * worst) << "a bound that refuses too much";
}

TEST(TrainExposure, NoSecondOfALongTrainHoldsMoreThanIsBooked) {
    RecordProperty("hazard", "H1");
    Dice dice(20261128);
    int close = 0;
    for (int k = 0; k < 20'000; ++k) {
        LongTrain some = LongTrain::drawn(dice, 0.5, {5e-9, 2e-6});
        drawPulse(some.train, dice, Micros(400'000));
        const int periods = 1 + static_cast<int>(8 * dice.unit());
        some.train.rate = Hertz(periods / (1 + dice.decade(1e-8, 1e-2)));  // the trains are hardly longer than a second
        some.train.pulses = periods + 1 + static_cast<int>(4 * dice.unit());
        if (!validate(some.train)) continue;
        const TrainSums booked = some.booked();
        const IndependentBody truth = some.delivered();
        // The quadrature error of the other model.
        constexpr double kSlack = 1 + 2e-6;
        ASSERT_LE(truth.worstI2(1), booked.currentSquared_A2s * kSlack) << k;
        ASSERT_LE(truth.worstEnergy(1), (booked.dissipated_J + booked.stored_J) * kSlack) << k;
        close += truth.worstI2(1) > 0.99 * booked.currentSquared_A2s ? 1 : 0;
    }
    EXPECT_GT(close, 10'000) << "a bound that refuses too much, or nothing was tried";
}

/// A voltage or current during one stretch: steady + fading · exp(-t / tau).
struct Fading {
    double steady = 0, fading = 0;
    /// Returns the integral of the square over the first `t` seconds.
    [[nodiscard]] double squares(double t, double tau) const {
        const double gone = -std::expm1(-t / tau), twice = -std::expm1(-2 * t / tau);
        return steady * steady * t + 2 * steady * fading * tau * gone + fading * fading * tau / 2 * twice;
    }
};

/// The effect of long trains, one per `interval`, on their body, by closed forms, up to any time.
class Course {
public:
    explicit Course(const LongTrain& of, int trains = 1, double interval = 0) : body_(of.body) {
        const PulseTrain& train = of.train;
        const bool current = of.source.drive == Drive::Current, idle = of.source.gap == GapState::HighImpedance;
        const double size = current ? 1e-3 : 1, width = train.phaseWidth.count() * 1e-6;
        const double gap = train.shape == PulseShape::Monophasic ? 0 : train.interPhaseGap.count() * 1e-6;
        const double ratio = train.shape == PulseShape::AsymmetricBiphasic ? train.rechargeRatio : 1;
        const double second = train.shape == PulseShape::Monophasic ? 0 : width * ratio;
        for (int t = 0; t < trains; ++t) {
            for (int k = 0; k < train.pulses; ++k) {
                add(current, size, width);
                add(idle, 0, gap);
                add(current, -size / ratio, second);
                add(idle, 0, 1 / train.rate.value() - width - gap - second);
            }
            add(idle, 0, interval - train.pulses / train.rate.value());
        }
    }
    struct Sums {
        double amps = 0, volts = 0, heat = 0;
    };
    /// Returns the largest value of any window that begins or ends at one of `moments` times in each stretch.
    [[nodiscard]] Sums worst(double window, int moments) const {
        Sums worst;
        const double last = stretches_.back().begin + stretches_.back().length;
        const auto look = [&](double begin) {
            if (begin < 0 || begin + window > last) return;
            const Sums until = sumUntil(begin + window), before = sumUntil(begin);
            worst = {std::max(worst.amps, until.amps - before.amps), std::max(worst.volts, until.volts - before.volts),
                     std::max(worst.heat, until.heat - before.heat)};
        };
        for (const Stretch& from : stretches_) {
            for (int k = 0; k < moments; ++k) look(from.begin + k * from.length / moments);
            look(from.begin + from.length - window);
        }
        return worst;
    }

private:
    struct Stretch {
        double begin, length, tau;
        Fading v, i, held;
        Sums before;
    };
    void add(bool isCurrent, double level, double length) {
        if (!(length > 0)) return;
        if (!(body_.c > 0)) {
            const double amps = isCurrent ? level : level / body_.rs;
            stretches_.push_back({begin_, length, 1, {amps * body_.rs, 0}, {amps, 0}, {}, sum_});
            begin_ += length;
            sum_ = sumUntil(begin_);
            return;
        }
        const double conductance = 1 / body_.rp + (isCurrent ? 0 : 1 / body_.rs);
        const double goal = (isCurrent ? level : level / body_.rs) / conductance, start = held_ - goal;
        const Fading held{goal, start};
        const Fading i = isCurrent ? Fading{level, 0} : Fading{(level - goal) / body_.rs, -start / body_.rs};
        const Fading v{i.steady * body_.rs + goal, i.fading * body_.rs + start};
        const double tau = body_.c / conductance;
        stretches_.push_back({begin_, length, tau, v, i, held, sum_});
        begin_ += length;
        held_ = goal + start * std::exp(-length / tau);
        sum_ = sumUntil(begin_);
    }
    [[nodiscard]] Sums sumUntil(double time) const {
        const auto after = std::upper_bound(stretches_.begin(), stretches_.end(), time,
                                            [](double t, const Stretch& stretch) { return t < stretch.begin; });
        const Stretch& in = *(after - 1);
        const double t = std::min(time - in.begin, in.length);
        const double amps = in.i.squares(t, in.tau), leaked = in.held.squares(t, in.tau);
        return {in.before.amps + amps, in.before.volts + in.v.squares(t, in.tau),
                in.before.heat + amps * body_.rs + (leaked > 0 ? leaked / body_.rp : 0)};
    }
    Body body_;
    std::vector<Stretch> stretches_;
    double begin_ = 0, held_ = 0;
    Sums sum_;
};

// A second that begins late in a phase of one pulse and ends early in the same phase of another holds more than whole
// phases do: voltage and heat change sign, or fall and rise, within a phase.
TEST(TrainExposure, NoSecondThatCutsAPhaseHoldsMoreThanIsBooked) {
    RecordProperty("hazard", "H1");
    // One pulse a second: 2.5 % more than the sum of the largest value of each phase.
    LongTrain slow{{200, 6000, 38e-6}, milliamps(1), currentSource()};
    slow.source.gap = GapState::HoldsZero;
    slow.source.compliance = Volts(1e9);
    slow.train.phaseWidth = Micros(499'000);
    slow.train.interPhaseGap = Micros(0);
    slow.train.rate = Hertz(0.9999999);
    slow.train.pulses = 4;
    EXPECT_LE(Course(slow).worst(1, 200).volts, slow.booked().voltageSquared_V2s);
    EXPECT_LE(slow.booked().voltageSquared_V2s, 1.5 * Course(slow).worst(1, 200).volts) << "a phase more at most";

    Dice dice(1128);
    for (int k = 0; k < 400; ++k) {
        LongTrain some = LongTrain::drawn(dice, 0.8, {5e-8, 2e-5});
        some.train.shape = dice.unit() < 0.7 ? PulseShape::SymmetricBiphasic : PulseShape::AsymmetricBiphasic;
        some.train.rechargeRatio = 2 + 3 * dice.unit();
        some.train.interPhaseGap = Micros(0);
        const int periods = 1 + static_cast<int>(4 * dice.unit());
        const double period_us = 1e6 / periods;
        const double phases = some.train.shape == PulseShape::SymmetricBiphasic ? 2 : 1 + some.train.rechargeRatio;
        some.train.phaseWidth = Micros(std::min(4e5, period_us / phases * (1 - dice.decade(1e-3, 0.5))));
        some.train.rate = Hertz(periods / (1 + dice.decade(1e-8, 1e-5)));
        some.train.pulses = periods + 2 + static_cast<int>(3 * dice.unit());
        const TrainSums booked = some.booked();
        const auto worst = Course(some).worst(1, 200);
        ASSERT_LE(worst.volts, booked.voltageSquared_V2s * (1 + 1e-9)) << k;
        ASSERT_LE(worst.heat, booked.dissipated_J * (1 + 1e-9)) << k;
    }
}

// The second train starts with the charge left by the first, so a second that begins in the first train and ends in the
// ninth holds more than eight of either: the values in previews and tables are upper bounds, too (H9).
TEST(TrainExposure, ASecondOfRepeatedTrainsHoldsNoMoreThanIsShown) {
    RecordProperty("hazard", "H9");
    const Body body{200, 48'000, 1.75e-6};
    SourceTraits source = voltageSource();
    source.gap = GapState::HighImpedance;
    PulseTrain train = volts(1);
    train.phaseWidth = Micros(220);
    train.interPhaseGap = Micros(0);
    const double interval = 1 / 7.999999;
    PulseTrain many = train;
    many.pulses = 12;
    many.rate = Hertz(1 / interval);
    IndependentBody truth;
    truth.fit(body);
    truth.deliver(many, {true, 1e9}, 0);
    const double worst = std::sqrt(truth.worstI2(1)) * 1e3;
    const Load load = Load::skin(Ohms(body.rs), Ohms(body.rp), Nanofarads(body.c * 1e9));
    for (const double rate : {100.0, 1 / interval}) {  // the second rate gives one pulse that takes the whole interval
        train.rate = Hertz(rate);
        const double shown = exposureOf(train, Seconds(interval), load, source, kNaN).at(Quantity::RmsCurrent1s);
        EXPECT_GE(shown, worst);
        EXPECT_LE(shown, 1.05 * worst);
    }
}

/// Repeated trains of up to 20 pulses; mostly, a window does not hold a whole number of their intervals.
struct Repeated {
    LongTrain each;
    double interval;
    int trains;
    static Repeated drawn(Dice& dice, std::array<double, 2> capacitance) {
        Repeated some{LongTrain::drawn(dice, 0.5, capacitance), 0, 0};
        PulseTrain& train = some.each.train;
        drawPulse(train, dice, Micros(3000));
        train.pulses = 1 + dice.pick(20);
        train.rate = Hertz(1 / (train.pulseDuration().count() * dice.decade(1.02, 100)));
        some.interval = std::max(0.05, train.duration().count() * dice.decade(1.0001, 10));
        if (dice.chance(0.5)) {  // five seconds hold a few of them, or a little more
            const int few = 1 + dice.pick(6);
            const double fits = dice.chance(0.5) ? 5 / (few + dice.decade(1e-7, 0.5)) : 5.0 / few;
            some.interval = std::max(fits, train.duration().count() * 1.0001);
        }
        some.trains = 4 + static_cast<int>(11 / some.interval);
        return some;
    }
};

// science.md section 7: into a resistor, the worst position of a window is exact, except that a pulse cut by the
// window's edge is treated as if its phases followed each other without a gap.
TEST(TrainExposure, IntoAResistorTheWorstPositionOfAWindowIsExact) {
    RecordProperty("hazard", "H1");
    Dice dice(20261133);
    int exact = 0, parted = 0;
    const int count = trials<int>({.local = 80, .ci = 500, .campaign = 30'000});
    for (int k = 0; k < count; ++k) {
        Repeated some = Repeated::drawn(dice, {1, 1});
        some.each.body = {dice.decade(60, 20'000), 0, 0};
        const Course truth(some.each, some.trains / 2, some.interval);  // all trains are alike
        const Load load = Load::resistor(Ohms(some.each.body.rs));
        const auto shown = exposureOf(some.each.train, Seconds(some.interval), load, some.each.source, 1);
        const auto single = truth.worst(some.each.train.pulseDuration().count(), 1);  // the value of one pulse
        for (const double window : {1.0, 5.0}) {
            const auto worst = truth.worst(window, 1);
            const auto rms = shown.at(window == 1 ? Quantity::RmsCurrent1s : Quantity::RmsCurrent5s);
            const double squares = rms * rms * 1e-6 * window;
            ASSERT_LE(worst.amps, squares * (1 + 1e-9)) << k << ' ' << window;
            ASSERT_LE(squares, worst.amps * (1 + 1e-9) + 0.5 * single.amps * (1 + 1e-9)) << k << ' ' << window;
            ++(squares <= worst.amps * (1 + 1e-6) ? exact : parted);
            if (some.each.train.interPhaseGap == Micros(0)) {
                ASSERT_LE(squares, worst.amps * (1 + 1e-6)) << k << ' ' << window;
            }
        }
        const double volts = shown.at(Quantity::RmsVoltage5s);
        ASSERT_LE(truth.worst(5, 1).volts, volts * volts * 5 * (1 + 1e-9)) << k;
        ASSERT_LE(truth.worst(1, 1).heat, shown.at(Quantity::PowerDensity) * (1 + 1e-9)) << k;
    }
    EXPECT_GT(exact, 20 * parted) << "a gap that a window's edge falls into is rare";
}

// Into a load with a capacitor the value is a bound: never too low, and too high by at most one pulse, which the
// window's edge may cut; if the load keeps charge between trains, each train is taken as the largest.
TEST(TrainExposure, IntoACapacitorTheWorstPositionOfAWindowIsAnUpperBound) {
    RecordProperty("hazard", "H1");
    Dice dice(20261134);
    const int count = trials<int>({.local = 40, .ci = 300, .campaign = 10'000});
    constexpr double kRounding = 1e-7;  // error of a course of a thousand stretches, at the start of a charging spike
    int far = 0;
    for (int k = 0; k < count; ++k) {
        const Repeated some = Repeated::drawn(dice, {5e-9, 2e-6});
        const Course truth(some.each, some.trains, some.interval);
        const auto shown = exposureOf(some.each.train, Seconds(some.interval), some.each.load(), some.each.source, 1);
        const auto single = truth.worst(1 / some.each.train.rate.value(), 4);  // no pulse holds more than this
        for (const double window : {1.0, 5.0}) {
            const auto worst = truth.worst(window, 4);
            const auto rms = shown.at(window == 1 ? Quantity::RmsCurrent1s : Quantity::RmsCurrent5s);
            const double squares = rms * rms * 1e-6 * window;
            ASSERT_LE(worst.amps, squares * (1 + kRounding)) << k << ' ' << window;
            const double more = squares / (worst.amps + single.amps);
            ASSERT_LE(more, 1.5) << k << ' ' << window;
            far += more > 1.05 ? 1 : 0;
        }
        const double volts = shown.at(Quantity::RmsVoltage5s);
        ASSERT_LE(truth.worst(5, 4).volts, volts * volts * 5 * (1 + kRounding)) << k;
        ASSERT_LE(truth.worst(1, 4).heat, shown.at(Quantity::PowerDensity) * (1 + kRounding)) << k;
    }
    EXPECT_LE(far, 0.05 * count) << "a bound that refuses too much";
}

// Trains of two seconds every 4.9 s: 5 s hold one train and a few pulses of the next, not two trains.
TEST(TrainExposure, AWindowThatOnlyTouchesATrainDoesNotHoldIt) {
    PulseTrain train = volts(40);
    train.pulses = 20;
    train.rate = Hertz(10);
    const double pulse = 0.08 * 0.08 * 4e-4;
    const auto e = into(500, train, 4.9);
    EXPECT_NEAR(e.at(Quantity::RmsCurrent5s), std::sqrt((20 + 1) * pulse / 5) * 1e3, 1e-9);
    EXPECT_NEAR(e.at(Quantity::RmsCurrent1s), std::sqrt(10 * pulse) * 1e3, 1e-9);
    EXPECT_NEAR(into(500, train, 2.5).at(Quantity::RmsCurrent5s), std::sqrt(40 * pulse / 5) * 1e3, 1e-9);
    EXPECT_NEAR(into(500, train, 2.4).at(Quantity::RmsCurrent5s), std::sqrt((40 + 2) * pulse / 5) * 1e3, 1e-9);
    // The window includes 100 µs of the next train's first pulse, half of its first phase.
    EXPECT_NEAR(into(500, volts(40), 4.9999).at(Quantity::RmsCurrent5s), std::sqrt(1.25 * pulse / 5) * 1e3, 1e-9);
}

TEST(TrainExposure, ChargeLeftBehindIsCarriedIntoTheSteadyState) {
    // Rp·C = 2 s: a monophasic train every 0.5 s charges the load far above what one train leaves.
    SourceTraits source = voltageSource();
    source.gap = GapState::HighImpedance;
    PulseTrain train = volts(30);
    train.shape = PulseShape::Monophasic;
    train.pulses = 5;
    const Load slow = Load::skin(Ohms(1000), Ohms(1e6), Nanofarads(2000));
    const auto e = exposureOf(train, Seconds(0.5), slow, source, kNaN);
    IndependentBody body;
    body.fit({1000, 1e6, 2e-6});
    for (int k = 0; k < 200; ++k) body.deliver(train, {true, 1e9}, 0.5 * k);
    PulseTrain reversed = train;
    reversed.polarity = Polarity::Negative;
    // The charge left by 200 trains makes the reversed train peak higher; the gate takes that voltage into account.
    const double peak = body.deliver(reversed, {true, 1e9}, 100).peakI * 1e3;
    EXPECT_GT(peak, 1.2 * e.at(Quantity::PeakCurrent));
    EXPECT_GT(exposureOf(reversed, Seconds(0.5), slow, source, kNaN, {e.residual_V}).at(Quantity::PeakCurrent), peak);
}

TEST(TrainExposure, VoltageOfACurrentSourceIsCappedByCompliance) {
    SourceTraits source = currentSource();
    source.compliance = Volts(80);
    const auto e = exposureOf(milliamps(20), Seconds(1), Load::resistor(Ohms(10'000)), source, kNaN);
    EXPECT_NEAR(e.at(Quantity::PeakVoltage), 80, 1e-12);
    EXPECT_NEAR(e.at(Quantity::CommandVoltage), 200, 1e-9) << "the command is judged uncapped";
    // Phases that clip on a charged load are not balanced: net charge must not read zero.
    const auto rc =
        exposureOf(milliamps(20), Seconds(1), Load::skin(Ohms(1000), Ohms(50'000), Nanofarads(20)), source, kNaN);
    EXPECT_GE(rc.at(Quantity::NetCharge), rc.at(Quantity::PhaseCharge));
}

TEST(TrainExposure, CommandOfACurrentSourceIsJudgedAtTheNominalLoad) {
    const auto e = worstExposure(milliamps(10), Seconds(1), LoadRange::declared(benchRcLoad()), currentSource(), kNaN);
    EXPECT_NEAR(e.at(Quantity::CommandVoltage),
                0.01 * figuresOf("loads").at("bench_load_impedance_ohm").at("current").get<double>(), 1e-6);
    EXPECT_GT(e.at(Quantity::PeakVoltage), 40) << "the worst case is at load_max";
}

TEST(TrainExposure, WorstCaseIsTheLowLoadForVoltsAndTheHighOneForCurrents) {
    const LoadRange range = LoadRange::declared(Load::resistor(Ohms(1000)));
    EXPECT_NEAR(worstExposure(volts(40), Seconds(1), range, voltageSource(), kNaN).at(Quantity::PeakCurrent), 50, 1e-9);
    const auto current = worstExposure(milliamps(10), Seconds(1), range, currentSource(), kNaN);
    EXPECT_NEAR(current.at(Quantity::PeakVoltage), 12, 1e-9);
    EXPECT_NEAR(current.at(Quantity::PulseEnergy), 12 * 0.01 * 4e-4 * 1e3, 1e-9);
}

TEST(TrainExposure, TheSmallestLoadsAreJudgedOverAllOfTheirRange) {
    RecordProperty("hazard", "H1");
    for (int trial = 0; trial <= 60; ++trial) {
        const double ohm = 0.1 + 0.001 * trial;
        const auto range = LoadRange::declared(Load::resistor(Ohms(ohm)));
        const auto worst = worstExposure(volts(0.001), Seconds(1), range, voltageSource(), kNaN);
        EXPECT_NEAR(worst.at(Quantity::PeakCurrent), 1e3 * 0.001 / (0.8 * ohm), 1e-9) << ohm;
        EXPECT_NEAR(impedanceOf(range.min, volts(1), voltageSource()).value(), 0.8 * ohm, 1e-9) << ohm;
    }
}

TEST(TrainExposure, LostContactAndDriftDoNotHideALoad) {
    RecordProperty("hazard", "H1");
    Load load = Load::resistor(Ohms(500));
    load.windowCount = 1;
    load.windows[0] = {0, 100};
    load.openFraction = 1;
    load.driftPerSecond = 1;
    EXPECT_NEAR(exposureOf(volts(40), Seconds(0.5), load, voltageSource(), kNaN).at(Quantity::PeakCurrent), 80, 1e-9);
}

TEST(TrainExposure, WhatIsNoTrainIsNoNumber) {
    PulseTrain train = volts(kNaN);
    for (const double value : exposureOf(train, Seconds(1), Load::resistor(Ohms(1000)), voltageSource(), 1).values) {
        EXPECT_TRUE(std::isnan(value));
    }
    for (const double interval : {kNaN, 0.0, -1.0, 0.005}) {
        EXPECT_TRUE(std::isnan(into(500, volts(10), interval).at(Quantity::PeakCurrent))) << interval;
    }
    EXPECT_TRUE(std::isnan(worse(into(500, volts(10), 1), into(500, volts(10), kNaN)).at(Quantity::PeakCurrent)));
}

TEST(ExposureTable, ListsEveryLimitAndSaysWhatWasNotEvaluated) {
    RecordProperty("hazard", "H9");
    GateSetup setup = benchSetup(Load::resistor(Ohms(500)));
    setup.limits = limitSets();
    auto rows = exposureTable(setup, volts(40), Seconds(0.5));
    int densities = 0;
    for (const auto& row : rows) {
        if (!needsArea(row.quantity)) {
            EXPECT_TRUE(row.evaluated) << keyOf(row.quantity);
            EXPECT_TRUE(row.within) << keyOf(row.quantity);
        } else {
            ++densities;
            EXPECT_FALSE(row.evaluated);
            EXPECT_FALSE(row.within) << "not evaluated is not a pass";
            EXPECT_FALSE(row.reason.empty());
        }
    }
    EXPECT_EQ(densities, 2);
    for (const auto shown : {Quantity::NetCharge, Quantity::RmsCurrentTrain, Quantity::RmsCurrent1s}) {
        const auto row = std::find_if(rows.begin(), rows.end(), [&](const auto& r) { return r.quantity == shown; });
        ASSERT_NE(row, rows.end()) << keyOf(shown);
        EXPECT_TRUE(std::isnan(row->limit)) << keyOf(shown) << " is shown without a limit";
    }
    setup.ceilings.push_back({Quantity::NetCharge, 1});
    rows = exposureTable(setup, volts(40), Seconds(0.5));
    EXPECT_EQ(std::count_if(rows.begin(), rows.end(), [](const auto& r) { return r.quantity == Quantity::NetCharge; }),
              1)
        << "with a limit of its own it stands there once";
    setup.ceilings.clear();

    setup.electrodeArea = SquareCentimetres(0.5);
    rows = exposureTable(setup, volts(40), Seconds(0.5));
    for (const auto& row : rows) EXPECT_TRUE(row.evaluated);
    const auto density =
        std::find_if(rows.begin(), rows.end(), [](const auto& r) { return r.quantity == Quantity::CurrentDensity; });
    EXPECT_FALSE(density->within) << "5.66 mA/cm² is above the warning at 2";
    EXPECT_EQ(density->action, LimitAction::Warn);
}

TEST(ExposureTable, TheFirstRowThatForbidsIsTheOneThatTheGateNames) {
    RecordProperty("hazard", "H1");
    ExposureRow row;
    EXPECT_FALSE(forbids(row)) << "without an area the gate judges no density";
    row.evaluated = true;
    EXPECT_TRUE(forbids(row));
    row.action = LimitAction::Warn;
    EXPECT_FALSE(forbids(row));
    row.action = LimitAction::Refuse;
    row.within = true;
    EXPECT_FALSE(forbids(row));

    GateSetup setup = benchSetup(Load::resistor(Ohms(1000)));
    setup.limits = limitSets();
    EXPECT_EQ(firstForbidding(exposureTable(setup, volts(40), Seconds(0.5))), nullptr);
    EXPECT_EQ(forbiddenBy(setup, volts(40), Seconds(0.5)), "");
    setup.load = LoadRange::declared(Load::resistor(Ohms(100)));
    const auto rows = exposureTable(setup, volts(40), Seconds(0.5));
    const auto* first = firstForbidding(rows);
    ASSERT_NE(first, nullptr);
    EXPECT_TRUE(std::none_of(rows.data(), first, forbids));
    EXPECT_TRUE(forbiddenBy(setup, volts(40), Seconds(0.5)).starts_with(titleOf(first->quantity)));
    VirtualClock clock;
    SafetyGate gate(clock);
    ASSERT_TRUE(gate.configure(setup));
    EXPECT_THAT(gate.approve(TrainRequest{volts(40), Seconds(0.5), Instant(0)}),
                refusedSaying(testing::StartsWith(titleOf(first->quantity))));
}

TEST(ExposureTable, TheImpedanceIsThatOfAPulseOfAnyHeight) {
    const auto skin = Load::skin(Ohms(500), Ohms(10'000), Nanofarads(30));
    for (const auto drive : {Drive::Current, Drive::Voltage}) {
        SourceTraits source;
        source.drive = drive;
        const auto ohms = impedanceOf(skin, volts(40), source);
        const auto higher = segmentsOf(trainAt(volts(3), drive, 7), source.gap).items[0];
        EXPECT_NEAR(ohms.value(), effectiveImpedance(skin, higher).value(), 1e-6);
        EXPECT_GT(ohms, Ohms(500));
    }
}

/// Returns the RMS over 1 s in mA of trains of `range`, one per `interval`. Phase width, gap and rate lie at `share` of
/// the way from the sparsest to the densest train.
double deliveredRms1s(const TrainRange& range, double share, Seconds interval, const Body& body) {
    PulseTrain train = range.densest;
    const auto between = [share](Micros a, Micros b) { return Micros(a.count() + share * (b.count() - a.count())); };
    train.phaseWidth = between(range.sparsest.phaseWidth, range.densest.phaseWidth);
    train.interPhaseGap = between(range.sparsest.interPhaseGap, range.densest.interPhaseGap);
    train.rate = range.sparsest.rate + share * (range.densest.rate - range.sparsest.rate);
    IndependentBody into;
    into.fit(body);
    for (int k = 0; k * interval.count() < 3; ++k) into.deliver(train, Drain{false, 1e9}, k * interval.count());
    return std::sqrt(into.worstI2(1)) * 1e3;
}

// Found by random sequences (seed 15015339447500123333): phases of 28 us, pulses 29.7 us apart, ± 4 %. A longer phase
// adds charge but shortens the rest in which charge flows back, so the worst width lies in between.
TEST(TrainExposure, ThePhaseWidthThatIsWorstMayLieBetweenItsBounds) {
    RecordProperty("hazard", "H1");
    PulseTrain train = milliamps(2.0391);
    train.shape = PulseShape::Monophasic;
    train.pulses = 7;
    train.rate = Hertz(33651.6);
    TrainRange range{train, train};
    range.sparsest.phaseWidth = Micros(26.75);
    range.densest.phaseWidth = Micros(29.25);
    const Body body{142.9, 2905, 11.778e-9};
    const Seconds interval(0.307);
    const Load load = Load::skin(Ohms(body.rs), Ohms(body.rp), Nanofarads(body.c * 1e9));
    SourceTraits source = currentSource();
    source.gap = GapState::HoldsZero;
    const auto rms1s = [&](const auto& out) {
        return exposureOf(out, interval, load, source, kNaN).at(Quantity::RmsCurrent1s);
    };
    double most = 0;
    for (int k = 0; k <= 50; ++k) most = std::max(most, deliveredRms1s(range, k / 50.0, interval, body));
    EXPECT_GT(most, 1.01 * std::max(rms1s(range.sparsest), rms1s(range.densest))) << "the ends do not hold it";
    EXPECT_GE(rms1s(range), most);
    EXPECT_LE(rms1s(range), 1.35 * most) << "a bound that refuses too much";
}

// With skin and a stimulator of unstated accuracy (± 5 %), the bound over the range is close.
TEST(TrainExposure, TheBoundOverARangeIsCloseWhereTheLoadRestsBetweenPulses) {
    RecordProperty("hazard", "H1");
    const Body body{500, 10'000, 50e-9};
    const Load load = Load::skin(Ohms(body.rs), Ohms(body.rp), Nanofarads(body.c * 1e9));
    for (const PulseShape shape : {PulseShape::SymmetricBiphasic, PulseShape::AsymmetricBiphasic}) {
        PulseTrain train = milliamps(5);
        train.shape = shape;
        train.rechargeRatio = 4;
        train.phaseWidth = Micros(200);
        train.interPhaseGap = Micros(50);
        train.pulses = 5;
        train.rate = Hertz(300);
        TrainRange range{train, train};
        range.sparsest.phaseWidth = Micros(190);
        range.densest.phaseWidth = Micros(210);
        range.sparsest.interPhaseGap = Micros(47.5);
        range.densest.interPhaseGap = Micros(52.5);
        range.sparsest.rate = Hertz(285);
        range.densest.rate = Hertz(315);
        SourceTraits source = currentSource();
        source.gap = GapState::HoldsZero;
        const auto bound = exposureOf(range, Seconds(0.5), load, source, kNaN).at(Quantity::RmsCurrent1s);
        double most = 0;
        for (int k = 0; k <= 10; ++k) most = std::max(most, deliveredRms1s(range, k / 10.0, Seconds(0.5), body));
        EXPECT_GE(bound, most);
        EXPECT_LE(bound, 1.01 * most);
    }
}

TEST(TrainExposure, IntoAResistorTheDensestTrainIsTheWorst) {
    RecordProperty("hazard", "H1");
    Dice dice(20261130);
    for (int k = 0; k < 2'000; ++k) {
        const bool current = dice.chance(0.5);
        PulseTrain train = current ? milliamps(dice.decade(0.1, 100)) : volts(dice.decade(1, 40));
        drawPulse(train, dice, Micros(4000));
        train.pulses = 1 + static_cast<int>(300 * dice.unit());
        train.rate = Hertz(1 / (1.2 * train.pulseDuration().count() * dice.decade(1, 100)));
        SourceTraits source = current ? currentSource() : voltageSource();
        source.gap = dice.chance(0.5) ? GapState::HoldsZero : GapState::HighImpedance;
        source.compliance = Volts(dice.decade(10, 1000));
        const Load load = Load::resistor(Ohms(dice.decade(60, 20'000)));
        const Seconds interval(1.1 * train.duration().count());
        const auto of = [&](double width, double gap, double rate) {
            PulseTrain out = train;
            out.phaseWidth *= width;
            out.interPhaseGap *= gap;
            out.rate *= rate;
            return exposureOf(out, interval, load, source, 1);
        };
        const auto worst = of(1.05, 1.05, 1.05);
        for (const double width : {0.95, 1.05}) {
            for (const double gap : {0.95, 1.05}) {
                for (const double rate : {0.95, 1.05}) {
                    const auto some = of(width, gap, rate);
                    for (std::size_t q = 0; q < kQuantityCount; ++q)
                        ASSERT_LE(some.values[q], worst.values[q] * (1 + 1e-12) + 1e-12) << k << ' ' << q;
                    ASSERT_LE(some.in1s.currentSquared_A2s, worst.in1s.currentSquared_A2s * (1 + 1e-12)) << k;
                    ASSERT_LE(some.in5s.dissipated_J, worst.in5s.dissipated_J * (1 + 1e-12)) << k;
                }
            }
        }
    }
}

// Found by an uphill search: width, gap and rate are off by at most 5 %, and the net charges, all of one sign, are
// largest at a width between its bounds.
TEST(TrainExposure, TheChargeOver5sMayBeLargestBetweenTheBounds) {
    RecordProperty("hazard", "H1");
    GateSetup setup;
    setup.source = voltageSource();
    setup.source.gap = GapState::HighImpedance;
    setup.source.accuracy = {Spread{}, {}, {}, Spread{}, {}};
    const Load load = Load::skin(Ohms(1924.5786), Ohms(29690.573), Nanofarads(582.6018919));
    const Seconds interval(1.66795904008);
    PulseTrain train = volts(20);
    train.phaseWidth = Micros(1624.175547);
    train.interPhaseGap = Micros(0);
    train.pulses = 10;
    train.rate = Hertz(194.910293047);
    const auto dcOf = [&](const auto& out) { return exposureOf(out, interval, load, setup.source, kNaN); };
    const double judged = DeliveryBounds(setup).worst(train, LoadRange::declared(load), dcOf).at(Quantity::DcCurrent);
    train.phaseWidth = Micros(1623.5638);
    train.rate = Hertz(185.164778);
    const double truth = dcOf(train).at(Quantity::DcCurrent);
    EXPECT_GE(judged, truth);
    EXPECT_LE(judged, 1.02 * truth);
}

// A capacitor that hardly leaks: a phase charges it towards ten thousand times the voltage finally reached.
TEST(TrainExposure, OfALoadThatHardlyLeaksTheBoundIsKnown) {
    RecordProperty("hazard", "H1");
    GateSetup setup;
    setup.source = currentSource();
    setup.source.gap = GapState::HighImpedance;
    setup.source.accuracy = StatedAccuracy::exact();
    setup.source.accuracy.rate.reset();
    const Load load = Load::skin(Ohms(1515.7240587), Ohms(212968.696961734), Nanofarads(18496.298933382852));
    PulseTrain train = milliamps(1.1847701157896072);
    train.phaseWidth = Micros(352.55408430926536);
    train.interPhaseGap = Micros(0);
    train.pulses = 4;
    train.rate = Hertz(4.0000023065385486);
    const auto judged = DeliveryBounds(setup).worst(train, LoadRange::declared(load), [&](const auto& out) {
        return exposureOf(out, Seconds(1.05263097196389), load, setup.source, kNaN);
    });
    EXPECT_GT(judged.at(Quantity::RmsCurrent1s), 0);
}

// For any phase width, gap and rate between their bounds. The charge over 5 s is the other model's: a bound that adds
// magnitudes may be larger between the ends, but the charge itself is not.
TEST(TrainExposure, NothingThatMayComeOutGivesMoreThanIsJudged) {
    RecordProperty("hazard", "H1");
    Dice dice(20261201);
    const int count = trials<int>({.local = 2'000, .ci = 5'000, .campaign = 200'000});
    int close = 0;
    for (int k = 0; k < count; ++k) {
        LongTrain some = LongTrain::drawn(dice, 0.5, {5e-9, 2e-6});
        drawPulse(some.train, dice, Micros(4000));
        some.train.pulses = 1 + static_cast<int>(40 * dice.unit());
        some.train.rate = Hertz(1 / (some.train.pulseDuration().count() * dice.decade(1.12, 30)));
        const Seconds interval(some.train.duration() * dice.decade(1.06, 10));
        GateSetup setup;
        setup.source = some.source;
        setup.source.accuracy = StatedAccuracy::exact();
        auto& accuracy = setup.source.accuracy;
        accuracy.phaseWidth = accuracy.gap = accuracy.rate = Spread{0.05, 0};
        const auto judged = DeliveryBounds(setup).worst(
            some.train, LoadRange::declared(some.load()),
            [&](const auto& out) { return exposureOf(out, interval, some.load(), some.source, 1); });
        const auto off = [&] { return dice.chance(0.5) ? (dice.chance(0.5) ? 0.95 : 1.05) : 0.95 + 0.1 * dice.unit(); };
        for (int tries = 0; tries < 3; ++tries) {
            PulseTrain out = some.train;
            out.phaseWidth *= off();
            out.interPhaseGap *= off();
            out.rate *= off();
            const auto truth = exposureOf(out, interval, some.load(), some.source, 1);
            LongTrain delivered = some;
            delivered.train = out;
            const double quadrature = 2e-6 * judged.at(Quantity::PhaseCharge) * 1e-6 * out.pulses;
            ASSERT_LE(delivered.delivered().charge5s(), judged.in5s.netCharge_C + quadrature) << k;
            for (std::size_t q = 0; q < kQuantityCount; ++q) {
                if (q == indexOf(Quantity::DcCurrent)) continue;
                ASSERT_LE(truth.values[q], judged.values[q] * (1 + 1e-9) + 1e-12) << k << ' ' << q;
                close += truth.values[q] > 0.99 * judged.values[q] ? 1 : 0;
            }
            ASSERT_LE(truth.residual_V, judged.residual_V * (1 + 1e-9) + 1e-12) << k;
        }
    }
    EXPECT_GT(close, 14 * count) << "a bound that refuses too much";
}

// A fast clock puts more pulses into a second, and leaves less rest in which their charge flows back.
TEST(TrainExposure, NoTrainOfARangeOfRatesHoldsMoreThanIsBooked) {
    RecordProperty("hazard", "H1");
    Dice dice(20261129);
    int close = 0, tried = 0;
    for (int k = 0; k < 2'000; ++k) {
        LongTrain some = LongTrain::drawn(dice, 0.5, {5e-9, 2e-6});
        some.train.shape = dice.unit() < 0.5 ? PulseShape::SymmetricBiphasic : PulseShape::Monophasic;
        some.train.phaseWidth = Micros(dice.decade(20, 400'000));
        const int periods = 1 + static_cast<int>(8 * dice.unit());
        some.train.pulses = periods + 1 + static_cast<int>(4 * dice.unit());
        TrainRange range{some.train, some.train};
        range.densest.rate = Hertz(periods / (1 + dice.decade(1e-8, 1e-2)));
        range.sparsest.rate = range.densest.rate * (0.95 / 1.05);
        if (!validate(range.densest)) continue;
        ++tried;
        const TrainSums booked = some.booked(range);
        for (const double share : {0.0, dice.unit(), 1.0}) {
            some.train.rate = range.sparsest.rate + share * (range.densest.rate - range.sparsest.rate);
            const IndependentBody truth = some.delivered();
            constexpr double kSlack = 1 + 2e-6;  // quadrature error of the other model
            ASSERT_LE(truth.worstI2(1), booked.currentSquared_A2s * kSlack) << k;
            ASSERT_LE(truth.worstEnergy(1), (booked.dissipated_J + booked.stored_J) * kSlack) << k;
            close += truth.worstI2(1) > 0.99 * booked.currentSquared_A2s ? 1 : 0;
        }
    }
    EXPECT_GT(close, tried / 2) << "a bound that refuses too much, or nothing was tried";
}

}  // namespace tacto::test
