#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "tests/measure/CaptureProperty.h"

namespace tacto::test {

namespace {

/// Allowed distance of a figure from the truth: one step, one sampling interval, six standard deviations of noise.
struct Allowed {
    double amplitude = 0;
    double time_s = 0;
    double charge = 0;
};

Allowed whatIsAllowed(const CaptureDraw& draw, double samplesToMean, const TruePulse& pulse, const TruePhase& phase) {
    const double interval_s = samplesToMean / draw.capture.rate_hz;
    const double width = (phase.end_s - phase.onset_s) * draw.capture.rate_hz;
    const TruePhase& last = pulse.second ? *pulse.second : pulse.leading;
    const double length_s = last.end_s - pulse.leading.onset_s;
    const double height = std::abs(phase.plateau);
    const double drift = draw.slope_per_s * 1.5 * length_s;
    Allowed allowed;
    allowed.amplitude = draw.step + (draw.settles ? 1e-3 * height : 0) + 6 * draw.noise * std::sqrt(2 / (0.6 * width)) +
                        drift + phase.uneven * 2 / (0.6 * width) + pulse.moreAmplitude;
    const double rise = std::max(1.0, phase.rise);
    const double blur = (9 * draw.noise + 2 * draw.step) * rise + allowed.amplitude * phase.rise;
    allowed.time_s = interval_s * (1 + blur / height) + pulse.moreTime_s;
    allowed.charge = allowed.amplitude * 2 * length_s + 8 * draw.noise / draw.capture.rate_hz * std::sqrt(2 * width) +
                     height * interval_s + 1e-3 * std::abs(phase.charge) * (phase.rise > 2 ? 1 : 0) + pulse.moreCharge;
    return allowed;
}

constexpr std::array<double MeasurementUncertainty::*, kFigures> kUncertainties{
    &MeasurementUncertainty::amplitude, &MeasurementUncertainty::width_s, &MeasurementUncertainty::interval_s,
    &MeasurementUncertainty::gap_s,     &MeasurementUncertainty::charge,  &MeasurementUncertainty::imbalance};

class Judge {
public:
    Judge(const CaptureDraw& draw, const ChannelMeasurement& measured) : draw_(draw), measured_(measured) {
        if (!measured.warnings.empty()) result_.why = measured.warnings.front();
        if (result_.why.empty()) result_.why = measured.states.why;
        said_ = !measured.warnings.empty();
        if (measured.measuredPulses > 0) exact_ = ofAnExactInstrument();
    }

    CaptureJudgement judge() {
        claimed_.assign(draw_.pulses.size(), false);
        seen_.assign(draw_.pulses.size(), false);
        std::size_t flagged = 0, stray = 0;
        for (const auto& pulse : measured_.pulses) {
            if (pulse.flags.measured()) {
                compare(pulse);
            } else {
                ++flagged;
                stray += markSeen(pulse) ? 0 : 1;
            }
        }
        if (flagged > 0 && !said_) wrong("{} pulses are flagged without a warning", flagged);
        if (stray > 0 && draw_.easy) wrong("{} flagged pulses where there are none", stray);
        std::size_t unseen = 0, whole = 0;
        for (std::size_t k = 0; k < draw_.pulses.size(); ++k) {
            const bool expected = draw_.pulses[k].presence == Presence::Whole;
            whole += expected && !claimed_[k] ? 1 : 0;
            unseen += expected && !claimed_[k] && !seen_[k] ? 1 : 0;
        }
        if (unseen > 0 && !said_) wrong("{} of {} pulses are missing without a word", unseen, draw_.pulses.size());
        result_.refused = result_.refused || whole > 0;
        if (draw_.easy && result_.refused) wrong("an easy record is refused, in part or in whole");
        if (draw_.pulses.empty() && !said_) wrong("no pulses, and not a word why");
        if (draw_.mustWarn && !said_) wrong("a clipped top is measured without a warning");
        compareTrains();
        compareStatistics();
        return std::move(result_);
    }

private:
    [[nodiscard]] Allowed allowedFor(const TruePulse& pulse, const TruePhase& phase) const {
        const auto mean = std::max(measured_.quality.mean, measured_.quality.meanOfSecond);
        auto allowed = whatIsAllowed(draw_, static_cast<double>(mean), pulse, phase);
        // The reported unrest next to the pulses: twice its standard deviation, and the step from before to after.
        const auto& quality = measured_.quality;
        const double unrest = said_ ? kCoverage * quality.unrest + std::abs(quality.levelAfter) : 0;
        allowed.amplitude += unrest;
        allowed.charge += unrest * 2 * (phase.end_s - phase.onset_s);
        allowed.time_s += unrest * phase.rise / std::abs(phase.plateau) / draw_.capture.rate_hz;
        return allowed;
    }

    template <class... Values>
    void wrong(fmt::format_string<Values...> text, Values&&... values) {
        result_.wrong.push_back(fmt::format(text, std::forward<Values>(values)...));
    }

