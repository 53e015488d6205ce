// FingertipCalibration.h - the parts of a fingertip's calibration: its readings, the operator's statements about the
// specimens, the scales, and the profile that is kept.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/scripting/engine/Arguments.h"
#include "app/scripting/engine/ScriptSession.h"
#include "app/scripting/host/bench/BenchCalls.h"
#include "core/analysis/sensor_calibration/SensorCalibration.h"
#include "core/analysis/sensor_calibration/SensorReading.h"

namespace tacto::host::sensor_calibration {

using Json = nlohmann::json;

// Readings. Each function disarms first. Errors: no answer, too few samples, a stopped run.

/// Lifts the finger (or asks for it, question rest) and reads it without contact. Also fails if the finger is touched.
[[nodiscard]] Result<FingertipRest> readFingertipRest(ScriptSession& session, double duration_s);
/// Puts a weight on the resting finger (question weight-MASSg).
[[nodiscard]] Result<WeightReading> readWeight(ScriptSession& session, double mass_g, double gravity_m_s2,
                                               double duration_s);
[[nodiscard]] Result<SlideReading> readSliding(ScriptSession& session, const bench::Sliding& sliding, double duration_s,
                                               const SensorRest& rest);
[[nodiscard]] Json streamsOf(ScriptSession& session);

/// A surface, with its roughness as stated by the operator.
struct GivenSurface {
    std::string name;
    double ra_um = kNaN, rz_um = kNaN;  ///< Rz may be unknown
    std::string source = "typed in";
};
/// Returns the members of "settings": smooth, smooth_ra_um, smooth_rz_um, smooth_file; likewise for rough; more.
[[nodiscard]] std::vector<HostParameter> surfaceSettings();
/// Returns the surfaces, references first. Errors: InvalidArgument for a text that cannot be read, a surface named
/// twice, an Rz below its Ra, a rough reference that is not rougher, a file that the operator did not choose.
[[nodiscard]] Result<std::vector<GivenSurface>> surfacesGiven(ScriptSession& session, const Arguments& arguments);
/// Returns the weights in g, the smallest first. `text` separates them by ";". Errors: InvalidArgument for a text that
/// cannot be read, a single weight, or a weight that occurs twice.
[[nodiscard]] Result<std::vector<double>> massesGiven(const std::string& text);

/// bench.profilometer(): Ra and Rz of a file that the operator chose.
HostCall profilometer;

/// Relative tolerances of the references. NaN: not known, and then no uncertainty based on them is known.
struct WeighingTolerances {
    double weights = 0, gravity = kNaN, area = kNaN;
};
/// Judges a known weight before other readings are trusted: the reading and its expanded uncertainty (from weight,
/// local gravity and both readings) must lie within the tolerance. A reading in counts must instead differ from the
/// reading at rest by five standard deviations. `reading`: empty without a weight or force sensor.
[[nodiscard]] KnownWeight judgeWeight(const std::optional<WeightReading>& reading, const FingertipRest& rest,
                                      const WeighingTolerances& known, double tolerance_pct);

/// Returns the scales of force and of each taxel. `area_cm2` 0: not known.
[[nodiscard]] FingertipScales fingertipScales(const std::vector<Weighed>& weighed, double area_cm2,
                                              const WeighingTolerances& known);
/// Converts force and taxels to N and Pa with these scales for the rest of the run. Roughness R is uncalibrated until
/// references are read with the new scales. Returns { force, taxels }: whether each is scaled now.
[[nodiscard]] Result<Json> useScales(ScriptSession& session, const FingertipScales& scales);

/// Adds to the operator's profile the scales of roughness, force and taxels, the fingertip's serial number, the
/// surfaces and the readings at rest, and uses the result until the run ends. `area_cm2` 0: the profile's area. If
/// `store`, writes a new file in the folder profiles next to the calibrations. Returns { name, file, profile }. Errors:
/// as Bench::setProfile(); Io.
[[nodiscard]] Result<Json> keepProfile(ScriptSession& session, const SensorCalibration& found, double area_cm2,
                                       bool store);

}  // namespace tacto::host::sensor_calibration
