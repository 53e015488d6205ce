// CaptureProperty.h - records drawn at random from a truth that is known because they were made from it, and the judge
// that holds what core/measure says of them against that truth. No project code computes it: a pulse is a formula, an
// oscilloscope is a gain, noise, a range and a converter.
//
// What is right. Each figure that is given lies within twice its U (4 u; where the instrument leaves U unknown, the U
// that it would have with an exact instrument), or within what one step of the converter, one sampling interval (as
// many as the kernel says that it averaged), the noise, and an unrest or a step of the baseline that are said allow. Of
// the figures as a whole 92 of 100 lie within U (CapturePropertyTest.cpp). Or it is said that something was not
// measured (a flag, a warning), and no figure is given. A figure that is wrong is never excused by a warning beside it.
//
// What is easy, and must be measured with a U of at most a twentieth beside what is allowed: each phase is at least 12
// samples long, 20 codes high, 20 standard deviations out of the noise (of the converter too) and not closer than 4
// samples to another; at least half of the record, and at least half a width or 20 samples before, between and after
// pulses, is baseline; edges take at most a fifth of the width, overshoot is at most 10 %, droop 2 %, drift 5 % in at
// most one turn; pulses of one record differ by at most four tenths; nothing is clipped, missing, cut off or disturbed.
//
// What is not easy may be refused: an instrument cannot be expected to see it. Where a phase has fewer than 9 samples,
// is cut off, clipped beyond a stated range or lacks samples, a figure is wrong whatever it says. In noise of more than
// a twelfth of a phase, for which PulseMeasurement.h promises nothing, one draw of a hundred may have a wrong figure.
//
// What has no truth is not drawn: a phase of fewer than 3 samples may be a disturbance, a remainder of less than a
// fifth of a phase ringing, and each stair of a wave of fewer than 20 codes without noise a level.
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
    Recharge,    ///< slow and shallow, of equal charge
    Monophasic,  ///< up or down, with an offset
    Square,      ///< a fifth to four fifths of the time
    Unequal,     ///< pulses of different amplitudes
    Trains,      ///< trains with a stated rate
    Onsets,      ///< a clean pulse at each sample in turn, about the record's middle and other fractions
    Edge,        ///< one edge, or several in one direction, which make no pulse
    Moving,      ///< ramps, sines, triangles, sawteeth, discharges: no pulse
    Quiet,       ///< noise, a constant, hum, nothing: no pulse
    Clipped,     ///< cut off by a range that is stated or not
    Disturbed,   ///< one-sample spikes and missing samples
    Drifting,    ///< a slope, a slow wave or hum under the pulses
    Cut,         ///< the record begins or ends within a pulse
};
inline constexpr std::array kCaptureKinds{
    CaptureKind::Biphasic, CaptureKind::Recharge,  CaptureKind::Monophasic, CaptureKind::Square, CaptureKind::Unequal,
    CaptureKind::Trains,   CaptureKind::Onsets,    CaptureKind::Edge,       CaptureKind::Moving, CaptureKind::Quiet,
    CaptureKind::Clipped,  CaptureKind::Disturbed, CaptureKind::Drifting,   CaptureKind::Cut};
[[nodiscard]] const char* nameOf(CaptureKind kind);

/// A phase of the waveform as the oscilloscope shows it, its gain and time base included; by the definitions of
/// science.md section 8.
struct TruePhase {
    double plateau = 0;
    double onset_s = 0;
    double end_s = 0;
    double charge = 0;
    double rise = 0;    ///< samples in which an edge passes from 0 to 1 at the slope that it has at half height
    double uneven = 0;  ///< largest less smallest value over the plateau
    double again = 0;   ///< two places at one end where the signal passes half of its plateau again: ringing
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
    /// Ringing of the first phase reaches half of the second: where that begins, and which phase has which charge, is
    /// not defined, and is not judged.
    bool mixed = false;
    bool secondUnseen = false;  ///< cut off but for a remainder that may be ringing: a reading without it is right
    // A spike in it moves the plateau, a time, the charge by up to this.
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
    double step = 0;         ///< the converter's step, stated or not; a fine one is a 5000th of the height
    double slope_per_s = 0;  ///< largest of a drift
    bool settles = false;    ///< edges have tails: between pulses nothing is quite the baseline
    double gain = 1;         ///< shown over true
    double timeBase = 1;
    bool easy = false;
    bool noisy = false;      ///< less than 21.6 dB: PulseMeasurement.h promises nothing
    bool statesAll = false;  ///< gain, probe, resolution and time base: then each figure has its U
    bool mustWarn = false;   ///< measured or not
    std::string text;        ///< says in a few words what it is
};

/// The same seed draws the same, on every machine.
[[nodiscard]] CaptureDraw drawCapture(CaptureKind kind, std::uint64_t seed);

enum class Figure { Amplitude, Width, Interval, Gap, Charge, Imbalance };
inline constexpr std::size_t kFigures = 6;
inline constexpr std::array<const char*, kFigures> kFigureNames{"amplitude", "width",  "interval",
                                                                "gap",       "charge", "imbalance"};

struct CaptureJudgement {
    std::vector<std::string> wrong;  ///< a sentence each
    bool refused = false;            ///< something that was there is not among the figures
    std::string why;                 ///< the kernel's first warning
    /// Whether the truth of the first measured pulse lies within U. Empty where the figure or its U was not given.
    std::array<std::optional<bool>, kFigures> inside;
};

[[nodiscard]] CaptureJudgement judge(const CaptureDraw& draw, const ChannelMeasurement& measured);

}  // namespace tacto::test