    /// `shown`: the truth by the formula, as the oscilloscope shows it; `share`: shown value / true value.
    void figure(Figure which, double value, double shown, double share, double allowed) {
        if (std::isnan(value) || std::isnan(shown)) return;
        const double truth = shown / share;
        const double error = value - truth;
        const auto index = static_cast<std::size_t>(which);
        const double u = measured_.uncertainty.*kUncertainties[index], exact = exact_.*kUncertainties[index];
        const bool right = std::abs(value - shown) <= allowed || std::abs(error) <= 2 * kCoverage * u ||
                           (std::isnan(u) && std::abs(value - shown) <= 2 * kCoverage * exact);
        if (!right) {
            wrong("{} {:.6g} is {:.3g} off {:.6g}; U {:.3g}, or {:.3g} off what is shown; allowed {:.3g}",
                  kFigureNames[index], value, error, truth, kCoverage * u, value - shown, allowed);
        }
        if (first_ && !std::isnan(u)) result_.inside[index] = std::abs(error) <= kCoverage * u;
        if (!draw_.easy) return;
        if (draw_.statesAll && std::isnan(u)) wrong("{} has no U", kFigureNames[index]);
        if (draw_.slope_per_s == 0 && !ofSecond_ &&
            kCoverage * u > 4 * allowed + std::abs(truth) * (0.05 + kCoverage * toleranceOf(which))) {
            wrong("U {:.3g} of {} is out of proportion: {:.3g} would do", kCoverage * u, kFigureNames[index], allowed);
        }
    }

    [[nodiscard]] double toleranceOf(Figure which) const {
        const auto& channel = draw_.capture.channels[0];
        const auto stated = [](double x) { return std::isnan(x) ? 0 : x; };
        const double gain = stated(channel.gainTolerance) + stated(channel.probeTolerance);
        const double time = stated(draw_.capture.timeBaseTolerance);
        if (which == Figure::Amplitude) return gain;
        if (which == Figure::Charge) return gain + time;
        return which == Figure::Imbalance ? 0 : time;
    }

    /// Returns the uncertainties that would be stated if the instrument's figures were all known.
    [[nodiscard]] MeasurementUncertainty ofAnExactInstrument() const {
        if (draw_.statesAll) return measured_.uncertainty;
        Capture capture = draw_.capture;
        capture.timeBaseTolerance = 0;
        auto& channel = capture.channels[0];
        channel.gainTolerance = channel.probeTolerance = channel.offsetTolerance = 0;
        channel.lsb = draw_.step;
        return measureChannel(capture, 0, draw_.options).uncertainty;
    }

    void compare(const PulseMeasurement& pulse) {
        const std::size_t none = draw_.pulses.size();
        std::size_t nearest = none;
        for (std::size_t k = 0; k < none; ++k) {
            const auto& leading = draw_.pulses[k].leading;
            const double off = std::abs(leading.onset_s - pulse.leading.onset_s);
            if (off < 0.5 * (leading.end_s - leading.onset_s) + 1 / draw_.capture.rate_hz &&
                (nearest == none || off < std::abs(draw_.pulses[nearest].leading.onset_s - pulse.leading.onset_s))) {
                nearest = k;
            }
        }
        const double at = (pulse.leading.onset_s - draw_.capture.start_s) * draw_.capture.rate_hz;
        if (nearest == none) {
            wrong("a pulse of {:.4g} and {:.1f} samples is measured at sample {:.1f}, where none begins",
                  pulse.leading.plateau, pulse.leading.width_s * draw_.capture.rate_hz, at);
            return;
        }
        if (claimed_[nearest]) {
            wrong("a pulse is measured twice at sample {:.1f}", at);
            return;
        }
        claimed_[nearest] = true;
        const auto& truth = draw_.pulses[nearest];
        if (truth.presence == Presence::Broken) {
            wrong("the pulse at sample {:.1f} is measured although it is cut, clipped, short or incomplete", at);
            return;
        }
        first_ = !anyMeasured_;
        anyMeasured_ = true;
        compareFigures(pulse, truth);
        first_ = false;
    }

