#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <numbers>

#include "tests/measure/CaptureProperty.h"
#include "tests/measure/SyntheticPulses.h"

namespace tacto::test {

namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

class Dice {
public:
    Dice(CaptureKind kind, std::uint64_t seed) : random_(seed, nameOf(kind)) {}
    bool chance(double share) { return random_.uniform() < share; }
    double between(double low, double high) { return low + (high - low) * random_.uniform(); }
    double logBetween(double low, double high) {
        return low >= high ? low : low * std::exp(std::log(high / low) * random_.uniform());
    }
    /// Returns a number from low to high, both included.
    int integer(int low, int high) {
        return high <= low ? low : low + static_cast<int>(random_.below(static_cast<std::uint64_t>(high - low + 1)));
    }
    int sign() { return chance(0.5) ? 1 : -1; }
    double normal() { return random_.normal(); }

private:
    Random random_;
};

/// A pulse of height 1 with its first edge at time 0. Times are in samples.
struct UnitPulse {
    std::vector<SyntheticPhase> phases;
    double lowest = -kNever, highest = kNever;  ///< limits of a range that is not stated

    [[nodiscard]] double before() const { return StepResponse(phases.front()).before_s(); }
    [[nodiscard]] double after() const { return StepResponse(phases.front()).after_s(); }
    [[nodiscard]] double length() const { return phases.back().onset_s + phases.back().width_s; }
    [[nodiscard]] double shortest() const {
        double least = kNever;
        for (const auto& phase : phases) least = std::min(least, phase.width_s);
        return least;
    }
    /// Returns the height of the shallower phase.
    [[nodiscard]] double lesser() const {
        double least = kNever;
        for (const auto& phase : phases) least = std::min(least, std::abs(phase.level));
        return least;
    }
};

class UnitWave {
public:
    explicit UnitWave(const UnitPulse& pulse) : pulse_(pulse) {
        for (const auto& phase : pulse.phases) steps_.emplace_back(phase);
    }
    /// Returns the value at the input of the oscilloscope.
    [[nodiscard]] double before(double t) const {
        double value = 0;
        for (std::size_t k = 0; k < steps_.size(); ++k) value += valueAt(pulse_.phases[k], steps_[k], t);
        return value;
    }
    [[nodiscard]] double at(double t) const { return std::clamp(before(t), pulse_.lowest, pulse_.highest); }
    /// Returns a time at which |wave| passes `level` between the two times; one of them, if there are several.
    [[nodiscard]] double passes(double level, int sign, double from, double to) const {
        const bool rising = sign * at(from) < level;
        for (int k = 0; k < 60; ++k) {
            const double middle = 0.5 * (from + to);
            ((sign * at(middle) < level) == rising ? from : to) = middle;
        }
        return 0.5 * (from + to);
    }
    /// Returns the first time, in a thousandth of the way to `to`, at which the value is below `level`.
    [[nodiscard]] double firstBelow(double level, int sign, double from, double to) const {
        const double step = (to - from) / 1000;
        double t = from;
        for (int k = 0; k < 1000 && sign * at(t) >= level; ++k) t += step;
        return t;
    }
    [[nodiscard]] double integral(double from, double to, double step) const {
        const int n = std::clamp(static_cast<int>((to - from) / step), 100, 40'000);
        double sum = 0;
        for (int k = 0; k < n; ++k) sum += at(from + (to - from) * (k + 0.5) / n);
        return sum * (to - from) / n;
    }

private:
    const UnitPulse& pulse_;
    std::vector<StepResponse> steps_;
};

TruePhase truthOf(const UnitPulse& pulse, std::size_t k) {
    const UnitWave wave(pulse);
    const auto& phase = pulse.phases[k];
    const int sign = phase.level > 0 ? 1 : -1;
    const auto middleOf = [&](std::size_t j) { return pulse.phases[j].onset_s + 0.5 * pulse.phases[j].width_s; };
    const double middle = middleOf(k);
    const double from = k == 0 ? -pulse.before() - 1 : middleOf(k - 1);
    const bool last = k + 1 == pulse.phases.size();
    const double to = last ? phase.onset_s + 1.5 * phase.width_s : middleOf(k + 1);
    TruePhase truth{phase.level, phase.onset_s, phase.onset_s + phase.width_s, 0};
    for (int pass = 0; pass < 6; ++pass) {
        constexpr int kPoints = 300;
        double sum = 0, least = kNever, most = -kNever;
        for (int j = 0; j < kPoints; ++j) {
            const double value =
                sign * wave.at(truth.onset_s + (truth.end_s - truth.onset_s) * (0.3 + 0.6 * (j + 0.5) / kPoints));
            sum += value;
            least = std::min(least, value);
            most = std::max(most, value);
        }
        truth.plateau = sum / kPoints;
        truth.uneven = most - least;
        truth.onset_s = wave.passes(0.5 * truth.plateau, sign, from, middle);
        truth.end_s = wave.passes(0.5 * truth.plateau, sign, middle, to);
    }
    truth.again = std::max(std::abs(truth.onset_s - wave.firstBelow(0.5 * truth.plateau, sign, middle, from)),
                           std::abs(truth.end_s - wave.firstBelow(0.5 * truth.plateau, sign, middle, to)));
    const auto riseAt = [&](double t) {
        const double h = 0.02 * std::max(1.0, phase.edge_s);
        return 2 * h * truth.plateau / std::max(std::abs(wave.at(t + h) - wave.at(t - h)), 1e-12);
    };
    truth.rise = std::min(std::max(riseAt(truth.onset_s), riseAt(truth.end_s)), 4 * phase.width_s);
    const double halfBefore = k == 0
                                  ? -pulse.before() - 1
                                  : 0.5 * (pulse.phases[k - 1].onset_s + pulse.phases[k - 1].width_s + phase.onset_s);
    const double halfAfter = last ? phase.onset_s + phase.width_s + pulse.after()
                                  : 0.5 * (phase.onset_s + phase.width_s + pulse.phases[k + 1].onset_s);
    truth.charge = wave.integral(halfBefore, halfAfter, 0.05 * std::min(1.0, 10 * std::max(phase.edge_s, 0.1)));
    truth.plateau *= sign;
    return truth;
}

/// The values drawn before sampling. Times are in samples; the height of a pulse is `amplitude`.
struct Plan {
    double rate_hz = 1e6;
    std::size_t samples = 0;
    double start_s = 0;
    UnitPulse unit;
    double amplitude = 1;
    std::vector<double> onsets;
    std::vector<double> scales;  ///< one per pulse
    double offset = 0, noise = 0, lsb = 0, codePhase = 0;
    double low = -kNever, high = kNever;  ///< in volts
    bool statesRange = false;
    std::function<double(double)> under;  ///< drift, or the whole signal if there are no pulses
    double slope = 0;                     ///< the steepest slope, per sample
    double driftHeight = 0, driftTurns = 0;
    std::vector<std::pair<std::size_t, double>> spikes;
    std::vector<std::size_t> missing;
    std::string text;
};

double interestingPlace(Dice& dice, double samples) {
    static constexpr std::array kParts{2, 3, 4, 5, 8, 10, 16, 20, 32, 50, 64, 100, 128, 200, 256};
    const int parts = kParts[static_cast<std::size_t>(dice.integer(0, kParts.size() - 1))];
    const double part = std::round(samples * dice.integer(0, parts) / parts);
    return part + dice.integer(-3, 3);
}

/// Returns the position of an edge between two samples.
double placeWithin(Dice& dice) {
    if (dice.chance(0.5)) return dice.between(0, 1);
    return dice.chance(0.5) ? 0.5 : 0.01;
}

void drawRecord(Dice& dice, Plan& plan) {
    plan.rate_hz = dice.logBetween(10e3, 50e6);
    if (dice.chance(0.5)) {  // as in a real instrument
        const double decade = std::pow(10, std::floor(std::log10(plan.rate_hz)));
        plan.rate_hz = decade * std::array{1.0, 2.0, 2.5, 5.0}[static_cast<std::size_t>(dice.integer(0, 3))];
    }
    static constexpr std::array<std::size_t, 8> kUsual{1000, 1200, 2000, 2500, 5000, 6000, 10'000, 20'000};
    plan.samples = dice.chance(0.6) ? kUsual[static_cast<std::size_t>(dice.integer(0, kUsual.size() - 1))]
                                    : static_cast<std::size_t>(dice.logBetween(1000, 20'000));
    const double length_s = static_cast<double>(plan.samples) / plan.rate_hz;
    if (dice.chance(0.6)) plan.start_s = dice.chance(0.5) ? -0.5 * length_s : dice.between(-2, 2) * length_s;
    plan.amplitude = dice.chance(0.3) ? 40 : dice.logBetween(5e-3, 400);
}

/// Draws straight, exponential or ringing edges. `mostRinging`: the largest first overshoot.
void drawEdges(Dice& dice, Plan& plan, double mostRinging, double rest = kNever) {
    const double width = std::min(plan.unit.shortest(), rest);
    const double what = dice.between(0, 1);
    SyntheticPhase edge;
    edge.edge_s = 1e-3;
    if (what > 0.7 && width >= 40) {
        edge.ringing = dice.between(0.02, mostRinging);
        edge.ringingPeriod_s = dice.logBetween(4, width / 8);
    } else if (what > 0.55 && width >= 20) {
        edge.tau_s = dice.logBetween(0.2, width / (rest < kNever ? 20 : dice.chance(0.8) ? 12 : 6));
    } else if (what > 0.25) {
        edge.edge_s = dice.logBetween(0.3, 0.2 * width);
    }
    if (dice.chance(0.15)) edge.droop = dice.chance(0.5) ? dice.between(0, 0.02) : dice.between(0.02, 0.15);
    for (auto& phase : plan.unit.phases) {
        phase.edge_s = edge.edge_s;
        phase.tau_s = edge.tau_s;
        phase.ringing = edge.ringing;
        phase.ringingPeriod_s = edge.ringingPeriod_s;
        phase.droop = edge.droop;
    }
    plan.text += edge.ringing > 0
                     ? fmt::format(", ringing {:.0f} % of {:.1f} samples", 100 * edge.ringing, edge.ringingPeriod_s)
                 : edge.tau_s > 0 ? fmt::format(", tau {:.1f} samples", edge.tau_s)
                                  : fmt::format(", edge {:.1f} samples", edge.edge_s);
    if (edge.droop > 0) plan.text += fmt::format(", droop {:.1f} %", 100 * edge.droop);
}

void drawConverter(Dice& dice, Plan& plan) {
    if (dice.chance(0.75)) {
        plan.lsb = plan.amplitude / dice.logBetween(20, 2000);
        plan.codePhase = dice.chance(0.3) ? 0 : dice.between(0, 1);
    }
    const double what = dice.between(0, 1);
    if (what > 0.65) {
        plan.noise = plan.amplitude / dice.logBetween(6, 1000);
    } else if (what > 0.3 && plan.lsb > 0) {
        plan.noise = plan.lsb * dice.logBetween(0.05, 1);
    }
    plan.text += plan.lsb > 0 ? fmt::format(", {:.1f} codes high", plan.amplitude / plan.lsb) : ", fine";
    plan.text += plan.noise > 0 ? fmt::format(", noise 1/{:.0f}", plan.amplitude / plan.noise) : ", no noise";
}

/// Draws successive pulses with at least `rest` samples between and around them, as many as fit.
void drawOnsets(Dice& dice, Plan& plan, int most, double rest) {
    const double n = static_cast<double>(plan.samples);
    const double length = plan.unit.length();
    const double margin = std::max({20.0, rest, plan.unit.before() + 1});
    const int fit = std::max(1, static_cast<int>((n - 2 * margin + rest) / (length + rest)));
    const int pulses = dice.chance(0.4) ? 1 : static_cast<int>(dice.logBetween(1, std::min(most, fit)));
    const double longest = pulses > 1 ? (n - 2 * margin - length) / (pulses - 1) : 0;
    const double period = pulses > 1 ? dice.between(std::min(length + rest, longest), longest) : 0;
    const double latest = n - margin - length - (pulses - 1) * period;
    double first = dice.between(margin, std::max(latest, margin));
    if (dice.chance(0.4)) {
        const double place = interestingPlace(dice, n);
        if (place > margin && place < latest) first = place;
    }
    first = std::floor(first) + placeWithin(dice);
    for (int k = 0; k < pulses; ++k) {
        plan.onsets.push_back(first + k * period);
        plan.scales.push_back(1);
    }
    plan.text += fmt::format(", {} from sample {:.2f} every {:.1f}", pulses, first, period);
}

/// Returns the width of a phase; occasionally too short to be measured.
double drawWidth(Dice& dice, const Plan& plan, double parts) {
    if (dice.chance(0.06)) return dice.between(3, 12);  // a phase with even fewer samples may be a disturbance
    return dice.logBetween(12, std::max(13.0, static_cast<double>(plan.samples) / parts));
}

void biphasicUnit(Dice& dice, Plan& plan, double width, double gap, double times) {
    const int sign = dice.sign();
    SyntheticPhase first, second;
    first.onset_s = 0;
    first.width_s = width;
    first.level = sign;
    second.onset_s = width + gap;
    second.width_s = width * times;
    second.level = -sign / times;
    plan.unit.phases = {first, second};
    plan.text += fmt::format(", {}width {:.2f}, gap {:.2f} samples", sign < 0 ? "down first, " : "", width, gap);
    if (times > 1) plan.text += fmt::format(", recharge 1/{:.1f}", times);
}

void anyBiphasicUnit(Dice& dice, Plan& plan, bool recharge) {
    const double times = recharge ? dice.between(3, 10) : 1;
    const double width = drawWidth(dice, plan, recharge ? 30 : 8);
    const double longest = std::min(3 * width, 0.9e-3 * plan.rate_hz);  // phases up to 1 ms apart form one pulse
    double gap = dice.chance(0.7) ? dice.logBetween(std::min(4.0, longest), longest) : dice.between(0, 4);
    gap = std::min(gap, longest);
    biphasicUnit(dice, plan, width, gap, times);
}

void monophasicUnit(Plan& plan, double width, int sign) {
    SyntheticPhase phase;
    phase.onset_s = 0;
    phase.width_s = width;
    phase.level = sign;
    plan.unit.phases = {phase};
    plan.text += fmt::format(", {}width {:.2f} samples", sign < 0 ? "down, " : "", width);
}

double share(const Plan& plan) {
    double busy = 0;
    for (const auto& phase : plan.unit.phases) busy += phase.width_s;
    return busy * static_cast<double>(plan.onsets.size()) / static_cast<double>(plan.samples);
}

/// Sets an offset. If the baseline is unclear, StateLevels.h takes the state near zero for it.
void monophasicOffset(Dice& dice, Plan& plan, int sign) {
    double offset = dice.chance(0.4) ? dice.between(-0.05, 0.05) : dice.between(-3, 3);
    if (share(plan) > 0.07) {
        if (sign < 0) offset = dice.between(-0.05, 0.05);
        if (std::abs(offset + 1) < 0.2) offset = 0.5;
    }
    plan.offset = offset * plan.amplitude;
    plan.text += fmt::format(", offset {:.2f}", offset);
}

void anyOffset(Dice& dice, Plan& plan) {
    const double offset = dice.chance(0.5) ? 0 : dice.between(-3, 3);
    plan.offset = offset * plan.amplitude;
    plan.text += fmt::format(", offset {:.2f}", offset);
}

/// Draws a pulse of any shape.
void anyUnit(Dice& dice, Plan& plan, double parts = 12) {
    if (dice.chance(0.6)) {
        anyBiphasicUnit(dice, plan, false);
    } else {
        monophasicUnit(plan, drawWidth(dice, plan, parts), dice.sign());
    }
}

void offsetFor(Dice& dice, Plan& plan) {
    if (plan.unit.phases.size() == 1) {
        monophasicOffset(dice, plan, plan.unit.phases[0].level > 0 ? 1 : -1);
    } else {
        anyOffset(dice, plan);
    }
}

/// Returns a rest long enough for the edges to settle; otherwise the baseline would be undefined.
double restOf(Dice& dice, const Plan& plan) {
    const double settled = 0.5 * plan.unit.after();
    return settled + (dice.chance(0.7) ? std::max(20.0, plan.unit.length()) : std::max(6.0, 0.3 * plan.unit.length()));
}

void drawSquare(Dice& dice, Plan& plan) {
    const double period = dice.logBetween(40, static_cast<double>(plan.samples) / 2.5);
    const double duty = dice.between(0.2, 0.8);
    const double where = dice.between(0, 1);
    const int sign = where > 0.2 && where < 0.4 ? -1 : 1;
    monophasicUnit(plan, sign > 0 ? duty * period : (1 - duty) * period, sign);
    drawEdges(dice, plan, 0.3, std::min(duty, 1 - duty) * period);
    // Lower level: at zero, one height below it, half a height below it, or far away.
    const double lower = where < 0.2    ? dice.between(-0.05, 0.05)
                         : where < 0.4  ? dice.between(-1.05, -0.95)
                         : where < 0.7  ? dice.between(-0.8, -0.2)
                         : where < 0.85 ? dice.between(0.3, 4)
                                        : dice.between(-4, -1.3);
    plan.offset = (sign > 0 ? lower : lower + 1) * plan.amplitude;
    for (double onset = dice.between(-period, 0); onset < static_cast<double>(plan.samples); onset += period) {
        plan.onsets.push_back(onset);
        plan.scales.push_back(1);
    }
    plan.text += fmt::format(", square of {:.2f} samples, duty {:.2f}, from {:.2f} heights", period, duty, lower);
}

void drawUnequal(Dice& dice, Plan& plan) {
    const double least = dice.chance(0.5) ? dice.between(0.6, 1) : dice.between(0.2, 1);
    for (auto& scale : plan.scales) scale = dice.between(least, 1);
    plan.scales[static_cast<std::size_t>(dice.integer(0, static_cast<int>(plan.scales.size()) - 1))] = 1;
    plan.text += ", heights";
    for (std::size_t k = 0; k < std::min<std::size_t>(plan.scales.size(), 6); ++k) {
        plan.text += fmt::format(" {:.2f}", plan.scales[k]);
    }
}

std::size_t drawTrains(Dice& dice, Plan& plan, MeasureOptions& options) {
    const double n = static_cast<double>(plan.samples);
    const double length = plan.unit.length();
    const double rest = restOf(dice, plan);
    const double within = dice.between(length + rest, std::max(length + rest, n / 12));
    const int fit = std::max(1, static_cast<int>((n - 2 * rest) / within));
    const int perTrain = dice.integer(1, std::min(8, std::max(1, fit / 2)));
    const double between = (perTrain + dice.between(1.2, 6)) * within;
    const double margin = std::max(20.0, rest);
    double onset = margin + dice.between(0, within);
    for (; onset + (perTrain - 1) * within + length + margin < n; onset += between) {
        for (int k = 0; k < perTrain; ++k) {
            plan.onsets.push_back(onset + k * within);
            plan.scales.push_back(1);
        }
    }
    if (dice.chance(0.5)) {
        options.intraTrainRate = Hertz(plan.rate_hz / within);
    } else {
        options.trainGap = Seconds(1.1 * within / plan.rate_hz);
    }
    plan.text += fmt::format(", trains of {} every {:.1f}, {:.1f} apart", perTrain, within, between);
    return static_cast<std::size_t>(perTrain);
}

/// Draws the project's own stimulus, which begins at each sample in turn.
void drawOneOnset(Dice& dice, Plan& plan, std::uint64_t seed) {
    static constexpr std::array<std::size_t, 4> kLengths{10'000, 2000, 4096, 10'001};
    static constexpr std::array kParts{2, 3, 4, 5, 6, 8, 10, 16, 20, 32, 64, 100, 128, 200, 256, 512};
    plan.samples = kLengths[seed % kLengths.size()];
    plan.rate_hz = std::array{500e3, 1e6, 2e6, 5e6, 10e6}[static_cast<std::size_t>(dice.integer(0, 4))];
    plan.start_s = dice.chance(0.5) ? 0 : -0.1 * static_cast<double>(plan.samples) / plan.rate_hz;
    plan.amplitude = 40;
    const double n = static_cast<double>(plan.samples);
    if (dice.chance(0.4)) {  // phases of 200 us with a gap of 100 us
        const double width = std::min(200e-6 * plan.rate_hz, n / 5);
        biphasicUnit(dice, plan, width, 0.5 * width, 1);
    } else if (dice.chance(0.6)) {
        const double width = dice.logBetween(12, n / 8);
        biphasicUnit(dice, plan, width, dice.logBetween(4, std::min({width, n / 8, 0.9e-3 * plan.rate_hz})), 1);
    } else {
        monophasicUnit(plan, dice.logBetween(12, n / 8), dice.sign());
    }
    const double length = plan.unit.length();
    const int parts = kParts[seed / 4 % kParts.size()];
    const auto turn = static_cast<int>(seed / 64);
    double place = std::round(n * (1 + turn / 7 % std::max(1, parts - 1)) / parts) + turn % 7 - 3;
    const double margin = std::max(20.0, 0.5 * plan.unit.shortest());
    if (!(place > margin && place < n - margin - length)) place = std::round(dice.between(margin, n - margin - length));
    for (auto& phase : plan.unit.phases) phase.edge_s = dice.chance(0.5) ? 1e-3 : 2;
    plan.onsets = {place - (dice.chance(0.5) ? 0.5 : dice.between(0, 1))};
    plan.scales = {1};
    if (dice.chance(0.6)) {
        plan.lsb = dice.chance(0.5) ? 1.6 : 40 / dice.logBetween(25, 2000);
        plan.codePhase = dice.between(0, 1);
    }
    if (dice.chance(0.6))
        plan.noise = plan.lsb > 0 ? plan.lsb * dice.between(0.05, 0.6) : 40 / dice.logBetween(40, 1000);
    plan.text += fmt::format(", onset {:.2f}, lsb {:.3f}, noise {:.3f}", plan.onsets[0], plan.lsb, plan.noise);
}

void drawEdge(Dice& dice, Plan& plan, std::uint64_t seed) {
    const double n = static_cast<double>(plan.samples);
    SyntheticPhase edge;
    edge.edge_s = dice.chance(0.5) ? 1e-3 : dice.logBetween(0.5, n / 10);
    if (dice.chance(0.25)) {
        edge.ringing = dice.between(0.02, 0.3);
        edge.ringingPeriod_s = dice.logBetween(4, n / 20);
    } else if (dice.chance(0.25)) {
        edge.tau_s = dice.logBetween(0.5, n / 20);
    }
    const int edges = dice.chance(0.8) ? 1 : dice.integer(2, 4);
    std::vector<double> places;
    for (int k = 0; k < edges; ++k) {
        double place = dice.chance(0.5) ? interestingPlace(dice, n) : dice.between(0, n);
        if (edges == 1 && seed % 3 == 0) place = std::round(n / 2) + static_cast<double>(seed / 3 % 9) - 4;
        places.push_back(place - placeWithin(dice));
    }
    const double height = dice.sign() * plan.amplitude;
    plan.offset = dice.chance(0.3) ? 0 : dice.chance(0.5) ? -0.5 * height : dice.between(-2, 2) * height;
    plan.under = [places, step = StepResponse(edge), height](double t) {
        double value = 0;
        for (const double place : places) value += height * step.at(t - place);
        return value;
    };
    drawConverter(dice, plan);
    plan.text +=
        fmt::format(", {} edges, at {:.2f} of {}, {:.1f} samples long, ringing {:.2f} of {:.1f}, tau {:.1f}", edges,
                    places[0], plan.samples, edge.edge_s, edge.ringing, edge.ringingPeriod_s, edge.tau_s);
}

void drawMoving(Dice& dice, Plan& plan) {
    const double n = static_cast<double>(plan.samples);
    const double periods = dice.logBetween(0.5, n / 12), phase = dice.between(0, 1);
    const double a = plan.amplitude;
    const auto turns = [=](double t) { return t / n * periods + phase; };
    const auto fraction = [=](double t) { return turns(t) - std::floor(turns(t)); };
    const int what = dice.integer(0, 5);
    switch (what) {
        case 0:
            plan.under = [=](double t) { return a * t / n; };
            break;
        case 1:
            plan.under = [=](double t) { return 0.5 * a * std::sin(2 * std::numbers::pi * turns(t)); };
            break;
        case 2:
            plan.under = [=](double t) { return a * std::abs(2 * fraction(t) - 1); };
            break;
        case 3:
            plan.under = [=](double t) { return a * fraction(t); };
            break;
        case 4:
            plan.under = [=, tau = n / dice.between(0.5, 4)](double t) { return a * std::exp(-t / tau); };
            break;
        default:  // two sines
            plan.under = [=, second = dice.between(0.1, 1)](double t) {
                return 0.3 * a *
                       (std::sin(2 * std::numbers::pi * turns(t)) +
                        second * std::sin(2 * std::numbers::pi * 2.7 * t / n * std::min(periods, n / 40)));
            };
    }
    static constexpr std::array kNames{"ramp", "sine", "triangle", "sawtooth", "discharge", "two sines"};
    anyOffset(dice, plan);
    drawConverter(dice, plan);
    plan.text += fmt::format(", {} of {:.2f} periods", kNames[static_cast<std::size_t>(what)], periods);
}

void drawQuiet(Dice& dice, Plan& plan) {
    plan.lsb = dice.chance(0.8) ? plan.amplitude / dice.logBetween(20, 2000) : 0;
    plan.codePhase = dice.between(0, 1);
    const double step = plan.lsb > 0 ? plan.lsb : 1e-3 * plan.amplitude;
    if (dice.chance(0.8)) plan.noise = step * dice.logBetween(0.05, 30);
    if (dice.chance(0.2)) {
        // Without noise, fewer than 20 codes form stairs, and each stair is a level.
        const double hum = step * dice.logBetween(plan.noise < 0.3 * step ? 10 : 0.5, 100),
                     turns = dice.logBetween(0.3, 60);
        const double n = static_cast<double>(plan.samples);
        plan.under = [=](double t) { return hum * std::sin(2 * std::numbers::pi * turns * t / n); };
        plan.text += fmt::format(", hum of {:.1f} steps, {:.1f} turns", hum / step, turns);
    }
    anyOffset(dice, plan);
    if (dice.chance(0.1)) plan.samples = static_cast<std::size_t>(dice.integer(0, 20));
    if (dice.chance(0.1)) {
        for (std::size_t k = 0; k < plan.samples; ++k) {
            if (dice.chance(0.5)) plan.missing.push_back(k);
        }
    }
    plan.text += fmt::format(", {} samples, noise {:.2f} steps, {} missing", plan.samples, plan.noise / step,
                             plan.missing.size());
}

/// Returns whether clipping must be reported, measured or not.
bool drawClipping(Dice& dice, Plan& plan) {
    const double top = dice.between(0.3, 1.3);
    const bool both = dice.chance(0.5);
    const int side = dice.sign();
    plan.statesRange = dice.chance(0.6);
    const double height = plan.amplitude * top;
    plan.high = both || side > 0 ? plan.offset + height : plan.offset + 20 * plan.amplitude;
    plan.low = both || side < 0 ? plan.offset - height : plan.offset - 20 * plan.amplitude;
    plan.text += fmt::format(", range {:.2f}{}{}", top,
                             both       ? ""
                             : side > 0 ? " above"
                                        : " below",
                             plan.statesRange ? ", stated" : "");
    const auto asShown = [&](double v) {  // limits are rounded to codes of the converter
        if (plan.lsb > 0) v = plan.lsb * (std::round(v / plan.lsb - plan.codePhase) + plan.codePhase);
        return static_cast<double>(static_cast<float>(v));
    };
    plan.low = asShown(plan.low);
    plan.high = asShown(plan.high);
    if (plan.statesRange) return false;
    // What an unstated range cuts off cannot be known, so the truth is the rest.
    plan.unit.highest = (plan.high - plan.offset) / plan.amplitude;
    plan.unit.lowest = (plan.low - plan.offset) / plan.amplitude;
    const auto reached = [&](const SyntheticPhase& phase) {
        const double limit = phase.level > 0 ? plan.unit.highest : -plan.unit.lowest;
        return std::abs(phase.level) * (1 - phase.droop) > limit + 4 * plan.noise / plan.amplitude;
    };
    return plan.noise > std::max(2 * plan.lsb, plan.amplitude / 300) && plan.unit.shortest() >= 40 &&
           std::any_of(plan.unit.phases.begin(), plan.unit.phases.end(), reached);
}

void drawDisturbances(Dice& dice, Plan& plan) {
    const bool spikes = dice.chance(0.6);
    const int count = dice.integer(1, 5);
    for (int k = 0; k < count; ++k) {
        const auto at = static_cast<std::size_t>(dice.integer(0, static_cast<int>(plan.samples) - 1));
        if (spikes) {
            const double height = plan.amplitude * dice.logBetween(0.1, 5);
            plan.spikes.emplace_back(at, dice.chance(0.5) ? height : -height);
        } else {
            const int run = static_cast<int>(dice.logBetween(1, 30));
            for (std::size_t j = at; j < std::min(plan.samples, at + static_cast<std::size_t>(run)); ++j) {
                plan.missing.push_back(j);
            }
        }
        plan.text += fmt::format(", {} at {}", spikes ? "spike" : "missing", at);
    }
}

void drawDrift(Dice& dice, Plan& plan) {
    const double n = static_cast<double>(plan.samples);
    double height = plan.amplitude * (dice.chance(0.5) ? dice.logBetween(0.003, 0.05) : dice.logBetween(0.05, 0.5));
    const double turns = dice.logBetween(0.2, dice.chance(0.6) ? 1 : 30);
    if (plan.unit.phases.size() == 1 && share(plan) > 0.07) height = std::min(height, 0.05 * plan.amplitude);
    const double phase = dice.between(0, 1);
    plan.driftHeight = height;
    if (dice.chance(0.4)) {
        const int sign = dice.sign();
        plan.under = [=](double t) { return sign * height * (t / n - 0.5); };
        plan.slope = height / n;
        plan.text += fmt::format(", slope of {:.3f} heights", height / plan.amplitude);
    } else {
        plan.under = [=](double t) { return 0.5 * height * std::sin(2 * std::numbers::pi * (turns * t / n + phase)); };
        plan.slope = height * std::numbers::pi * turns / n;
        plan.driftTurns = turns;
        plan.text += fmt::format(", wave of {:.3f} heights, {:.2f} turns", height / plan.amplitude, turns);
    }
}

void drawCut(Dice& dice, Plan& plan) {
    const double n = static_cast<double>(plan.samples);
    const bool atStart = dice.chance(0.5);
    const auto& phases = plan.unit.phases;
    // At the start, the cut lies within a phase: a pulse cut in its gap looks like a whole pulse of the other sign.
    const auto& phase = phases[static_cast<std::size_t>(dice.integer(0, static_cast<int>(phases.size()) - 1))];
    // The rest of the phase is more than a fifth, so that it is not taken for ringing (StateLevels.h).
    const double within = phase.onset_s + phase.width_s * dice.between(0.1, 0.7);
    const double cut = atStart ? within : dice.between(0.1, 0.95) * plan.unit.length();
    const double first = atStart ? -cut : n - cut;
    const double period = std::max(60.0, dice.between(2, 6) * plan.unit.length());
    for (int k = 0; k < dice.integer(1, 30); ++k) {
        const double onset = first + (atStart ? k : -k) * period;
        if (k > 0 && (onset < 20 + period || onset + period > n - 20)) break;
        plan.onsets.push_back(onset);
        plan.scales.push_back(1);
    }
    std::sort(plan.onsets.begin(), plan.onsets.end());
    plan.text += fmt::format(", {}, one cut at its sample {:.1f} {}, every {:.1f}", plan.onsets.size(), cut,
                             atStart ? "before the record" : "behind it", period);
}

/// Returns the capture that an instrument with this plan would deliver.
Capture captureOf(Dice& dice, const Plan& plan) {
    std::vector<double> values(plan.samples, plan.offset);
    const UnitWave wave(plan.unit);
    const double n = static_cast<double>(plan.samples);
    for (std::size_t k = 0; k < plan.onsets.size(); ++k) {
        const double onset = plan.onsets[k];
        const auto from = static_cast<std::size_t>(std::clamp(onset - plan.unit.before() - 1, 0.0, n));
        const auto to =
            static_cast<std::size_t>(std::clamp(onset + plan.unit.length() + plan.unit.after() + 1, 0.0, n));
        for (std::size_t i = from; i < to; ++i) {
            values[i] += plan.scales[k] * plan.amplitude * wave.before(static_cast<double>(i) - onset);
        }
    }
    if (plan.under) {
        for (std::size_t i = 0; i < plan.samples; ++i) values[i] += plan.under(static_cast<double>(i));
    }
    for (const auto& [at, height] : plan.spikes) values[at] += height;
    Capture capture;
    capture.rate_hz = plan.rate_hz;
    capture.start_s = plan.start_s;
    CaptureChannel channel;
    channel.name = "voltage";
    channel.unit = "V";
    channel.samples.reserve(plan.samples);
    for (double v : values) {
        if (plan.noise > 0) v += plan.noise * dice.normal();
        v = std::clamp(v, plan.low, plan.high);
        if (plan.lsb > 0) v = plan.lsb * (std::round(v / plan.lsb - plan.codePhase) + plan.codePhase);
        channel.samples.push_back(static_cast<float>(v));
    }
    for (const auto at : plan.missing) channel.samples[at] = std::numeric_limits<float>::quiet_NaN();
    capture.channels.push_back(std::move(channel));
    return capture;
}

/// Draws tolerances and errors within them; the shown figures have these errors.
void drawStatement(Dice& dice, const Plan& plan, CaptureDraw& draw) {
    auto& channel = draw.capture.channels[0];
    if (plan.statesRange) {
        channel.low = plan.low;
        channel.high = plan.high;
    }
    const bool statesStep = dice.chance(0.6);
    if (statesStep) channel.lsb = plan.lsb > 0 ? plan.lsb : plan.amplitude / 5000;
    if (dice.chance(0.3)) return;
    const auto tolerance = [&](double most) { return dice.chance(0.6) ? 0 : dice.logBetween(0.02 * most, most); };
    channel.gainTolerance = tolerance(0.03);
    channel.probeTolerance = tolerance(0.02);
    channel.offsetTolerance = 0;
    draw.capture.timeBaseTolerance = tolerance(100e-6);
    draw.gain = 1 + channel.gainTolerance * dice.between(-1, 1);
    draw.gain += channel.probeTolerance * dice.between(-1, 1);
    draw.timeBase = 1 + draw.capture.timeBaseTolerance * dice.between(-1, 1);
    draw.statesAll = statesStep;
}

TruePhase inRecord(const TruePhase& unit, const Plan& plan, std::size_t k) {
    const double height = plan.amplitude * plan.scales[k];
    const auto timeOf = [&](double t) { return plan.start_s + (plan.onsets[k] + t) / plan.rate_hz; };
    return {unit.plateau * height,
            timeOf(unit.onset_s),
            timeOf(unit.end_s),
            unit.charge * height / plan.rate_hz,
            unit.rise,
            unit.uneven * height,
            unit.again / plan.rate_hz};
}

/// Notes anything that hinders measuring pulse k, and how far a spike may change its figures.
void markPulse(const Plan& plan, std::size_t k, const std::vector<TruePhase>& unit, TruePulse& pulse) {
    const auto worsen = [&](Presence to) { pulse.presence = std::max(pulse.presence, to); };
    const double n = static_cast<double>(plan.samples);
    const double begin = plan.onsets[k] + unit.front().onset_s, end = plan.onsets[k] + unit.back().end_s;
    const double firstEnd = plan.onsets[k] + unit.front().end_s;
    const double slack = 2 + unit.back().rise;
    if (begin < 1 + slack || end > n - 1 - slack) worsen(Presence::Doubtful);
    if (begin < -1 || end > n) worsen(Presence::Broken);
    if (unit.size() > 1 && begin > slack && firstEnd < n - 1) {
        const double left =
            std::max(0.0, n - plan.onsets[k] - unit.back().onset_s) / (unit.back().end_s - unit.back().onset_s);
        if (std::abs(left * unit.back().charge) < 0.25 * std::abs(unit.front().charge)) {
            pulse.presence = Presence::Doubtful;
            pulse.secondUnseen = true;
        }
    }
    for (const auto& phase : unit) {
        if (phase.again > 0.5) pulse.moreTime_s = std::max(pulse.moreTime_s, phase.again / plan.rate_hz);
        const double width = phase.end_s - phase.onset_s;
        if (width < 11.5) worsen(Presence::Doubtful);
        if (width < 8.9) worsen(Presence::Broken);
    }
    if (std::isfinite(plan.high) && !plan.statesRange) {
        // If a top just reaches the limit, one side of its noise is cut off.
        for (const auto& phase : plan.unit.phases) {
            const double limit = phase.level > 0 ? plan.unit.highest : -plan.unit.lowest;
            if (std::abs(std::abs(phase.level) - limit) * plan.amplitude > 4 * plan.noise) continue;
            pulse.moreAmplitude = 0.5 * plan.noise;
            pulse.moreCharge = std::max(pulse.moreCharge, 0.5 * plan.noise * phase.width_s / plan.rate_hz);
        }
    }
    if (plan.statesRange) {
        const UnitWave wave(plan.unit);
        double least = 0, most = 0;
        for (double t = -1; t < plan.unit.length() + 1; t += std::min(0.5, plan.unit.shortest() / 50)) {
            least = std::min(least, wave.at(t));
            most = std::max(most, wave.at(t));
        }
        const double height = plan.scales[k] * plan.amplitude;
        const double over = std::max(plan.offset + height * most - plan.high, plan.low - plan.offset - height * least);
        const double blur = plan.lsb + 6 * plan.noise + 1e-4 * height;
        if (over > -blur) worsen(Presence::Doubtful);
        // A peak may fall between samples, but a top cannot.
        double top = -kNever;
        for (const auto& phase : unit) {
            top = std::max(top, phase.plateau > 0 ? plan.offset + height * (phase.plateau - phase.uneven) - plan.high
                                                  : plan.low - plan.offset + height * (phase.plateau + phase.uneven));
        }
        if (top > blur) worsen(Presence::Broken);
    }
    for (const auto at_ : plan.missing) {
        const double at = static_cast<double>(at_);
        if (at > begin - slack && at < end + slack) worsen(Presence::Doubtful);
        for (const auto& phase : unit) {
            if (at > plan.onsets[k] + phase.onset_s + 1 && at < plan.onsets[k] + phase.end_s - 1) {
                worsen(Presence::Broken);
            }
        }
    }
    for (const auto& [at_, height] : plan.spikes) {
        const double at = static_cast<double>(at_), reach = plan.unit.length() + 30;
        if (at < begin - reach || at > end + reach) continue;
        worsen(Presence::Doubtful);
        pulse.moreCharge += std::abs(height) / plan.rate_hz;
        for (const auto& phase : unit) {
            const double from = plan.onsets[k] + phase.onset_s, to = plan.onsets[k] + phase.end_s;
            const double near = phase.rise + 2;  // so near an edge that it lengthens the phase
            if (at > from - near && at < to + near) pulse.moreAmplitude += 1.2 * std::abs(height) / (0.6 * (to - from));
            if (std::abs(at - from) < near || std::abs(at - to) < near) pulse.moreTime_s += near / plan.rate_hz;
        }
    }
}

bool isEasy(const Plan& plan) {
    if (plan.onsets.empty() || !plan.spikes.empty() || !plan.missing.empty() || std::isfinite(plan.high) ||
        std::isfinite(plan.low)) {
        return false;
    }
    const auto& phases = plan.unit.phases;
    const double least = *std::min_element(plan.scales.begin(), plan.scales.end());
    const double height = plan.unit.lesser() * plan.amplitude * least;
    const double width = plan.unit.shortest(), length = plan.unit.length(), n = static_cast<double>(plan.samples);
    const auto& edge = phases.front();
    if (least < 0.6 || width < 12 || share(plan) > 0.5) return false;
    if (height < 20 * plan.lsb || height < 20 * std::hypot(plan.noise, plan.lsb / std::sqrt(12))) return false;
    if (phases.size() > 1 && phases[1].onset_s - phases[0].width_s < 4) return false;
    if (edge.ringing > 0.1 || edge.droop > 0.02 || edge.tau_s > width / 10) return false;
    if (edge.ringing * plan.amplitude > 0.25 * height) return false;
    if (plan.driftHeight > 0.05 * height || plan.driftTurns > 1) return false;
    const double rest = std::max(20.0, 0.5 * width);
    if (plan.onsets.front() < rest || plan.onsets.back() + length > n - rest) return false;
    for (std::size_t k = 1; k < plan.onsets.size(); ++k) {
        if (plan.onsets[k] - plan.onsets[k - 1] - length < rest) return false;
    }
    return true;
}

}  // namespace

const char* nameOf(CaptureKind kind) {
    static constexpr std::array kNames{"Biphasic", "Recharge",  "Monophasic", "Square", "Unequal",
                                       "Trains",   "Onsets",    "Edge",       "Moving", "Quiet",
                                       "Clipped",  "Disturbed", "Drifting",   "Cut"};
    return kNames[static_cast<std::size_t>(kind)];
}

CaptureDraw drawCapture(CaptureKind kind, std::uint64_t seed) {
    Dice dice(kind, seed);
    Plan plan;
    CaptureDraw draw;
    drawRecord(dice, plan);
    if (seed % 50 == 0) plan.samples *= 10;  // occasionally a long record
    const auto edges = [&] {
        drawEdges(dice, plan, 0.3);
        if (plan.unit.phases.size() == 1) return;
        // Slow edges may put the phases further apart, from 50 % to 50 %, than the phases of one pulse may be.
        const double gap = truthOf(plan.unit, 1).onset_s - truthOf(plan.unit, 0).end_s;
        if (gap <= 0.95e-3 * plan.rate_hz) return;
        for (auto& phase : plan.unit.phases) phase = {phase.onset_s, phase.width_s, phase.level, 1e-3};
        plan.text += ", or steep";
    };
    const auto pulses = [&](int most) {
        edges();
        drawOnsets(dice, plan, most, restOf(dice, plan));
    };
    switch (kind) {
        case CaptureKind::Biphasic:
        case CaptureKind::Recharge:
            anyBiphasicUnit(dice, plan, kind == CaptureKind::Recharge);
            pulses(60);
            anyOffset(dice, plan);
            break;
        case CaptureKind::Monophasic: {
            const int sign = dice.sign();
            monophasicUnit(plan, drawWidth(dice, plan, 4), sign);
            pulses(60);
            monophasicOffset(dice, plan, sign);
            break;
        }
        case CaptureKind::Square:
            drawSquare(dice, plan);
            break;
        case CaptureKind::Unequal:
            anyUnit(dice, plan, 20);
            pulses(40);
            drawUnequal(dice, plan);
            offsetFor(dice, plan);
            break;
        case CaptureKind::Trains:
            anyUnit(dice, plan, 40);
            edges();
            draw.perTrain = drawTrains(dice, plan, draw.options);
            offsetFor(dice, plan);
            break;
        case CaptureKind::Onsets:
            drawOneOnset(dice, plan, seed);
            break;
        case CaptureKind::Edge:
            drawEdge(dice, plan, seed);
            break;
        case CaptureKind::Moving:
            drawMoving(dice, plan);
            break;
        case CaptureKind::Quiet:
            drawQuiet(dice, plan);
            break;
        case CaptureKind::Cut:
            anyUnit(dice, plan);
            edges();
            drawCut(dice, plan);
            offsetFor(dice, plan);
            break;
        case CaptureKind::Clipped:
        case CaptureKind::Disturbed:
        case CaptureKind::Drifting:
            anyUnit(dice, plan);
            pulses(30);
            offsetFor(dice, plan);
            break;
    }
    const bool converted = kind == CaptureKind::Onsets || kind == CaptureKind::Edge || kind == CaptureKind::Moving ||
                           kind == CaptureKind::Quiet;
    if (!converted) drawConverter(dice, plan);
    if (kind == CaptureKind::Clipped && plan.unit.phases.size() == 1) plan.offset = 0;  // keeps the rest of its height
    if (kind == CaptureKind::Clipped) draw.mustWarn = drawClipping(dice, plan);
    if (kind == CaptureKind::Disturbed) drawDisturbances(dice, plan);
    if (kind == CaptureKind::Drifting) drawDrift(dice, plan);
    draw.capture = captureOf(dice, plan);
    drawStatement(dice, plan, draw);
    draw.noise = plan.noise;
    draw.step = plan.lsb > 0 ? plan.lsb : plan.amplitude / 5000;
    draw.slope_per_s = plan.slope * plan.rate_hz;
    draw.settles = std::any_of(plan.unit.phases.begin(), plan.unit.phases.end(),
                               [](const SyntheticPhase& phase) { return phase.tau_s > 0 || phase.ringing > 0; });
    draw.easy = isEasy(plan);
    draw.noisy = plan.amplitude * (plan.onsets.empty() ? 1 : plan.unit.lesser()) < 12 * plan.noise;
    std::vector<TruePhase> unit;
    for (std::size_t k = 0; k < plan.unit.phases.size(); ++k) unit.push_back(truthOf(plan.unit, k));
    const auto& phases = plan.unit.phases;
    const bool mixed =
        phases.size() > 1 && phases[0].ringing * std::abs(phases[0].level) > 0.4 * std::abs(phases[1].level);
    for (std::size_t k = 0; k < plan.onsets.size(); ++k) {
        TruePulse pulse;
        pulse.leading = inRecord(unit[0], plan, k);
        pulse.mixed = mixed;
        if (unit.size() > 1) pulse.second = inRecord(unit[1], plan, k);
        markPulse(plan, k, unit, pulse);
        if (pulse.presence == Presence::Broken &&
            (plan.onsets[k] + plan.unit.length() + 2 < 0 || plan.onsets[k] > static_cast<double>(plan.samples) + 2)) {
            continue;  // the pulse is outside the record
        }
        draw.pulses.push_back(pulse);
    }
    draw.text =
        fmt::format("{} samples at {:.4g} S/s from {:.4g} s, height {:.4g}{}, {}{}", plan.samples, plan.rate_hz,
                    plan.start_s, plan.amplitude, plan.text,
                    draw.capture.channels[0].lsb > 0 ? "step stated" : "step not stated", draw.easy ? ", easy" : "");
    return draw;
}

}  // namespace tacto::test
