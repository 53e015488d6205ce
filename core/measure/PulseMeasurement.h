// PulseMeasurement.h - measures the pulses and trains that were really delivered, on an oscilloscope's record.
//
// Definitions are science.md section 8: states from histogram modes; 10, 50 and 90 % levels of each phase's own
// plateau; linear interpolation between samples; width and interval at 50 %. A pulse that is clipped, truncated by the
// record's end, incomplete (missing samples) or under-sampled (fewer than 10 samples in a phase) is flagged, counted
// and not measured: its numbers are NaN, and an interval that begins or ends with it is not reported.
//
// Noise: if every state is at least 21.6 dB (12 standard deviations) above the noise, no pulse is missed or invented. A
// noisier record is averaged until this holds, if 10 means fit into a phase. If they do not, the result is doubtful, a
// warning says so, and intervals over 1.5 times the shortest are not reported. A baseline that drifts or hums is
// followed if at least seven tenths of the record are baseline. If it cannot be followed, a warning says how far it
// moves, or that it moves too much to measure pulses. tests/measure/MeasurementGridTest.cpp tests these promises;
// measurement_table prints the errors.
//
// Values are bare doubles: the unit is data and belongs to the channel (V, A, or logic levels). Charge is in unit ×
// seconds, which is coulombs for a current. Times are seconds on the session's time base.
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

// An optional value that is usually missing. It takes only as much room as a pointer.
//
// Like std::optional, which always reserves room for the value. Copies copy the value.

template <class T>
class Boxed {
public:
    Boxed() = default;
    /// Implicit, so that a value can be assigned as to a std::optional.
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
    /// Call it only if there is a value.
    [[nodiscard]] const T& operator*() const noexcept { return *value_; }
    [[nodiscard]] const T* operator->() const noexcept { return value_.get(); }

private:
    std::unique_ptr<T> value_;
};

inline constexpr double kNotMeasured = std::numeric_limits<double>::quiet_NaN();

/// One phase of a pulse. Levels are measured from the baseline and carry the phase's sign.
struct PhaseMeasurement {
    double plateau = kNotMeasured;  ///< mean from 30 to 90 % of the width, after the edge has settled
    double onset_s = kNotMeasured;  ///< 50 % of the leading edge
    double end_s = kNotMeasured;    ///< 50 % of the trailing edge
    double width_s = kNotMeasured;
    double rise_s = kNotMeasured;     ///< 10 to 90 % of the leading edge, rising or falling
    double fall_s = kNotMeasured;     ///< duration from 90 to 10 % of the trailing edge
    double overshoot = kNotMeasured;  ///< largest excess over the plateau, as a fraction of the plateau
    double droop = kNotMeasured;      ///< loss over the width, by a line through the plateau, as a fraction of it
    double charge = kNotMeasured;     ///< integral over the phase, its edges and half of each gap next to it
    std::size_t samples = 0;          ///< samples within the width
};

/// Why a pulse was not measured. Several flags may be set.
struct PulseFlags {
    bool clipped = false;
    bool truncated = false;
    bool incomplete = false;    ///< samples of the pulse are missing
    bool underSampled = false;  ///< fewer than 10 samples in a phase
    bool coarse = false;        ///< 10 to 40 samples in a phase: measured, with a larger uncertainty
    /// True if a top stays at the record's extreme although the signal is noisy, and no stated range says whether it is
    /// clipped. The pulse is measured, with a warning.
    bool flatTop = false;
    [[nodiscard]] bool measured() const noexcept { return !(clipped || truncated || incomplete || underSampled); }
};

struct PulseMeasurement {
    PulseFlags flags;
    PhaseMeasurement leading;
    Boxed<PhaseMeasurement> second;   ///< second phase, if biphasic: opposite, at most 1 ms after the leading one
    double gap_s = kNotMeasured;      ///< gap between the phases, from 50 % to 50 %
    double imbalance = kNotMeasured;  ///< Q1 + Q2| / max(|Q1|, |Q2|); 1 if a pulse of a biphasic channel has no second
                                      ///< phase; NaN on a monophasic channel
    /// Place in the record, accurate to a sample. Known even for a flagged pulse, so that the pulse can be shown.
    double seenFrom_s = kNotMeasured;
    double seenTo_s = kNotMeasured;
    [[nodiscard]] double onset_s() const noexcept { return leading.onset_s; }
};

/// Pulses that belong together. NaN if not measured.
struct TrainMeasurement {
    double onset_s = kNotMeasured;     ///< onset of its first pulse
    double interval_s = kNotMeasured;  ///< time to the next onset; NaN for the last train, or next to a flagged pulse
    double amplitude = kNotMeasured;   ///< mean magnitude of the leading plateaus
    double width_s = kNotMeasured;     ///< mean width of the leading phases
    double charge = kNotMeasured;      ///< mean magnitude of the leading phases' charges
    double imbalance = kNotMeasured;   ///< mean of the pulses' imbalances
    int polarity = 0;                  ///< sign of the leading phase: +1, -1
    std::size_t pulses = 0;            ///< number of measured pulses
    std::size_t flagged = 0;           ///< number of pulses found but not measured
};

