// PulseMeasurement.h - what was really delivered: pulses and trains measured on an oscilloscope's record.
//
// Definitions are science.md section 8: states from histogram modes; 10, 50 and 90 % references of each phase's own
// plateau; instants by straight line between samples; width and interval at 50 %. A pulse that is clipped, truncated
// by the record's end, incomplete (missing samples) or under-sampled (fewer than 10 samples in a phase) is flagged,
// counted and not measured: its numbers are NaN, and an interval that begins or ends with it is not reported.
//
// Noise: with every state at least 21.6 dB (12 standard deviations) out of it, no pulse is missed and none invented. A
// noisier record is measured on means of as many samples as that takes, if 10 of these fit a phase; where they do not,
// the result is doubtful, a warning says so, and an interval over 1.5 times the shortest is not reported. A baseline
// that drifts or hums is followed where pulses leave it seven tenths of the record; where it moves and cannot be
// followed, a warning says by how much, or that too much for pulses to be measured. What these promises hold for is in
// tests/measure/MeasurementGridTest.cpp, the errors in the table that measurement_table prints.
//
// Values are bare doubles: their unit is the channel's (V, A, or logic levels), which is data; charge is unit times
// second, coulombs on a current channel. Times are seconds on the session's time base.
//
// Thread-safety: pure functions; a capture may be measured by several threads at once.
#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/Result.h"
#include "core/base/Statistics.h"
#include "core/base/Units.h"
#include "core/measure/Capture.h"
#include "core/measure/StateLevels.h"

namespace tacto {

// An optional value that is usually missing: it takes the room of a pointer.
//
// Like std::optional, which however always keeps room for the value. Copies copy the value.

template <class T>
class Boxed {
public:
    Boxed() = default;
    /// Implicit, so that a value is assigned as to a std::optional.
    Boxed(T value) : value_(std::make_unique<T>(std::move(value))) {}  // NOLINT(google-explicit-constructor)
    Boxed(const Boxed& other) : value_(other ? std::make_unique<T>(*other) : nullptr) {}
    Boxed(Boxed&&) noexcept = default;
    Boxed& operator=(const Boxed& other) {
        if (this != &other) *this = Boxed(other);
        return *this;
    }
    Boxed& operator=(Boxed&&) noexcept = default;
    ~Boxed() = default;

