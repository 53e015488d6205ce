// SensorReading.h - computes features from a fingertip's samples while it rests, slides or carries a weight.
//
// The live bench uses the same processing (core/dsp), so a scale measured here is also valid there.
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/analysis/calibration/Calibration.h"
#include "core/base/Result.h"
#include "core/base/Statistics.h"
#include "core/base/Stream.h"
#include "core/dsp/RoughnessChain.h"
#include "core/results/ResultBasis.h"

namespace tacto {

struct SensorSamples {
    std::vector<StreamInfo> streams;
    std::vector<SampleBlock> blocks;  ///< one per stream
    std::string serial{};             ///< the fingertip for which the scales are valid; empty: unknown
};

/// A fingertip at rest that touches nothing.
struct SensorRest {
    RestLevels levels;
    StreamUnit restUnit = StreamUnit::MetrePerSecondSquared;  ///< levels.slidingMeanSquare is in this unit squared
    StreamUnit taxelUnit = StreamUnit::Pascal;                ///< unit of levels.taxelBaseline
};

/// Treats all samples as rest. Errors: InvalidArgument for less than 250 ms of samples, or if no rest level can be
/// derived from them; those of RoughnessChain::create().
[[nodiscard]] Result<SensorRest> readRest(const SensorSamples& samples, const RoughnessSettings& settings);

/// One slide over one surface. Features are arithmetic means (h over sliding frames, v over contact frames, as in
/// bench.measureReference()). NaN: the rig does not measure the feature, or no frame has it.
struct SlideReading {
    double h = kNaN;
    double hAbs = kNaN;  ///< in (m/s2/N)2
    double vStatic = kNaN;
    double vDynamic = kNaN;
    double force_n = kNaN;  ///< in the force stream's unit; NaN without a force stream
    std::size_t slidingFrames = 0;
};

/// Errors: those of RoughnessChain::create(); Device if there was no sliding or no contact.
[[nodiscard]] Result<SlideReading> readSlide(const SensorSamples& samples, const RoughnessSettings& settings,
                                             const SensorRest& rest);

/// The mean force with the scale of the active profile.
struct ForceInUse {
    double mean = kNaN;
    StreamUnit unit = StreamUnit::Newton;
    double uncertainty = kNaN;  ///< standard, of the mean, with kForceParts - 1 degrees of freedom; NaN: unknown
};

/// A force record is cut into this many parts. The scatter of their means gives the uncertainty of the whole mean.
/// Single samples would not, because neighbouring samples of a trembling finger are correlated.
inline constexpr std::size_t kForceParts = 8;
/// Standard uncertainty of the mean of a stream's first channel; NaN with fewer than two samples per part.
[[nodiscard]] double meanUncertainty(const SensorSamples& samples, StreamKind kind);

/// One weight on the resting fingertip: means over all samples, in the sensor's own units; NaN: no reading.
struct WeightReading {
    double mass_g = kNaN;
    double reference_n = kNaN;  ///< weight force of this mass
    double force = kNaN;
    std::optional<StreamUnit> forceUnit{};  ///< empty: there is no force sensor
    std::vector<double> taxels{};
    std::optional<StreamUnit> taxelUnit{};  ///< empty: there are no taxels
    std::optional<ForceInUse> inUse{};      ///< empty: there is no force sensor
};

/// The fingertip without contact, for a run.
struct FingertipRest {
    SensorRest levels = {};
    Statistics force = {};                 ///< in the sensor's unit
    std::optional<ForceInUse> inUse = {};  ///< empty: there is no force sensor
    double duration_s = 0;
};
/// A weight on the fingertip, and the direction from which it was reached.
struct Weighed {
    WeightReading reading = {};
    SweepDirection direction = SweepDirection::None;
    int repeat = 0;  ///< from 1
};
struct Slid {
    SlideReading reading = {};
    std::string material = {};
};

/// The check of a known weight before other readings are trusted. NaN: not known.
struct KnownWeight : ReferenceCheck {
    bool weighed = false;  ///< false: there is no weight or no force sensor
    double mass_g = kNaN, reference_n = kNaN;
    double measured = kNaN, expanded = kNaN;  ///< in `unit`, less the reading at rest
    std::optional<StreamUnit> unit = {};
    std::string reason = {};  ///< why it did not pass; empty if it passed or nothing was weighed
};

/// Error of the sensor with the profile's scale under a known weight, in N, with U (95 %).
struct WeightError {
    double value = kNaN;
    double expanded = kNaN;  ///< NaN: a contribution is unknown
};
/// Reading minus reading at rest minus the known weight force. U includes both readings and the tolerances of the
/// weight and of local gravity (relative half-widths; NaN: unknown).
[[nodiscard]] WeightError weightError(const WeightReading& reading, const ForceInUse& atRest, double weightTolerance,
                                      double gravityTolerance);

/// R of the slide from the means of its features, by RoughnessIndex::ofSlide(). Outside 0..1 for surfaces smoother or
/// rougher than the references. NaN if no feature is present.
[[nodiscard]] double roughnessOf(const SlideReading& slide, const RoughnessSettings& settings);

/// Statistics of one channel over all finite samples; n = 0 if there is no such stream.
[[nodiscard]] Statistics levelOf(const SensorSamples& samples, StreamKind kind, std::size_t channel = 0);
/// Returns null if there is no such stream.
[[nodiscard]] const StreamInfo* streamOf(const SensorSamples& samples, StreamKind kind) noexcept;

// Finds scale and offset of a sensor from its readings at known references.
//
// The same fit serves force against weights and each taxel against force over contact area. fitCalibration() fits the
// readings as a function of the known references, and the line is then inverted:
//   reference = scale · reading + offset, scale = 1 / gain, offset = -(fitted offset) / gain.
// The uncertainties are type A from the repeatability and the rectangular tolerance common to all references, applied
// to the scale and, times the offset, to the offset. combine() gives U (95 %). There may be several tolerances
// (weights, local gravity, contact area); if one is unknown, U is unknown.

struct SensorScale {
    double scale = 0;  ///< reference per unit of reading: N per count, Pa per count
    double scaleU = std::numeric_limits<double>::quiet_NaN();  ///< 95 %; NaN without repeats
    double offset = 0;                                         ///< the reference value at a reading of 0
    double offsetU = std::numeric_limits<double>::quiet_NaN();
    Calibration fit;  ///< readings against references
};

/// `readings`: the reference as commanded value, the sensor's reading as measured value. `tolerances` of the
/// references: relative half-widths, 0 to below 1; NaN: unknown. Errors: as fitCalibration(); Device if the reading
/// does not follow the reference, because the 95 % interval of the slope includes 0. `what` names the sensor in that
/// message.
[[nodiscard]] Result<SensorScale> fitSensorScale(std::span<const CalibrationReading> readings,
                                                 const std::vector<double>& tolerances, std::string_view what);

/// The scale of the force or of a taxel, or why there is none.
struct FingertipScale {
    std::optional<SensorScale> found = {};
    std::optional<StreamUnit> unit = {};  ///< of the readings
    std::string reason = {};
    bool follows = true;  ///< false: the readings do not follow the weights
    bool asked = false;   ///< true if weights were given and a reading is missing
};
struct FingertipScales {
    FingertipScale force = {};
    std::vector<FingertipScale> taxels = {};
};

}  // namespace tacto
