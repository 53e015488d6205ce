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

using namespace describe;

/// Gives the symbol of a unit, or of an optional one.
template <class Get>
auto symbolAt(Get get) {
    return [get](const auto& record) {
        const auto& unit = std::invoke(get, record);
        if constexpr (detail::kIsOptional<std::remove_cvref_t<decltype(unit)>>)
            return unit ? std::optional(symbolOf(*unit)) : std::nullopt;
        else
            return symbolOf(unit);
    };
}

ResultRecord<ForceInUse> describeForceInUse() {
    using F = ForceInUse;
    ResultRecord<F> all;
    all.kept("mean", &F::mean);
    all.kept("unit", symbolAt(&F::unit));
    all.kept("u", &F::uncertainty);
    return all;
}

ResultRecord<FingertipRest> describeRest() {
    using F = FingertipRest;
    const auto levels = [](auto member) { return in(&F::levels, member); };
    ResultRecord<F> all;
    all.kept("mean_square", levels(in(&SensorRest::levels, &RestLevels::slidingMeanSquare)));
    all.shown(number("Acceleration, 5 Hz to 1 kHz: RMS", "rms", "@unit"),
              [](const F& rest) { return std::sqrt(rest.levels.levels.slidingMeanSquare); });
    all.kept("unit", symbolAt(levels(&SensorRest::restUnit)));
    all.shown(number("Taxels' floor", "taxel_floor", "@taxel_unit"),
              levels(in(&SensorRest::levels, &RestLevels::taxelFloor)));
    all.kept("taxel_unit", symbolAt(levels(&SensorRest::taxelUnit)));
    all.shown(text("Taxels' baselines", "taxel_baseline"), levels(in(&SensorRest::levels, &RestLevels::taxelBaseline)));
    all.kept("duration_s", &F::duration_s);
    all.kept("force", &F::force);
    all.kept("force_in_use", &F::inUse, describeForceInUse());
    return all;
}

ResultRecord<WeightReading> describeWeight() {
    using W = WeightReading;
    ResultRecord<W> all;
    all.shown(number("Mass", "mass_g", "g"), &W::mass_g);
    all.shown(number("Weight", "reference_n", "N"), &W::reference_n);
    all.shown(number("Read as", "force", "@force_unit"), &W::force);
    all.keptIfAny("force_unit", symbolAt(&W::forceUnit));
    all.kept("taxels", &W::taxels);
    all.keptIfAny("taxel_unit", symbolAt(&W::taxelUnit));
    all.kept("force_in_use", &W::inUse, describeForceInUse());
    return all;
}

ResultRecord<Weighed> describeWeighed() {
    const auto weight = describeWeight();
    ResultRecord<Weighed> all;
    all.merge(&Weighed::reading, weight);
    all.shown(weight.column("mass_g"));
    all.shown(text("Direction", "direction"), &Weighed::direction);
    all.shown(number("Repeat", "repeat"), &Weighed::repeat);
    all.shown(weight.column("reference_n"));
    all.shown(weight.column("force"));
    return all;
}

ResultRecord<Slid> describeSlide() {
    using S = SlideReading;
    const auto read = [](auto member) { return in(&Slid::reading, member); };
    ResultRecord<Slid> all;
    all.shown(text("Surface", "material"), &Slid::material);
    all.shown(number("Vibration h", "h"), read(&S::h));
    all.shown(number("Vibration, absolute", "h_abs"), read(&S::hAbs));
    all.shown(number("Taxels, static", "v_static"), read(&S::vStatic));
    all.shown(number("Taxels, dynamic", "v_dynamic"), read(&S::vDynamic));
    all.shown(number("Force", "force_n", "N"), read(&S::force_n));
    all.shown(number("Sliding frames", "sliding_frames"), read(&S::slidingFrames));
    return all;
}

