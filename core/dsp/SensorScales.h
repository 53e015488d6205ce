// SensorScales.h - what a sensor calibration found about one fingertip: how its force and taxels are turned into N and
// Pa, and how far R can be trusted. Part of RoughnessSettings, and so of a profile.
//
// Streams are recorded as the fingertip gives them; RoughnessChain alone applies the scales.
//
// Thread-safety: values.
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

/// quantity = scale · reading + offset.
struct SensorLine {
    double scale = 1;                ///< N or Pa per unit of the reading; not 0
    double offset = 0;               ///< N or Pa: what a reading of 0 stands for
    std::optional<double> scaleU{};  ///< U of the scale, 95 %; nothing: not known
    [[nodiscard]] double at(double reading) const noexcept { return scale * reading + offset; }
    bool operator==(const SensorLine&) const = default;
};

/// How far R of one slide can be off, by the repeatability of the references and of the slide: science.md section 12.
struct RoughnessUncertainty {
    double slideSd = 0;            ///< standard deviation of R from slide to slide, ≥ 0
    std::size_t smoothSlides = 0;  ///< slides over each reference, ≥ 1
    std::size_t roughSlides = 0;
    double coverage = 2;  ///< k for 95 %, from the degrees of freedom of slideSd

    /// U = k s √(1 + (1 − R)²/n_smooth + R²/n_rough): one slide, and the two references' means that R lies between.
    /// Takes each feature to say the same R. NaN for R that is absent.
    [[nodiscard]] double expanded(double R) const noexcept;
    bool operator==(const RoughnessUncertainty&) const = default;
};

struct SensorScales {
    std::string fingertip;                      ///< the fingertip's serial number; empty: it has none
    std::optional<SensorLine> force;            ///< converts to N; nothing: as the stream says
    StreamUnit forceUnit = StreamUnit::Newton;  ///< unit of the readings it was measured in: N or count
    std::vector<SensorLine> taxels;             ///< convert to Pa, one each; empty: as the stream says
    StreamUnit taxelUnit = StreamUnit::Pascal;  ///< Pa or count
    bool operator==(const SensorScales&) const = default;
};

/// Whether the scales belong to the fingertip that gives the samples.
enum class FingertipMatch {
    Same,
    NotNamed,  ///< the source or the calibration has no serial number: nothing says that it is another one
    Another
};
[[nodiscard]] FingertipMatch matchOf(const SensorScales& scales, std::string_view serial) noexcept;

/// The `sensor` of a profile's roughness section:
///   {"serial": "…", "force": {"unit": "N"|"count", "scale": x, "offset_n": x, "scale_u": x|null},
///    "taxels": {"unit": "Pa"|"count", "scale": […], "offset_pa": […], "scale_u": [x|null…]}}
/// InvalidArgument for a scale of 0.
[[nodiscard]] ValueKind<SensorScales> sensorScalesKind();
/// Its `uncertainty`.
[[nodiscard]] RecordFields<RoughnessUncertainty> roughnessUncertaintyFields();

// The units that a fingertip's streams may have, by the words that profiles and results use.

inline constexpr Word<StreamUnit> kRestUnits[] = {{"m/s2", StreamUnit::MetrePerSecondSquared},
                                                  {"count", StreamUnit::Count}};
inline constexpr Word<StreamUnit> kForceUnits[] = {{"N", StreamUnit::Newton}, {"count", StreamUnit::Count}};
inline constexpr Word<StreamUnit> kTaxelUnits[] = {{"Pa", StreamUnit::Pascal}, {"count", StreamUnit::Count}};

// The one place where a fingertip's readings become N and Pa: which scales of a profile hold for its
// streams, and what they make of a reading.
//
// Scales of another fingertip, and those for readings in another unit, are left aside; references that were read under
// them do not hold either (hazard H7).

class StreamScaling {
public:
    /// `serial` is of the fingertip that gives the samples; empty: not known.
    StreamScaling(std::span<const StreamInfo> streams, const std::optional<SensorScales>& scales,
                  std::string_view serial);

    /// The streams, in the units in use.
    [[nodiscard]] const std::vector<StreamInfo>& streams() const noexcept { return streams_; }
    [[nodiscard]] double inUse(std::size_t stream, std::size_t channel, double reading) const noexcept;
    /// All taxels of one sample, in the unit in use; `readings` itself where nothing is scaled. Until the next call.
    [[nodiscard]] const double* scaled(std::size_t stream, const double* readings) noexcept;

    /// False where scales were left aside: what was measured under them is of no use here.
    [[nodiscard]] bool holds() const noexcept { return !another_ && !leftAside_; }
    void raise(RoughnessFlags& flags) const noexcept;

private:
    SensorScales scales_;
    std::vector<StreamInfo> streams_;
    bool force_ = false, taxels_ = false;  // scaled
    bool another_ = false, notNamed_ = false, leftAside_ = false;
    std::vector<double> row_;
};

/// Errors: InvalidArgument where the scales are of this very fingertip and hold for another number of taxels.
[[nodiscard]] Result<void> checkScales(std::span<const StreamInfo> streams, const std::optional<SensorScales>& scales,
                                       std::string_view serial);

// Which streams the roughness chain can judge.

/// Errors: InvalidArgument as RoughnessChain::create() lists them.
[[nodiscard]] Result<void> checkStreams(std::span<const StreamInfo> streams);

}  // namespace tacto