    [[nodiscard]] bool has_value() const noexcept { return value_ != nullptr; }
    [[nodiscard]] explicit operator bool() const noexcept { return has_value(); }
    /// Call it only where there is a value.
    [[nodiscard]] const T& operator*() const noexcept { return *value_; }
    [[nodiscard]] const T* operator->() const noexcept { return value_.get(); }

private:
    std::unique_ptr<T> value_;
};

inline constexpr double kNotMeasured = std::numeric_limits<double>::quiet_NaN();

/// One phase of a pulse. Levels are relative to the baseline and carry the phase's sign.
struct PhaseMeasurement {
    double plateau = kNotMeasured;  ///< mean from 30 to 90 % of the width: after the edge has settled
    double onset_s = kNotMeasured;  ///< 50 % of the leading edge
    double end_s = kNotMeasured;    ///< 50 % of the trailing edge
    double width_s = kNotMeasured;
    double rise_s = kNotMeasured;     ///< 10 to 90 % of the leading edge, also where it falls
    double fall_s = kNotMeasured;     ///< 90 to 10 % of the trailing edge
    double overshoot = kNotMeasured;  ///< largest excess over the plateau, as a fraction of it
    double droop = kNotMeasured;      ///< loss over the width by straight line through the plateau, a fraction of it
    double charge = kNotMeasured;     ///< ∫ over the phase, its edges and half the gaps beside it
    std::size_t samples = 0;          ///< within the width
};

/// Why a pulse was not measured; several may hold.
struct PulseFlags {
    bool clipped = false;
    bool truncated = false;
    bool incomplete = false;    ///< samples are missing in it
    bool underSampled = false;  ///< fewer than 10 samples in a phase
    bool coarse = false;        ///< 10 to 40 samples in a phase: measured, with the uncertainty that follows
    /// A top keeps the record's extreme although the signal is noisy, and no range is stated that would say whether it
    /// is clipped: measured, with a warning.
    bool flatTop = false;
    [[nodiscard]] bool measured() const noexcept { return !(clipped || truncated || incomplete || underSampled); }
};

struct PulseMeasurement {
    PulseFlags flags;
    PhaseMeasurement leading;
    Boxed<PhaseMeasurement> second;   ///< a biphasic pulse's second phase; opposite, at most 1 ms after the leading one
    double gap_s = kNotMeasured;      ///< 50 % to 50 %, between the phases
    double imbalance = kNotMeasured;  ///< |Q1 + Q2| / max(|Q1|, |Q2|); 1 when a biphasic channel's pulse has no
                                      ///< second phase; NaN on a monophasic channel
    /// The place in the record, to a sample; known about a flagged pulse, too, so that it can be shown.
    double seenFrom_s = kNotMeasured;
    double seenTo_s = kNotMeasured;
    [[nodiscard]] double onset_s() const noexcept { return leading.onset_s; }
};

/// Pulses that belong together. NaN where not measured.
struct TrainMeasurement {
    double onset_s = kNotMeasured;     ///< onset of its first pulse
    double interval_s = kNotMeasured;  ///< to the onset of the next train; NaN for the last, or beside a flagged pulse
    double amplitude = kNotMeasured;   ///< mean of the leading plateaus' magnitudes
    double width_s = kNotMeasured;     ///< mean of the leading phases' widths
    double charge = kNotMeasured;      ///< mean of the leading phases' charges, magnitude
    double imbalance = kNotMeasured;   ///< mean
    int polarity = 0;                  ///< sign of the leading phase: +1, -1
    std::size_t pulses = 0;            ///< measured
    std::size_t flagged = 0;           ///< found but not measured
};

/// How pulses are told apart and grouped. Without a rate or a gap each pulse is its own train.
struct MeasureOptions {
    std::optional<Hertz> intraTrainRate{};  ///< pulses with onsets at most 1.5 / rate apart form one train
    std::optional<Seconds> trainGap{};      ///< the most between pulses of a train, onset to onset; wins over the rate
    Seconds interPhaseGapMax{1e-3};         ///< opposite phases at most this far apart form one pulse
};

/// How well the record itself lets its pulses be known.
struct SignalQuality {
    double snr_db = kNotMeasured;  ///< largest state over the noise, as measured (averaged); infinite without noise
    std::size_t mean = 1;          ///< samples averaged into one before measuring
    std::size_t meanOfSecond = 1;  ///< samples averaged for the shallower side of biphasic pulses
    double foundStep = 0;   ///< the converter's step, found in the samples because none is stated; 0 = none found
    std::size_t leaps = 0;  ///< single samples far from both of their neighbours, which were left out
    double drift = 0;       ///< peak to peak, of the baseline that was followed; 0 = it stays
    double unrest = 0;      ///< standard deviation of a baseline that moves and could not be followed, or what
                            ///< it is off just beside the pulses
    double levelAfter = 0;  ///< level of the signal after its pulses less that before them, where a second phase seems
                            ///< to be hidden in the noise; 0 = none
    bool doubtful = false;  ///< too much noise: pulses may be missing or invented
};

/// Standard uncertainties (k = 1) of one reading, from what the instrument states and the record shows. NaN where the
/// instrument does not state what it takes (Capture.h), and for a channel without pulses.
struct MeasurementUncertainty {
    /// Uncertainty of a plateau above its baseline: lsb/√6, gain and probe tolerance /√3, noise over the plateau. An
    /// offset cancels.
    double amplitude = kNotMeasured;
    double width_s = kNotMeasured;     ///< sampling step/√6, the noise on the edges, and the time base
    double interval_s = kNotMeasured;  ///< the time, with the time stamps of separate records
    double gap_s = kNotMeasured;       ///< as width_s; biphasic only
    double charge = kNotMeasured;  ///< charge of the leading phase: gain and noise over the width, step/√6 of its edges
    double imbalance = kNotMeasured;  ///< without what both charges have in common; biphasic only
};

/// A reading lies within this many standard uncertainties of the truth in 95 of 100 cases.
inline constexpr double kCoverage = 2;

struct ChannelMeasurement {
    std::string name;
    std::string unit;
    double rate_hz = 0;
    std::size_t samples = 0;
    StateLevels states;
    std::vector<PulseMeasurement> pulses;  ///< all pulses found, in time order, flagged ones included
    std::vector<TrainMeasurement> trains;
    std::size_t measuredPulses = 0;  ///< `pulses` of cli.md: those that the statistics are of
    SignalQuality quality;
    MeasurementUncertainty uncertainty;

    // Statistics of the measured pulses (leading phase); of the trains for the interval. n says how many.
    Statistics amplitude;
    Statistics width_s;
    Statistics interval_s;
    Statistics rise_s;
    Statistics fall_s;
    Statistics overshoot;
    Statistics droop;
    Statistics charge;
    Statistics gap_s;                   ///< biphasic only
    Statistics imbalance;               ///< biphasic only
    std::vector<std::string> warnings;  ///< whole sentences that name the channel
};

/// Measures one channel. `channel` must be below capture.channels.size(). A channel without two states gives no pulses
/// and a warning; nothing is an error.
[[nodiscard]] ChannelMeasurement measureChannel(const Capture& capture, std::size_t channel,
                                                const MeasureOptions& options = {});

/// What `measure` prints: every channel, or the one asked for.
struct CaptureMeasurement {
    std::vector<ChannelMeasurement> channels;
    std::vector<std::string> warnings;  ///< warnings about all channels
};
[[nodiscard]] CaptureMeasurement measureCapture(const Capture& capture, std::optional<std::size_t> channel = {},
                                                const MeasureOptions& options = {});

/// Measures one channel over one long record, or over several short ones whose start_s stand on one time base (a
/// capture per trigger): onsets and intervals run across captures. An interval across captures that are not on one time
/// base (onsets that do not rise) is not reported, with a warning. What captures warn of themselves is among the
/// warnings.
/// Errors: InvalidArgument without captures; NotFound when a capture lacks the channel.
[[nodiscard]] Result<ChannelMeasurement> measureTrains(std::span<const Capture> captures, std::string_view channel,
                                                       const MeasureOptions& options = {});

}  // namespace tacto