ResultRecord<KnownWeight> describeKnownWeight() {
    using K = KnownWeight;
    const auto ifWeighed = [](auto get) {
        return [get](const K& known) { return known.weighed ? std::optional(resultJson(get(known))) : std::nullopt; };
    };
    ResultRecord<K> all;
    all.shown(number("Mass", "mass_g", "g"), &K::mass_g);
    all.shown(number("Weight", "reference_n", "N"), &K::reference_n);
    all.shown(number("Read as", "measured", "@unit", "expanded_uncertainty"), &K::measured);
    all.kept("expanded_uncertainty", &K::expanded);
    all.keptIfAny("unit", ifWeighed(symbolAt(&K::unit)));
    all.mergeShown(std::identity(), referenceCheckRecord());
    all.kept("passed", [](const K& known) { return known.weighed ? Json(known.passed()) : Json(); });
    return all;
}

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

/// The members that a surface has before it is felt.
template <class Surface>
ResultRecord<Surface> describeGiven() {
    ResultRecord<Surface> all;
    all.shown(text("Surface", "name"), &Surface::name);
    all.shown(number("Ra", "ra_um", "um"), &Surface::ra_um);
    all.shown(number("Rz", "rz_um", "um"), &Surface::rz_um);
    all.shown(text("Ra and Rz are", "source"), &Surface::source);
    return all;
}

ResultRecord<PlacedSurface> describeSurface() {
    using P = PlacedSurface;
    using S = SurfaceResult;
    const auto given = describeGiven<S>();
    ResultRecord<P> all;
    all.merge(&P::surface, given);
    for (const auto feature : kSensorFeatures)
        all.kept(std::string(keyOf(feature)), [feature](const P& at) { return at.feature(feature); });
    for (const char* key : {"name", "ra_um", "rz_um"}) all.shown(given.column(key));
    all.shown(number("Slides", "slides"), in(&P::surface, &S::slides));
    all.shown(number("Vibration h", "h"), [](const P& at) { return at.feature(vibrationOf(at.calibration)); });
    all.shown(number("Taxels v", "v"), [](const P& at) { return at.feature(taxelsOf(at.calibration)); });
    all.shown(number("R", "R", "", "R_expanded_uncertainty"), &P::R);
    all.kept("R_expanded_uncertainty", [](const P& at) { return expandedR(at.calibration, at.R); });
    all.shown(spread("s.d. of R", "R_sd", ""), [](const P& at) { return at.surface.R.sd; });
    all.shown(number("Force", "force_n", "N"), [](const P& at) { return at.surface.force_n.mean; });
    all.shown(given.column("source"));
    return all;
}

/// The expanded uncertainty of one slide's R, at R = 0, 0.5 and 1.
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
    return all;
}

/// Gives the reason why there is no scale, or nothing.
std::optional<std::string> reasonOf(const FingertipScale& scale) {
    return scale.reason.empty() ? std::nullopt : std::optional(scale.reason);
}

ResultRecord<FingertipScale> describeForce() {
    using F = FingertipScale;
    ResultRecord<F> all;
    all.kept("scale", [](const F&) { return Json(); });
    all.mergeShown(&F::found, describeScale());
    all.shown(text("Reason", "reason"));
    all.keptIfAny("reason", reasonOf);
    all.keptIfAny("unit", symbolAt(&F::unit));
    all.keptIfAny("follows", [](const F& of) { return of.follows ? std::nullopt : std::optional(false); });
    all.keptIfAny("asked", [](const F& of) { return of.asked ? std::optional(true) : std::nullopt; });
    return all;
}

struct NumberedTaxel {
    std::size_t taxel;  ///< from 1
    FingertipScale scale;
};

ResultRecord<NumberedTaxel> describeTaxel() {
    using N = NumberedTaxel;
    using S = SensorScale;
    const auto found = [](auto member) {
        return [member](const N& row) { return row.scale.found ? std::invoke(member, *row.scale.found) : kNaN; };
    };
    ResultRecord<N> all;
    all.merge(&N::scale, describeForce().only({"unit", "follows"}));
    all.shown(number("Taxel", "taxel"), &N::taxel);
    all.shown(number("Scale (Pa per reading)", "scale", "", "scale_expanded_uncertainty"), found(&S::scale));
    all.kept("scale_expanded_uncertainty", found(&S::scaleU));
    all.shown(number("Offset", "offset_pa", "Pa", "offset_expanded_uncertainty_pa"), found(&S::offset));
    all.kept("offset_expanded_uncertainty_pa", found(&S::offsetU));
    all.shown(spread("Largest residual", "residual_max_pct_fs", "% FS"),
              found(in(&S::fit, &Calibration::residualMax_pct)));
    all.shown(text("Reason", "reason"), [](const N& row) { return reasonOf(row.scale); });
    return all;
}

