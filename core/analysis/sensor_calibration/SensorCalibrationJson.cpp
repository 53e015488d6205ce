#include "core/analysis/sensor_calibration/SensorCalibrationJson.h"

#include <algorithm>
#include <cmath>

#include "core/analysis/calibration/CalibrationJson.h"
#include "core/analysis/statistics/StatisticsJson.h"
#include "core/base/JsonText.h"
#include "core/base/RecordFields.h"
#include "core/dsp/SensorScales.h"
#include "core/results/ResultRecord.h"

namespace tacto {

namespace {

using Json = nlohmann::json;

/// Names the logarithm of the feature in words.
std::string_view wordsOf(SensorFeature feature) noexcept {
    switch (feature) {
        case SensorFeature::H:
            return "vibration h";
        case SensorFeature::HAbs:
            return "vibration, absolute";
        case SensorFeature::VStatic:
            return "taxels, static";
        case SensorFeature::VDynamic:
            return "taxels, dynamic";
    }
    return "";
}

std::size_t indexOf(SensorFeature feature) { return static_cast<std::size_t>(feature); }

constexpr std::size_t kMaxTaxels = 100'000;

RecordFields<SensorRest> restFields() {
    RecordFields<SensorRest> all;
    all.list("taxel_baseline", in(&SensorRest::levels, &RestLevels::taxelBaseline), numberKind<double>({}), 0,
             kMaxTaxels);
    all.number("taxel_floor", in(&SensorRest::levels, &RestLevels::taxelFloor), {.low = 0});
    all.number("mean_square", in(&SensorRest::levels, &RestLevels::slidingMeanSquare));
    all.word("taxel_unit", &SensorRest::taxelUnit, kTaxelUnits);
    all.word("unit", &SensorRest::restUnit, kRestUnits);
    return all;
}

RecordFields<ForceInUse> forceFields() {
    RecordFields<ForceInUse> all;
    all.number("mean", &ForceInUse::mean);
    all.word("unit", &ForceInUse::unit, kForceUnits);
    all.number("u", &ForceInUse::uncertainty, {.low = 0});
    return all;
}

RecordFields<WeightReading> weightFields() {
    using W = WeightReading;
    RecordFields<W> all;
    all.number("mass_g", &W::mass_g, {.unit = "g"});
    all.number("reference_n", &W::reference_n, {.unit = "N"});
    all.number("force", &W::force);
    all.word("force_unit", &W::forceUnit, kForceUnits).leftOutIfEmpty = true;
    all.list("taxels", &W::taxels, readingKind(), 0, kMaxTaxels);
    all.word("taxel_unit", &W::taxelUnit, kTaxelUnits).leftOutIfEmpty = true;
    all.record("force_in_use", &W::inUse, forceFields());
    return all;
}

RecordFields<SlideReading> slideFields() {
    using S = SlideReading;
    RecordFields<S> all;
    all.number("h", &S::h);
    all.number("h_abs", &S::hAbs);
    all.number("v_static", &S::vStatic);
    all.number("v_dynamic", &S::vDynamic);
    all.number("force_n", &S::force_n);
    all.number("sliding_frames", &S::slidingFrames);
    return all;
}

}  // namespace

namespace {

using namespace describe;

/// A distance with the name of its feature.
struct NamedDistance {
    std::string of;
    SurfaceDistance distance;
};

Json toJson(const NamedDistance& named) {
    Json out = toJson(named.distance.magnitude());
    out["of"] = named.of;
    out["told_apart"] = named.distance.toldApart();
    out["pooled_sd"] = numberOrNull(named.distance.pooledSd);
    return out;
}

std::optional<NamedDistance> named(std::string of, const std::optional<SurfaceDistance>& distance) {
    return distance ? std::optional(NamedDistance{std::move(of), *distance}) : std::nullopt;
}

double expandedR(const SensorCalibration& found, double R) {
    return found.uncertainty ? found.uncertainty->expanded(R) : kNaN;
}

SensorFeature vibrationOf(const SensorCalibration& found) {
    return found.settings.spectral == SpectralFeature::Relative ? SensorFeature::H : SensorFeature::HAbs;
}
SensorFeature taxelsOf(const SensorCalibration& found) {
    return found.settings.taxel == TaxelFeature::Static ? SensorFeature::VStatic : SensorFeature::VDynamic;
}

/// A surface together with the calibration that contains it.
struct PlacedSurface {
    const SensorCalibration& calibration;
    SurfaceResult surface;
    double R;

