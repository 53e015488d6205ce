// CaptureProperty.h - makes random records of a known truth, and compares the results of core/measure with that truth.
// No project code computes the truth: a pulse is a formula, an oscilloscope is a gain, noise, a range and a converter.
//
// A result is right if each figure lies within twice its U (4 u; if the instrument leaves U unknown, the U with an
// exact instrument), or within an allowance. The allowance covers one converter step, one sampling interval (or as many
// as were averaged), the noise, and any reported unrest or step of the baseline. Of all figures, 92 of 100 lie within U
// (CapturePropertyTest.cpp). A figure may also be missing if a flag or a warning says that it was not measured. A
// warning never excuses a wrong figure.
//
// Easy records must be measured, with a U of at most a twentieth plus the allowance. In these, each phase is at least
// 12 samples long, 20 codes high, 20 standard deviations out of the noise (of the converter too) and not closer than 4
// samples to another; at least half of the record, and at least half a width or 20 samples before, between and after
// pulses, is baseline; edges take at most a fifth of the width, overshoot is at most 10 %, droop 2 %, drift 5 % in at
// most one turn; pulses of one record differ by at most four tenths; nothing is clipped, missing, cut off or disturbed.
//
// Other records may be refused, because an instrument may not be able to see the pulses. If a phase has fewer than 9
// samples, is cut off, is clipped beyond a stated range or lacks samples, any figure is wrong. If the noise exceeds a
// twelfth of a phase, PulseMeasurement.h promises nothing, and one draw in a hundred may have a wrong figure.
//
// Records without a clear truth are not drawn. A phase of fewer than 3 samples may be a disturbance; a remainder of
// less than a fifth of a phase may be ringing; without noise, each stair of a wave of fewer than 20 codes may be a
// level.
//
// Thread-safety: pure functions.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/measure/PulseMeasurement.h"

namespace tacto::test {

enum class CaptureKind {
    Biphasic,    ///< symmetric
    Recharge,    ///< slow and shallow second phase, of equal charge
    Monophasic,  ///< up or down, with an offset
    Square,      ///< high for a fifth to four fifths of the time
    Unequal,     ///< pulses of different amplitudes
    Trains,      ///< trains with a stated pulse rate
    Onsets,      ///< a clean pulse at each sample in turn, around the middle and other parts of the record
    Edge,        ///< one edge, or several in the same direction: no pulse
    Moving,      ///< ramps, sines, triangles, sawteeth, discharges: no pulse
    Quiet,       ///< noise, a constant, hum, nothing: no pulse
    Clipped,     ///< cut off by a range, stated or not
    Disturbed,   ///< one-sample spikes and missing samples
    Drifting,    ///< a slope, a slow wave or hum under the pulses
    Cut,         ///< the record begins or ends during a pulse
};
inline constexpr std::array kCaptureKinds{
    CaptureKind::Biphasic, CaptureKind::Recharge,  CaptureKind::Monophasic, CaptureKind::Square, CaptureKind::Unequal,
    CaptureKind::Trains,   CaptureKind::Onsets,    CaptureKind::Edge,       CaptureKind::Moving, CaptureKind::Quiet,
    CaptureKind::Clipped,  CaptureKind::Disturbed, CaptureKind::Drifting,   CaptureKind::Cut};
[[nodiscard]] const char* nameOf(CaptureKind kind);

/// A phase as the oscilloscope shows it, with the errors of its gain and time base. Figures as defined in science.md
/// section 8.
struct TruePhase {
    double plateau = 0;
    double onset_s = 0;
    double end_s = 0;
    double charge = 0;
    double rise = 0;    ///< samples in which an edge goes from 0 to 1 at the slope it has at half height
    double uneven = 0;  ///< difference between the largest and the smallest value on the plateau
    double again = 0;   ///< distance between two places at one end at which ringing passes half the plateau
};

enum class Presence {
    Whole,
    Doubtful,  ///< may be refused
    Broken,    ///< must not be measured
};

struct TruePulse {
    Presence presence = Presence::Whole;
    TruePhase leading;
    std::optional<TruePhase> second;
    /// True if the first phase rings to half of the second. The start of the second phase and the charges are then
    /// undefined and not judged.
    bool mixed = false;
    bool secondUnseen = false;  ///< cut off except for a remainder that may be ringing: a result without it is right
    // Largest changes that a spike in the pulse makes to plateau, times and charge.
    double moreAmplitude = 0;
    double moreTime_s = 0;
    double moreCharge = 0;
};

struct CaptureDraw {
    Capture capture;
    MeasureOptions options;
    std::vector<TruePulse> pulses;
    std::size_t perTrain = 1;
    double noise = 0;        ///< standard deviation
    double step = 0;         ///< the converter's step, stated or not; a fine step is 1/5000 of the height
    double slope_per_s = 0;  ///< largest slope of a drift
    bool settles = false;    ///< edges have tails, so the signal never quite reaches the baseline between pulses
    double gain = 1;         ///< shown value / true value
    double timeBase = 1;
    bool easy = false;
    bool noisy = false;      ///< signal-to-noise below 21.6 dB: PulseMeasurement.h promises nothing
    bool statesAll = false;  ///< gain, probe, resolution and time base are stated, so each figure has a U
    bool mustWarn = false;   ///< a warning is required, measured or not
    std::string text;        ///< short description of the draw
};

/// Draws a record. The same seed gives the same record on every machine.
[[nodiscard]] CaptureDraw drawCapture(CaptureKind kind, std::uint64_t seed);

enum class Figure { Amplitude, Width, Interval, Gap, Charge, Imbalance };
inline constexpr std::size_t kFigures = 6;
inline constexpr std::array<const char*, kFigures> kFigureNames{"amplitude", "width",  "interval",
                                                                "gap",       "charge", "imbalance"};

struct CaptureJudgement {
    std::vector<std::string> wrong;  ///< one sentence for each
    bool refused = false;            ///< a pulse that exists is missing from the figures
    std::string why;                 ///< the first warning
    /// Whether the truth of the first measured pulse lies within U. Empty if the figure or its U is missing.
    std::array<std::optional<bool>, kFigures> inside;
};

[[nodiscard]] CaptureJudgement judge(const CaptureDraw& draw, const ChannelMeasurement& measured);

}  // namespace tacto::test
