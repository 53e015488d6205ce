#include "core/measure/WaveformMeasurement.h"

#include <algorithm>
#include <cmath>

#include "core/measure/Clipping.h"

namespace tacto {

namespace {

constexpr double kHysteresis = 0.1;  ///< share of the difference between the two states

/// The waveform is beyond this reference once it is `margin` past `level`, in the direction of `sign`.
struct Reference {
    double level = 0;
    double margin = 0;
    double sign = 1;  ///< -1 if pulses go down
};

bool goesDown(const ChannelMeasurement& measured) {
    for (const auto& pulse : measured.pulses) {
        if (pulse.flags.measured()) return pulse.leading.plateau < 0;
    }
    const auto& s = measured.states;
    return s.count == StateCount::Two && s.high == s.baseline;
}

Reference referenceOf(const ChannelMeasurement& measured, double smallest, double largest) {
    const auto& states = measured.states;
    if (states.count == StateCount::None) {
        return {(smallest + largest) / 2, kHysteresis * (largest - smallest), 1};
    }
    const bool down = goesDown(measured);
    const double top = down ? states.low : states.high;
    return {(states.baseline + top) / 2, kHysteresis * std::abs(top - states.baseline), down ? -1.0 : 1.0};
}

/// Finds crossings of the reference level, in samples from the record's start. The first goes away from the baseline.
class Crossings {
public:
    explicit Crossings(const Reference& reference) : reference_(reference) {}

    void take(double index, double value) {
        const double beyond = reference_.sign * (value - reference_.level);
        // A crossing is timed where it passes the level, but is counted only once the margin is passed.
        if (known_ && (before_ < 0) != (beyond < 0)) crossed_ = index - beyond / (beyond - before_);
        before_ = beyond;
        known_ = true;
        if (beyond > reference_.margin) go(true);
        if (beyond < -reference_.margin) go(false);
    }
    void miss() { gap_ = true; }

    void writeTo(WaveformMeasurement& measured, double rate_hz) const {
        if (periods_ == 0 || broken_) return;
        const double length = lastUp_ - firstUp_;
        measured.periods = periods_;
        measured.frequency_hz = static_cast<double>(periods_) * rate_hz / length;
        measured.duty = beyondInWhole_ / length;
    }

private:
    void go(bool up) {
        const bool begun = side_ != 0;
        const int side = up ? 1 : -1;
        if (side == side_) return;
        side_ = side;
        if (!begun) return;  // the start of a record is not a crossing
        if (!up) {
            down_ = crossed_;
            return;
        }
        if (seenUp_) {
            ++periods_;
            broken_ = broken_ || gap_;
            beyondInWhole_ += down_ - lastUp_;
        } else {
            firstUp_ = crossed_;
            seenUp_ = true;
        }
        gap_ = false;
        lastUp_ = crossed_;
    }

    Reference reference_;
    double before_ = 0;
    bool known_ = false;
    double crossed_ = 0;
    int side_ = 0;  ///< 1 beyond the level, -1 not beyond, 0 not known yet
    bool seenUp_ = false;
    double firstUp_ = 0, lastUp_ = 0, down_ = 0;
    double beyondInWhole_ = 0;
    std::size_t periods_ = 0;
    bool gap_ = false;     ///< samples are missing since the last crossing
    bool broken_ = false;  ///< samples are missing in a whole period
};

}  // namespace

WaveformMeasurement measureWaveform(const Capture& capture, std::size_t channel, const ChannelMeasurement& measured) {
    WaveformMeasurement result;
    const auto& its = capture.channels[channel];
    const auto limits = clipLimits(its);
    double smallest = std::numeric_limits<double>::infinity(), largest = -smallest, sum = 0, squares = 0;
    for (const float sample : its.samples) {
        const auto x = static_cast<double>(sample);
        if (std::isnan(x)) {
            ++result.missing;
            continue;
        }
        smallest = std::min(smallest, x);
        largest = std::max(largest, x);
        sum += x;
        squares += x * x;
    }
    const auto n = static_cast<double>(its.samples.size() - result.missing);
    if (!(n > 0) || !std::isfinite(smallest) || !std::isfinite(largest)) return result;
    result.clipped = limits && (limits->reachedBy(smallest) || limits->reachedBy(largest));
    if (!result.clipped) {
        result.peakToPeak = largest - smallest;
        result.mean = sum / n;
        result.rms = std::sqrt(squares / n);
    }
    const auto reference = referenceOf(measured, smallest, largest);
    if (!(reference.margin > 0) || !(capture.rate_hz > 0)) return result;
    Crossings crossings(reference);
    for (std::size_t i = 0; i < its.samples.size(); ++i) {
        const auto x = static_cast<double>(its.samples[i]);
        if (std::isnan(x))
            crossings.miss();
        else
            crossings.take(static_cast<double>(i), x);
    }
    crossings.writeTo(result, capture.rate_hz);
    return result;
}

}  // namespace tacto
