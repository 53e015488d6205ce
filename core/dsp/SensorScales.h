// SensorScales.h - the result of a sensor calibration for one fingertip: how its force and taxels convert to N and Pa,
// and the uncertainty of R. Part of RoughnessSettings and so of a profile.
//
// Streams are recorded unscaled; only RoughnessChain applies the scales.
//
// Thread-safety: plain values.
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/Result.h"
#include "core/base/Stream.h"
#include "core/base/Words.h"
#include "core/dsp/RoughnessFlags.h"

namespace tacto {

template <class Record>
class RecordFields;
template <class T>
struct ValueKind;

/// A straight line: quantity = scale · reading + offset.
struct SensorLine {
    double scale = 1;                ///< N or Pa per unit of the reading; must not be 0
    double offset = 0;               ///< N or Pa for a reading of 0
    std::optional<double> scaleU{};  ///< expanded uncertainty U of the scale, 95 %; nothing: not known
    [[nodiscard]] double at(double reading) const noexcept { return scale * reading + offset; }
    bool operator==(const SensorLine&) const = default;
};

/// Uncertainty of R for one slide, from the repeatability of the references and of the slide: science.md section 12.
struct RoughnessUncertainty {
    double slideSd = 0;            ///< standard deviation of R from slide to slide, ≥ 0
    std::size_t smoothSlides = 0;  ///< slides over the smooth reference, ≥ 1
    std::size_t roughSlides = 0;
    double coverage = 2;  ///< factor k for 95 %, from the degrees of freedom of slideSd

    /// Returns U = k s √(1 + (1 − R)²/n_smooth + R²/n_rough), for one slide and the means of the two references.
    /// Assumes that all features give the same R. NaN if R is absent.
    [[nodiscard]] double expanded(double R) const noexcept;
    bool operator==(const RoughnessUncertainty&) const = default;
};

struct SensorScales {
    std::string fingertip;                      ///< serial number of the fingertip; empty: it has none
    std::optional<SensorLine> force;            ///< converts readings to N; nothing: in the unit of the stream
    StreamUnit forceUnit = StreamUnit::Newton;  ///< unit of the readings in the calibration: N or count
    std::vector<SensorLine> taxels;             ///< convert to Pa, one per taxel; empty: in the unit of the stream
    StreamUnit taxelUnit = StreamUnit::Pascal;  ///< unit of the readings in the calibration: Pa or count
    bool operator==(const SensorScales&) const = default;
};

/// Whether the scales belong to the fingertip of the samples.
enum class FingertipMatch {
    Same,
    NotNamed,  ///< the source or the calibration has no serial number, so they may belong together
    Another
};
[[nodiscard]] FingertipMatch matchOf(const SensorScales& scales, std::string_view serial) noexcept;

/// Reads and writes `sensor` in a profile's roughness section:
///   {"serial": "…", "force": {"unit": "N"|"count", "scale": x, "offset_n": x, "scale_u": x|null},
///    "taxels": {"unit": "Pa"|"count", "scale": […], "offset_pa": […], "scale_u": [x|null…]}}
/// Errors: InvalidArgument for a scale of 0.
[[nodiscard]] ValueKind<SensorScales> sensorScalesKind();
/// Returns the fields of `uncertainty` in a roughness section.
[[nodiscard]] RecordFields<RoughnessUncertainty> roughnessUncertaintyFields();

// Units that a fingertip's streams may have, in the words of profiles and results.

inline constexpr Word<StreamUnit> kRestUnits[] = {{"m/s2", StreamUnit::MetrePerSecondSquared},
                                                  {"count", StreamUnit::Count}};
inline constexpr Word<StreamUnit> kForceUnits[] = {{"N", StreamUnit::Newton}, {"count", StreamUnit::Count}};
inline constexpr Word<StreamUnit> kTaxelUnits[] = {{"Pa", StreamUnit::Pascal}, {"count", StreamUnit::Count}};

// Converts a fingertip's readings to N and Pa, the only place that does so. Decides which scales of a profile are valid
// for its streams.
//
// Scales of another fingertip or for another unit of readings are ignored. References measured with them are not valid
// either (hazard H7).

class StreamScaling {
public:
    /// `serial`: of the fingertip that gives the samples; empty: not known.
    StreamScaling(std::span<const StreamInfo> streams, const std::optional<SensorScales>& scales,
                  std::string_view serial);

    /// Returns the streams in the units in use.
    [[nodiscard]] const std::vector<StreamInfo>& streams() const noexcept { return streams_; }
    [[nodiscard]] bool converts(std::size_t stream) const noexcept;
    [[nodiscard]] double inUse(std::size_t stream, std::size_t channel, double reading) const noexcept;
    /// Returns all taxels of a sample in the unit in use (`readings` itself if unscaled), valid until the next call.
    [[nodiscard]] const double* scaled(std::size_t stream, const double* readings) noexcept;

    /// Returns false if scales were ignored: values measured with them are then not valid here.
    [[nodiscard]] bool holds() const noexcept { return !another_ && !leftAside_; }
    void raise(RoughnessFlags& flags) const noexcept;

private:
    SensorScales scales_;
    std::vector<StreamInfo> streams_;
    bool force_ = false, taxels_ = false;  // true: readings are scaled
    bool another_ = false, notNamed_ = false, leftAside_ = false;
    std::vector<double> row_;
};

/// Errors: InvalidArgument if the scales belong to this fingertip but have another number of taxels.
[[nodiscard]] Result<void> checkScales(std::span<const StreamInfo> streams, const std::optional<SensorScales>& scales,
                                       std::string_view serial);

// Checks that the roughness chain can judge the streams.

/// Errors: InvalidArgument, as listed for RoughnessChain::create().
[[nodiscard]] Result<void> checkStreams(std::span<const StreamInfo> streams);

}  // namespace tacto
