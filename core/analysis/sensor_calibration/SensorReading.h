// SensorReading.h - what a fingertip measured while it rested, slid or carried a weight: samples in, features out.
//
// The live bench reads them with the same chain (core/dsp), so that a scale measured here means the same there.
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

namespace tacto {

struct SensorSamples {
    std::vector<StreamInfo> streams;
    std::vector<SampleBlock> blocks;  ///< one per stream
    std::string serial{};             ///< the fingertip whose scales hold; empty: not known
};

/// The fingertip at rest, touching nothing.
struct SensorRest {
    RestLevels levels;
    StreamUnit restUnit = StreamUnit::MetrePerSecondSquared;  ///< unit of levels.slidingMeanSquare, squared
    StreamUnit taxelUnit = StreamUnit::Pascal;                ///< unit of levels.taxelBaseline
};

/// All samples are taken as rest. Errors: InvalidArgument where they are fewer than 250 ms can hold, or where no rest
/// can be derived from them; as RoughnessChain::create().
[[nodiscard]] Result<SensorRest> readRest(const SensorSamples& samples, const RoughnessSettings& settings);

/// One slide over one surface. Features are arithmetic means over its frames (h over sliding frames, v over contact
/// frames, as bench.measureReference() takes them); NaN: the rig does not measure it, or no frame has it.
struct SlideReading {
    double h = kNaN;
    double hAbs = kNaN;  ///< (m/s2/N)2
    double vStatic = kNaN;
    double vDynamic = kNaN;
    double force_n = kNaN;  ///< in the force stream's unit; NaN without one
    std::size_t slidingFrames = 0;
};

/// Errors: as RoughnessChain::create(); Device when nothing was felt sliding or in contact.
[[nodiscard]] Result<SlideReading> readSlide(const SensorSamples& samples, const RoughnessSettings& settings,
                                             const SensorRest& rest);

/// The mean of a force as the profile in force scales it.
struct ForceInUse {
    double mean = kNaN;
    StreamUnit unit = StreamUnit::Newton;
    double uncertainty = kNaN;  ///< standard, of the mean, with kForceParts - 1 degrees of freedom; NaN: not known
};

/// A force record is cut into that many parts; the scatter of their means tells how well the whole mean is known.
/// Single samples would not: a finger trembles, so that neighbours are alike.
inline constexpr std::size_t kForceParts = 8;
/// Standard uncertainty of the mean of a stream's first channel, from its parts; NaN for fewer than two samples a part.
[[nodiscard]] double meanUncertainty(const SensorSamples& samples, StreamKind kind);

/// One weight on the resting fingertip: means over all samples, in the sensor's own units; NaN: not read.
struct WeightReading {
    double mass_g = kNaN;
    double reference_n = kNaN;  ///< the force of its weight
    double force = kNaN;
    std::optional<StreamUnit> forceUnit{};  ///< nothing: there is no force sensor
    std::vector<double> taxels{};
    std::optional<StreamUnit> taxelUnit{};  ///< nothing: there are no taxels
    std::optional<ForceInUse> inUse{};      ///< nothing: there is no force sensor
};

/// The error of the sensor, with the profile's scale, under a known weight: N, with its U (95 %).
struct WeightError {
    double value = kNaN;
    double expanded = kNaN;  ///< NaN: a part of it is not known
};
/// The reading less that at rest and less what the weight should weigh. U: the tolerances of the weight and of local
/// gravity (relative half-widths; NaN: not known), and both readings.
[[nodiscard]] WeightError weightError(const WeightReading& reading, const ForceInUse& atRest, double weightTolerance,
                                      double gravityTolerance);

/// R of the slide under `settings`, of the means of its features, as RoughnessIndex::ofSlide(): beyond 0..1 where it is
/// smoother or rougher than the references. NaN with no feature present.
[[nodiscard]] double roughnessOf(const SlideReading& slide, const RoughnessSettings& settings);

/// Statistics of one channel over all finite samples; n = 0 where there is no such stream.
[[nodiscard]] Statistics levelOf(const SensorSamples& samples, StreamKind kind, std::size_t channel = 0);
/// Nothing where no such stream exists.
[[nodiscard]] const StreamInfo* streamOf(const SensorSamples& samples, StreamKind kind) noexcept;

// A sensor's reading against known references: how much one unit of it stands for, and from where.
//
// Force against weights, and each taxel against force over contact area, are the same question. The readings are fitted
// against the references (the references are what is known), by fitCalibration(), and the line is turned round:
//   reference = scale · reading + offset, scale = 1 / gain, offset = -(fitted offset) / gain.
// The uncertainties are type A from the repeatability, and the tolerance that all references share, rectangular: of the
// scale, and times the offset of the offset. U is combine()'s, for 95 %. There may be several such tolerances (of the
// weights, of local gravity, of the contact area); one that is not known leaves U unknown.

struct SensorScale {
    double scale = 0;  ///< reference per unit of reading: N per count, Pa per count
    double scaleU = std::numeric_limits<double>::quiet_NaN();  ///< 95 %; NaN where nothing was repeated
    double offset = 0;  ///< in the reference's unit: what stands for a reading of 0
    double offsetU = std::numeric_limits<double>::quiet_NaN();
    Calibration fit;  ///< readings against references
};

/// `readings`: commanded is the reference, measured the sensor's reading. `tolerances` of the references are relative
/// half-widths, 0 to below 1; NaN: not known.
/// Errors: as fitCalibration(); Device where the reading does not follow the reference: the slope's 95 % interval
/// reaches 0. `what` names the sensor in that sentence.
[[nodiscard]] Result<SensorScale> fitSensorScale(std::span<const CalibrationReading> readings,
                                                 const std::vector<double>& tolerances, std::string_view what);

}  // namespace tacto