    [[nodiscard]] double feature(SensorFeature one) const { return surface.features[indexOf(one)]; }
};

std::vector<PlacedSurface> surfacesOf(const SensorCalibration& found) {
    std::vector<PlacedSurface> all;
    for (const auto& surface : found.surfaces) {
        const double R = std::isnan(surface.R.mean) ? kNaN : std::clamp(surface.R.mean, 0.0, 1.0);
        all.push_back({found, surface, R});
    }
    return all;
}

ResultRecord<PlacedSurface> describeSurface() {
    using P = PlacedSurface;
    using S = SurfaceResult;
    ResultRecord<P> all;
    for (const auto feature : kSensorFeatures)
        all.kept(std::string(keyOf(feature)), [feature](const P& at) { return at.feature(feature); });
    all.shown(text("Surface", "name"), in(&P::surface, &S::name));
    all.shown(number("Ra", "ra_um", "um"), in(&P::surface, &S::ra_um));
    all.shown(number("Rz", "rz_um", "um"), in(&P::surface, &S::rz_um));
    all.shown(number("Slides", "slides"), in(&P::surface, &S::slides));
    all.shown(number("Vibration h", "h"), [](const P& at) { return at.feature(vibrationOf(at.calibration)); });
    all.shown(number("Taxels v", "v"), [](const P& at) { return at.feature(taxelsOf(at.calibration)); });
    all.shown(number("R", "R", "", "R_expanded_uncertainty"), &P::R);
    all.kept("R_expanded_uncertainty", [](const P& at) { return expandedR(at.calibration, at.R); });
    all.shown(spread("s.d. of R", "R_sd", ""), [](const P& at) { return at.surface.R.sd; });
    all.shown(number("Force", "force_n", "N"), [](const P& at) { return at.surface.force_n.mean; });
    all.shown(text("Ra and Rz are", "source"));  // taken from the operator
    return all;
}

/// U of R of one slide, at R 0, 0.5 and 1.
Json uncertaintyJson(const SensorCalibration& found) {
    if (!found.uncertainty) return {};
    Json out = roughnessUncertaintyFields().write(*found.uncertainty);
    out["smooth"] = numberOrNull(expandedR(found, 0));
    out["middle"] = numberOrNull(expandedR(found, 0.5));
    out["rough"] = numberOrNull(expandedR(found, 1));
    return out;
}

Json rankingJson(const SensorCalibration& found) {
    if (!found.ranking) return {};
    Json out = toJson(found.ranking->rho);
    out["n"] = found.ranking->n;
    out["ties"] = found.ranking->ties;
    out["note"] = found.ranking->note;
    return out;
}

ResultRecord<SensorCalibration> describeSensorCalibration() {
    using C = SensorCalibration;
    ResultRecord<C> all;
    all.kept("d_prime.h", [](const C& found) { return named("h", found.distances[indexOf(vibrationOf(found))]); });
    all.kept("d_prime.v", [](const C& found) { return named("v", found.distances[indexOf(taxelsOf(found))]); });
    all.kept("d_prime.R", [](const C& found) { return named("R", found.distanceR); });
    std::string distances = "d_prime.R";
    for (const auto feature : kSensorFeatures) {
        const auto key = "d_prime.all." + std::string(keyOf(feature));
        all.kept(key, [feature](const C& found) {
            return named(std::string(wordsOf(feature)), found.distances[indexOf(feature)]);
        });
        distances += '|' + key;
    }
    all.table(noted(rows("Distance of the two references, in d′ with its 95 % interval", distances.c_str(),
                         {text("Of", "of"), number("d′", ""), as(As::YesNo, "Told apart", "told_apart")}),
                    "d′ is the difference of the means over the pooled standard deviation of single slides; the "
                    "interval is from the non-central t distribution. Two surfaces are told apart when its lower end "
                    "is at least 1, the customary threshold at which one slide over each names the rougher in 76 % of "
                    "cases; otherwise the calibration is refused."));
    all.shown(number("Spearman's rank correlation of R and Ra", "spearman"), rankingJson);
    all.shown(number("Surfaces", "spearman.n"));
    all.shown(text("Note", "spearman.note"));
    all.kept("uncertainty_R", uncertaintyJson);
    all.shown(number("U of R for one slide, at R 0", "uncertainty_R.smooth"));
    all.shown(number("At R 0.5", "uncertainty_R.middle"));
    all.shown(number("At R 1", "uncertainty_R.rough"));
    all.shown(number("k", "uncertainty_R.coverage_factor"));
    all.shown(text("Profile", "profile.name"));  // the profile that the protocol wrote
    all.facts("Roughness");
    all.kept("surfaces", surfacesOf, describeSurface());
    all.table(
        rows("Surfaces, under the scale that was found", "surfaces", describeSurface().columns(), Else::InTheTerminal));
    all.kept("known_limit", [](const C&) { return kKnownLimitOfR; });
    all.kept("accepted", &C::accepted);
    all.kept("verdict", [](const C& found) { return found.accepted ? "pass" : "fail"; });
    all.kept("reasons", &C::reasons);
    all.kept("warnings", &C::warnings);
    all.kept("roughness", &C::settings);
    return all;
}

/// reference = reading times scale, plus offset. In the nested fit, readings are a function of the references.
ResultRecord<SensorScale> describeScale() {
    using S = SensorScale;
    const auto& fit = calibrationRecord();
    ResultRecord<S> all;
    all.merge(&S::fit, fit);
    all.kept("offset_reading", in(&S::fit, &Calibration::offset));
    all.shown(number("Scale (N per reading)", "scale", "", "scale_expanded_uncertainty"), &S::scale);
    all.kept("scale_expanded_uncertainty", &S::scaleU);
    all.shown(number("Offset", "offset", "N", "offset_expanded_uncertainty"), &S::offset);
    all.kept("offset_expanded_uncertainty", &S::offsetU);
    for (const auto& column : fit.columns()) all.shown(column);
    all.shown(text("Reason", "reason"));  // why there is no scale
    return all;
}

const ResultRecord<SensorCalibration>& sensorRecord() { return builtOnce<describeSensorCalibration>(); }

/// The protocol adds the scales, the readings for them, and the reference.
Tables sensorTables() {
    Tables all{facts("Known reference", "reference",
                     {number("Mass", "mass_g", "g"), number("Weight", "reference_n", "N"),
                      number("Read as", "measured", "@unit", "expanded_uncertainty"),
                      number("Deviation", "deviation_pct", "%", "expanded_uncertainty_pct"),
                      number("Allowed, ±", "allowed_pct", "%"), verdict()})};
    std::ranges::copy(sensorRecord().tables(), std::back_inserter(all));
    const Tables read{
        facts("Force", "force", builtOnce<describeScale>().columns()),
        rows("Force, weight by weight", "force.levels",
             {number("Weight", "commanded", "N"), number("n", "n"), number("Mean reading", "mean"),
              number("Going up", "mean_up"), number("Going down", "mean_down"), spread("s", "s", ""),
              spread("Residual", "residual", "")},
             Else::InTheTerminal),
        noted(
            rows("Taxels against force over the contact area", "taxels",
                 {number("Taxel", "taxel"), number("Scale (Pa per reading)", "scale", "", "scale_expanded_uncertainty"),
                  number("Offset", "offset_pa", "Pa", "offset_expanded_uncertainty_pa"),
                  spread("Largest residual", "residual_max_pct_fs", "% FS"), text("Reason", "reason")},
                 Else::InTheTerminal),
            "A taxel's scale takes the weight as spread evenly over the contact area; it holds for a contact of that "
            "shape. Its U holds the tolerances of the weights, of local gravity and of the contact area; where one is "
            "not known there is no U."),
        rows("Slides", "slides",
             {text("Surface", "material"), number("Vibration h", "h"), number("Vibration, absolute", "h_abs"),
              number("Taxels, static", "v_static"), number("Taxels, dynamic", "v_dynamic"),
              number("Force", "force_n", "N"), number("Sliding frames", "sliding_frames")},
             Else::InTheTerminal),
        rows("Weights", "weights",
             {number("Mass", "mass_g", "g"), text("Direction", "direction"), number("Repeat", "repeat"),
              number("Weight", "reference_n", "N"), number("Read as", "force", "@force_unit")},
             Else::InBoth),
        facts("At rest, nothing touched", "rest",
              {number("Acceleration, 5 Hz to 1 kHz: mean square", "mean_square"), text("in the square of", "unit"),
               number("Taxels' floor", "taxel_floor", "@taxel_unit"), text("Taxels' baselines", "taxel_baseline")},
              Else::InTheTerminal),
        rows("Instruments", "instruments",
             {text("Role", "role"), text("Instrument", "name"), text("Serial", "serial"),
              as(As::YesNo, "Simulated", "simulated")},
             Else::InBoth),
        sentences("Warnings", "warnings"),
        sentences("Warnings of the force", "force.warnings")};
    std::ranges::copy(read, std::back_inserter(all));
    return all;
}

}  // namespace

Json toJson(const SensorCalibration& found) { return sensorRecord().write(found); }

Json toJson(const SensorScale& found) { return builtOnce<describeScale>().write(found); }

ResultTraits sensorCalibrationKind() {
    return {.kind = ResultKind::SensorCalibration,
            .name = "sensor-calibration",
            .decisionRule =
                "Accepted when the 95 % interval of d′ between the two references begins at 1 or above: the "
                "scale then tells them apart.",
            .members = sensorRecord().keys(),
            .tables = sensorTables()};
}

Json toJson(const SensorRest& rest) { return builtOnce<restFields>().write(rest); }

Json toJson(const SlideReading& slide) { return builtOnce<slideFields>().write(slide); }

Json toJson(const ForceInUse& force) { return forceFields().write(force); }

Json toJson(const WeightReading& reading) { return builtOnce<weightFields>().write(reading); }

}  // namespace tacto
