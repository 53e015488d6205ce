// FingertipCalibration.h - the parts of a fingertip's calibration: its readings, what the operator says of the
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

struct FingertipRest {
    SensorRest levels;
    Statistics force;                 ///< in the sensor's unit
    std::optional<ForceInUse> inUse;  ///< nothing without a force sensor
    double duration_s = 0;
};
/// The result of bench.measureRest().
[[nodiscard]] Json toJson(const FingertipRest& rest);

// Readings. Each disarms first. Errors: without an answer, for too few samples, when the run is stopped.

/// Lifts the finger (question rest on a rig that cannot) and reads it without contact. Also an error: it was touched.
[[nodiscard]] Result<FingertipRest> readFingertipRest(ScriptSession& session, double duration_s);
/// Puts a weight on the resting finger (question weight-MASSg).
[[nodiscard]] Result<WeightReading> readWeight(ScriptSession& session, double mass_g, double gravity_m_s2,
                                               double duration_s);
[[nodiscard]] Result<SlideReading> readSliding(ScriptSession& session, const bench::Sliding& sliding, double duration_s,
                                               const SensorRest& rest);
[[nodiscard]] Json streamsOf(ScriptSession& session);

/// A surface with the roughness that the operator gave.
struct GivenSurface {
    std::string name;
    double ra_um = kNaN, rz_um = kNaN;  ///< Rz may be unknown
    std::string source = "typed in";
};
/// Members of "settings": smooth, smooth_ra_um, smooth_rz_um, smooth_file; the same of rough; more.
[[nodiscard]] std::vector<HostParameter> surfaceSettings();
/// The references first. Errors: InvalidArgument for a text that cannot be read, a surface that is named twice, an Rz
/// below its Ra, a rough reference that is not the rougher, a file that the operator did not choose.
[[nodiscard]] Result<std::vector<GivenSurface>> surfacesGiven(ScriptSession& session, const Arguments& arguments);
/// The weights in g, the smallest first; `text` has them separated by ";". Errors: InvalidArgument for a text that
/// cannot be read, a single weight, or a weight that comes twice.
[[nodiscard]] Result<std::vector<double>> massesGiven(const std::string& text);

/// bench.profilometer(): Ra and Rz of a file that the operator chose.
HostCall profilometer;

/// One weight on the fingertip, and the way it was reached.
struct Weighed {
    WeightReading reading;
    SweepDirection direction;
};
/// How well the references are known, relative; NaN: not known, and neither is the uncertainty of what rests on them.
struct WeighingTolerances {
    double weights = 0, gravity = kNaN, area = kNaN;
};
/// { mass_g, reference_n, measured, expanded_uncertainty, unit, deviation_pct, expanded_uncertainty_pct, allowed_pct,
/// verdict, passed }: verdict "not evaluated" and passed false where nothing was read or U is not known, passed null
/// without a reading.
struct KnownWeight {
    Json check;
    std::string reason;  ///< empty where it passed, and without a reading
};
/// Judged before anything is believed: a weight must read as it should, within the tolerance with its U, which comes
/// from the weight, local gravity and both readings. In counts nobody knows what it should read; then it must stand out
/// from rest by five standard deviations. `reading`: nothing where there is no weight or no force sensor.
[[nodiscard]] KnownWeight judgeWeight(const std::optional<WeightReading>& reading, const FingertipRest& rest,
                                      const WeighingTolerances& known, double tolerance_pct);

/// The size of one unit of force and of each taxel: { force, taxels: list }: force as SensorScale with unit, taxels {
/// taxel, unit, scale, offset_pa, … }; scale is null with a reason where there is none. `area_cm2` 0: not known.
[[nodiscard]] Json fingertipScales(const std::vector<Weighed>& weighed, double area_cm2,
                                   const WeighingTolerances& known);
/// Turns force and taxels into N and Pa by these scales for the rest of the run; R is uncalibrated until references
/// were read under them. Returns { force, taxels }: whether each is scaled now.
[[nodiscard]] Result<Json> useScales(ScriptSession& session, const Json& scales);

/// The profile that the operator chose, with the scales of R, force and taxels, the fingertip's serial number, the
/// surfaces and the rest that were found; these are in force for the rest of the run. `area_cm2` 0: the profile's. As a
/// file, where `store`, in the folder profiles beside the calibrations, never over an older one. Returns { name, file,
/// profile }. Errors: as Bench::setProfile(); Io.
[[nodiscard]] Result<Json> keepProfile(ScriptSession& session, const SensorCalibration& found, double area_cm2,
                                       bool store);

}  // namespace tacto::host::sensor_calibration