    void compareFigures(const PulseMeasurement& pulse, const TruePulse& truth) {
        const double u = std::isnan(measured_.uncertainty.width_s) ? exact_.width_s : measured_.uncertainty.width_s;
        const auto leading = allowedFor(truth, truth.leading);
        const double gain = draw_.gain, time = draw_.timeBase;
        comparePhase(pulse.leading, truth.leading, leading);
        if (!truth.mixed && !truth.secondUnseen)
            figure(Figure::Charge, pulse.leading.charge, truth.leading.charge, gain * time, leading.charge);
        const double late = std::abs(pulse.leading.onset_s - truth.leading.onset_s);
        if (late > leading.time_s && late > 2 * kCoverage * u) {
            wrong("onset is {:.2f} samples off; allowed {:.2f}", late * draw_.capture.rate_hz,
                  leading.time_s * draw_.capture.rate_hz);
        }
        if (!truth.second) {
            if (pulse.second || !std::isnan(pulse.gap_s)) wrong("a second phase is measured where there is none");
            if (!std::isnan(pulse.imbalance)) wrong("imbalance {:.3g} of a monophasic pulse", pulse.imbalance);
            return;
        }
        if (!pulse.second) {
            result_.refused = true;
            if (!std::isnan(pulse.imbalance)) {
                wrong("imbalance {:.3g} of a pulse whose second phase was not seen", pulse.imbalance);
            }
            if (!said_ && !truth.secondUnseen) wrong("a second phase is missing without a word");
            return;
        }
        if (truth.mixed) return;
        const auto second = allowedFor(truth, *truth.second);
        ofSecond_ = true;  // U is that of the leading phase
        comparePhase(*pulse.second, *truth.second, second);
        ofSecond_ = false;
        figure(Figure::Gap, pulse.gap_s, truth.second->onset_s - truth.leading.end_s, time,
               0.5 * (leading.time_s + second.time_s));
        const double q1 = truth.leading.charge, q2 = truth.second->charge;
        const double larger = std::max(std::abs(q1), std::abs(q2));
        figure(Figure::Imbalance, pulse.imbalance, std::abs(q1 + q2) / larger, 1,
               (leading.charge + second.charge) / larger);
    }

    void comparePhase(const PhaseMeasurement& phase, const TruePhase& truth, const Allowed& allowed) {
        figure(Figure::Amplitude, phase.plateau, truth.plateau, draw_.gain, allowed.amplitude);
        figure(Figure::Width, phase.width_s, truth.end_s - truth.onset_s, draw_.timeBase, allowed.time_s);
    }

    bool markSeen(const PulseMeasurement& pulse) {
        bool any = false;
        for (std::size_t k = 0; k < draw_.pulses.size(); ++k) {
            const auto& truth = draw_.pulses[k];
            const double slack = 3 / draw_.capture.rate_hz;
            const double end_s = truth.second ? truth.second->end_s : truth.leading.end_s;
            if (!(pulse.seenTo_s >= truth.leading.onset_s - slack) || !(pulse.seenFrom_s <= end_s + slack)) continue;
            seen_[k] = any = true;
        }
        return any;
    }

    /// Compares intervals, from each train to the next one that exists.
    void compareTrains() {
        const std::size_t per = draw_.perTrain;
        std::size_t pulses = 0;
        for (const auto& train : measured_.trains) {
            pulses += train.pulses;
            if (std::isnan(train.interval_s)) continue;
            bool found = false;
            for (std::size_t k = 0; k + per < draw_.pulses.size(); k += per) {
                const auto& here = draw_.pulses[k];
                if (std::abs(here.leading.onset_s - train.onset_s) >
                    0.5 * (here.leading.end_s - here.leading.onset_s)) {
                    continue;
                }
                found = true;
                const auto& next = draw_.pulses[k + per];
                first_ = &train == &measured_.trains.front();
                const auto allowed = allowedFor(here, here.leading), after = allowedFor(next, next.leading);
                figure(Figure::Interval, train.interval_s, next.leading.onset_s - here.leading.onset_s, draw_.timeBase,
                       0.5 * (allowed.time_s + after.time_s));
                first_ = false;
                if (train.pulses + train.flagged != per && !said_) {
                    wrong("a train of {} pulses has {} without a word", per, train.pulses + train.flagged);
                }
            }
            if (!found) wrong("an interval of {:.4g} s begins where no train does", train.interval_s);
        }
        if (pulses != measured_.measuredPulses) wrong("trains have {} measured pulses", pulses);
    }

    void compareStatistics() {
        std::vector<double> amplitudes, widths;
        for (const auto& pulse : measured_.pulses) {
            if (!pulse.flags.measured()) continue;
            amplitudes.push_back(std::abs(pulse.leading.plateau));
            widths.push_back(pulse.leading.width_s);
        }
        if (measured_.measuredPulses != amplitudes.size()) {
            wrong("{} pulses are said to be measured, and {} are", measured_.measuredPulses, amplitudes.size());
        }
        const auto same = [](const Statistics& stated, const std::vector<double>& values) {
            if (stated.n != values.size()) return false;
            double sum = 0;
            for (const double value : values) sum += value / static_cast<double>(values.size());
            return values.empty() || std::abs(std::abs(stated.mean) - sum) <= 1e-9 * sum;
        };
        if (!same(measured_.amplitude, amplitudes)) wrong("the amplitude's mean is not that of the pulses");
        if (!same(measured_.width_s, widths)) wrong("the width's mean is not that of the pulses");
    }

    const CaptureDraw& draw_;
    const ChannelMeasurement& measured_;
    CaptureJudgement result_;
    std::vector<bool> claimed_, seen_;
    MeasurementUncertainty exact_;
    bool said_ = false;
    bool first_ = false, anyMeasured_ = false, ofSecond_ = false;
};

}  // namespace

CaptureJudgement judge(const CaptureDraw& draw, const ChannelMeasurement& measured) {
    return Judge(draw, measured).judge();
}

}  // namespace tacto::test