/// How pulses are separated and grouped. Without a rate or a gap, each pulse is a train of its own.
struct MeasureOptions {
    std::optional<Hertz> intraTrainRate{};  ///< pulses whose onsets are at most 1.5 / rate apart form one train
    std::optional<Seconds> trainGap{};      ///< longest time between onsets in a train; takes precedence over the rate
    Seconds interPhaseGapMax{1e-3};         ///< opposite phases at most this far apart form one pulse
};

/// How reliably the record shows its pulses.
struct SignalQuality {
    double snr_db = kNotMeasured;  ///< largest state over the noise, as measured (averaged); infinite if no noise
    std::size_t mean = 1;          ///< samples averaged into one before the measurement
    std::size_t meanOfSecond = 1;  ///< samples averaged into one for the shallower side of biphasic pulses
    double foundStep = 0;          ///< converter's step, found in the samples if none is stated; 0 = none found
    std::size_t leaps = 0;         ///< single samples far from both neighbours, which were left out
    double drift = 0;              ///< peak-to-peak drift of a baseline that was followed; 0 = no drift
    double unrest = 0;      ///< standard deviation of a moving baseline that could not be followed, or its deviation
                            ///< just outside the pulses
    double levelAfter = 0;  ///< signal level after its pulses minus the level before, if noise seems to hide a second
                            ///< phase; 0 = none
    bool doubtful = false;  ///< too much noise: pulses may be missing, or found where there are none
};

/// Standard uncertainties (k = 1) of one reading, from the instrument's statements and the record. NaN if a needed
/// figure is not stated (Capture.h), and for a channel without pulses.
struct MeasurementUncertainty {
    /// Uncertainty of a plateau above its baseline: lsb/√6, gain and probe tolerance /√3, noise over the plateau. An
    /// offset cancels out.
    double amplitude = kNotMeasured;
    double width_s = kNotMeasured;     ///< sampling step/√6, noise on the edges, time base
    double interval_s = kNotMeasured;  ///< as the width, and the time stamps of separate records
    double gap_s = kNotMeasured;       ///< as width_s; biphasic only
    double charge = kNotMeasured;  ///< charge of the leading phase: gain and noise over the width, step/√6 of the edges
    double imbalance = kNotMeasured;  ///< without errors common to both charges; biphasic only
};

/// A reading is within this many standard uncertainties of the true value in 95 of 100 cases.
inline constexpr double kCoverage = 2;

struct ChannelMeasurement {
    std::string name;
    std::string unit;
    double rate_hz = 0;
    std::size_t samples = 0;
    StateLevels states;
    std::vector<PulseMeasurement> pulses;  ///< all pulses found, flagged ones too, in time order
    std::vector<TrainMeasurement> trains;
    std::size_t measuredPulses = 0;  ///< `pulses` in cli.md: the number of pulses in the statistics
    SignalQuality quality;
    MeasurementUncertainty uncertainty;

    // Statistics over the leading phases of measured pulses (interval: over trains). n is the number of readings.
    Statistics amplitude;
    Statistics width_s;
    Statistics interval_s;
    Statistics rise_s;
    Statistics fall_s;
    Statistics overshoot;
    Statistics droop;
    Statistics charge;
    Statistics gap_s;                   ///< only for biphasic pulses
    Statistics imbalance;               ///< only for biphasic pulses
    std::vector<std::string> warnings;  ///< whole sentences that name the channel
};

/// Measures one channel. `channel` must be below capture.channels.size(). A channel without two states gives a warning
/// and no pulses. There are no errors.
[[nodiscard]] ChannelMeasurement measureChannel(const Capture& capture, std::size_t channel,
                                                const MeasureOptions& options = {});

/// Result of the `measure` command: every channel, or the requested one.
struct CaptureMeasurement {
    std::vector<ChannelMeasurement> channels;
    std::vector<std::string> warnings;  ///< warnings that concern all channels
};
[[nodiscard]] CaptureMeasurement measureCapture(const Capture& capture, std::optional<std::size_t> channel = {},
                                                const MeasureOptions& options = {});

/// Measures one channel over one long record, or over several short records (one per trigger) whose start_s share one
/// time base: onsets and intervals then continue across captures. If onsets do not rise, the captures do not share a
/// time base; intervals across them are not reported, and a warning says so. Warnings of the captures are included.
/// Errors: InvalidArgument without captures; NotFound when a capture lacks the channel.
[[nodiscard]] Result<ChannelMeasurement> measureTrains(std::span<const Capture> captures, std::string_view channel,
                                                       const MeasureOptions& options = {});

}  // namespace tacto
