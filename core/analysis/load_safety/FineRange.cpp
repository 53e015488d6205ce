#include "core/analysis/load_safety/FineRange.h"

#include <cmath>
#include <utility>

namespace tacto {

namespace {

/// A wide and a fine record of the same command, each known by the onset of its first pulse.
struct TwoRanges {
    LoadTrace wide, fine, voltage;  ///< voltage: of the fine record
    double wideOnset_s = 0, fineOnset_s = 0;
    ChannelMeasurement pulses;  ///< the fine record's pulses
};

std::optional<TwoRanges> twoRanges(const Capture& wide, const Capture& fine, const ExpectedTrain& expected,
                                   std::vector<std::string>& warnings) {
    const auto wideOnset = pulsesOf(wide, expected, warnings);
    auto pulses = pulsesOf(fine, expected, warnings);
    if (!wideOnset || !pulses) return std::nullopt;
    const double wide_s = wideOnset->trains.front().onset_s, fine_s = pulses->trains.front().onset_s;
    const auto a = traceOf(wide, "current", wide_s), b = traceOf(fine, "current", fine_s);
    const auto v = traceOf(fine, "voltage", fine_s);
    if (!a || a->clipped || !b || !v || v->clipped) return std::nullopt;
    return TwoRanges{*a, *b, *v, wide_s, fine_s, std::move(*pulses)};
}

/// ∫i of the fine record, and of the wide one while the fine one clips; with how long that was, and how often.
struct Joined {
    double integral = 0, wide_s = 0;
    std::size_t seams = 0;
};
Joined joined(const TwoRanges& two) {
    constexpr std::size_t kAside = 3;  // samples beside a clipped one: its amplifier is still coming back
    Joined out;
    const auto& fine = two.fine;
    for (std::size_t i = fine.quiet; i < fine.size();) {
        std::size_t end = i;
        while (end < fine.size() && !fine.clippedNear(end, kAside)) out.integral += fine.at(end++) * fine.dt;
        i = end;
        while (end < fine.size() && fine.clippedNear(end, kAside)) ++end;
        if (end == i) break;
        const double shift = two.wideOnset_s - two.fineOnset_s;
        const double from = fine.start_s + static_cast<double>(i) * fine.dt + shift;
        const double to = fine.start_s + static_cast<double>(end) * fine.dt + shift;
        out.integral += integralOf(two.wide, from, to);
        out.wide_s += to - from;
        out.seams += 2;
        i = end;
    }
    return out;
}

}  // namespace

void addFineRange(LoadReading& out, const LoadFigures& figures, std::span<const Capture> captures,
                  std::span<const Capture> fine, const ExpectedTrain& expected) {
    out.impedance_ohm = out.net_charge_uc = out.imbalance = {};
    LoadTrains ends;
    double net = 0;
    BudgetRows rows;  // budget of the train with the most net charge
    for (std::size_t k = 0; k < fine.size(); ++k) {
        const auto two = twoRanges(captures[k % captures.size()], fine[k], expected, out.warnings);
        if (!two) return;
        TrainFigures train;
        readEnds(two->voltage, &two->fine, two->pulses, expected.drive, train);
        train.noise_v = two->voltage.noise;
        train.noise_a = two->fine.noise;
        if (!(train.end_a < 0.98 * two->fine.channel->high)) return;  // the range does not fit the end either
        ends.push_back(train);
        const auto charge = joined(*two);
        const double here = std::abs(charge.integral) / expected.pulses;
        if (!rows.empty() && !(here > net)) continue;
        net = here;
        rows.clear();
        // A moving level takes every step of the converter alike; what stays is that of the baseline under it.
        rows.push_back({"resolution of current", Distribution::Rectangular,
                        two->wide.channel->lsb > 0 ? two->wide.channel->lsb : kNaN, kSqrt12,
                        charge.wide_s / expected.pulses});
        ChannelDoubt(two->fine.channel).addOpposites(rows, out.width_s.value);
        rows.push_back({"seams of the two ranges", Distribution::Rectangular, two->fine.channel->high * two->fine.dt,
                        kSqrt12, std::sqrt(static_cast<double>(charge.seams))});
        addNormal(rows, "noise of current", two->wide.noise * std::sqrt(charge.wide_s * two->wide.dt));
    }
    const auto* current = channelOf(fine.front(), "current");
    out.impedance_ohm = figures.impedanceOf(ends, ChannelDoubt(channelOf(fine.front(), "voltage")),
                                            ChannelDoubt(current), current->lsb);
    const double phase = 1e-6 * out.charge_uc.value;
    out.imbalance = times(1 / phase, figures.figure(net, rows));
    ChannelDoubt(current).addGain(rows, net);
    out.net_charge_uc = times(1e6, figures.figure(net, std::move(rows)));
}

}  // namespace tacto