ResultRecord<FingertipScales> describeScales() {
    using F = FingertipScales;
    ResultRecord<F> all;
    all.kept("force", &F::force, describeForce());
    all.kept(
        "taxels",
        [](const F& scales) {
            std::vector<NumberedTaxel> rows;
            for (const auto& taxel : scales.taxels) rows.push_back({rows.size() + 1, taxel});
            return rows;
        },
        describeTaxel());
    return all;
}

const ResultRecord<SensorCalibration>& sensorRecord() { return builtOnce<describeSensorCalibration>(); }

/// The protocol adds the scales, the readings for them, and the reference.
Tables sensorTables() {
    Tables all{facts("Known reference", "reference", builtOnce<describeKnownWeight>().columns())};
    std::ranges::copy(sensorRecord().tables(), std::back_inserter(all));
    const Tables read{
        facts("Force", "force", describeForce().columns()),
        rows("Force, weight by weight", "force.levels",
             {number("Weight", "commanded", "N"), number("n", "n"), number("Mean reading", "mean"),
              number("Going up", "mean_up"), number("Going down", "mean_down"), spread("s", "s", ""),
              spread("Residual", "residual", "")},
             Else::InTheTerminal),
        noted(
            rows("Taxels against force over the contact area", "taxels", describeTaxel().columns(),
                 Else::InTheTerminal),
            "A taxel's scale takes the weight as spread evenly over the contact area; it holds for a contact of that "
            "shape. Its U holds the tolerances of the weights, of local gravity and of the contact area; where one is "
            "not known there is no U."),
        rows("Slides", "slides", builtOnce<describeSlide>().columns(), Else::InTheTerminal),
        rows("Weights", "weights", builtOnce<describeWeighed>().columns(), Else::InBoth),
        facts("At rest, nothing touched", "rest", builtOnce<describeRest>().columns(), Else::InTheTerminal),
        rows("Instruments", "instruments", instrumentColumns(), Else::InBoth),
        sentences("Warnings", "warnings"),
        sentences("Warnings of the force", "force.warnings")};
    std::ranges::copy(read, std::back_inserter(all));
    return all;
}

}  // namespace

Json toJson(const SensorCalibration& found) { return sensorRecord().write(found); }

Json toJson(const SlidSurface& surface) { return builtOnce<describeGiven<SlidSurface>>().write(surface); }

Json toJson(const FingertipScales& scales) { return builtOnce<describeScales>().write(scales); }

ResultTraits sensorCalibrationKind() {
    return {.kind = ResultKind::SensorCalibration,
            .name = "sensor-calibration",
            .decisionRule =
                "Accepted when the 95 % interval of d′ between the two references begins at 1 or above: the "
                "scale then tells them apart.",
            .members = sensorRecord().keys(),
            .tables = sensorTables()};
}

Json toJson(const FingertipRest& rest) { return builtOnce<describeRest>().write(rest); }

Json toJson(const Slid& slide) { return builtOnce<describeSlide>().write(slide); }

Json toJson(const WeightReading& reading) { return builtOnce<describeWeight>().write(reading); }

Json toJson(const Weighed& weighed) { return builtOnce<describeWeighed>().write(weighed); }

Json toJson(const KnownWeight& known) { return builtOnce<describeKnownWeight>().write(known); }

std::vector<std::string> restMembers() { return builtOnce<describeRest>().keys(); }

std::vector<std::string> weightMembers() { return builtOnce<describeWeight>().keys(); }

}  // namespace tacto
