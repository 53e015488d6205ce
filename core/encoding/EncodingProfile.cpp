#include "core/encoding/EncodingProfile.h"

#include <algorithm>
#include <cmath>

#include "core/base/LocaleFreeText.h"
#include "core/base/RecordFields.h"

namespace tacto {
namespace {

constexpr Word<CurveKind> kCurves[] = {
    {"linear", CurveKind::Linear}, {"logarithmic", CurveKind::Logarithmic}, {"power", CurveKind::Power}};
constexpr Word<Assignment> kAssignments[] = {{"texture_to_amplitude", Assignment::TextureToAmplitude},
                                             {"swapped", Assignment::Swapped}};
constexpr Word<Hold> kHolds[] = {{"voltage", Hold::Voltage}, {"charge", Hold::Charge}, {"energy", Hold::Energy}};
constexpr Word<PulseShape> kShapes[] = {{"symmetric", PulseShape::SymmetricBiphasic},
                                        {"asymmetric", PulseShape::AsymmetricBiphasic},
                                        {"monophasic", PulseShape::Monophasic}};
constexpr Word<Polarity> kPolarities[] = {{"positive", Polarity::Positive}, {"negative", Polarity::Negative}};

Result<void> increasing(std::string_view low, double lowValue, std::string_view high, double highValue,
                        std::string_view unit) {
    if (lowValue < highValue) return {};
    return invalid("{} {}{} is not below {} {}{}", low, lowValue, unit, high, highValue, unit);
}

Result<void> rangesIncrease(const EncodingProfile& p) {
    const auto amplitude =
        increasing("amplitude_min_v", p.amplitudeMin.value(), "amplitude_max_v", p.amplitudeMax.value(), " V");
    if (!amplitude) return amplitude;
    return increasing("interval_min_s", p.intervalMin.count(), "interval_max_s", p.intervalMax.count(), " s");
}

Result<void> strongestTrainIsPossible(const EncodingProfile& p) {
    PulseTrain strongest = p.train;
    strongest.amplitude = p.amplitudeMax;
    return validate(strongest);
}

Result<void> conditionsDiffer(const EncodingProfile& p) {
    const auto* second = secondIn(p.conditions, &Condition::name);
    if (second == nullptr) return {};
    return invalid("{}", givenTwice("condition \"{}\"", second->name));
}

Result<void> stepsAreLimitedOrNot(const EncodingProfile& p) {
    for (const auto& [key, ratio] : {std::pair{"amplitude_ratio_per_train", p.amplitudeRatioPerTrain},
                                     std::pair{"interval_ratio_per_train", p.intervalRatioPerTrain}}) {
        if (ratio != 0 && !(ratio > 1)) return invalid("{} {} is neither 0 (no limit) nor above 1 to 1000", key, ratio);
    }
    return {};
}

Result<void> trainsDoNotOverlap(const EncodingProfile& p) {
    const double duration = p.train.duration().count();
    if (duration < p.intervalMin.count()) return {};
    return invalid("a train of {} pulses at {} Hz lasts {:.6g} s, which is not below interval_min_s {} s",
                   p.train.pulses, p.train.rate.value(), duration, p.intervalMin.count());
}

RecordFields<EncodingProfile> buildEncodingFields() {
    using P = EncodingProfile;
    RecordFields<Condition> condition;
    condition.text("name", &Condition::name).required = true;
    condition.number("R", &Condition::R, {.low = 0, .high = 1}).required = true;
    condition.number("P", &Condition::P, {.low = 0, .high = 1}).required = true;

    RecordFields<P> all;
    all.number("amplitude_min_v", &P::amplitudeMin, {.low = 0.01, .high = 500, .unit = "V"});
    all.number("amplitude_max_v", &P::amplitudeMax, {.low = 0.01, .high = 500, .unit = "V"});
    all.number("interval_min_s", &P::intervalMin, {.low = 0.01, .high = 60, .unit = "s"});
    all.number("interval_max_s", &P::intervalMax, {.low = 0.01, .high = 60, .unit = "s"});
    all.word("amplitude_curve", in(&P::amplitudeCurve, &Curve::kind), kCurves);
    all.number("amplitude_beta", in(&P::amplitudeCurve, &Curve::beta), {.low = 0.1, .high = 10});
    all.word("interval_curve", in(&P::intervalCurve, &Curve::kind), kCurves);
    all.number("interval_beta", in(&P::intervalCurve, &Curve::beta), {.low = 0.1, .high = 10});
    all.word("assignment", &P::assignment, kAssignments);
    all.word("shape", in(&P::train, &PulseTrain::shape), kShapes);
    all.word("polarity", in(&P::train, &PulseTrain::polarity), kPolarities);
    all.number("phase_width_us", in(&P::train, &PulseTrain::phaseWidth), {.low = 1, .high = 1e5, .unit = "µs"});
    all.number("inter_phase_gap_us", in(&P::train, &PulseTrain::interPhaseGap), {.low = 0, .high = 1e5, .unit = "µs"});
    all.number("recharge_ratio", in(&P::train, &PulseTrain::rechargeRatio), {.low = 1, .high = 1000});
    all.number("pulses", in(&P::train, &PulseTrain::pulses), {.low = 1, .high = 1000});
    all.number("rate_hz", in(&P::train, &PulseTrain::rate), {.low = 0.1, .high = 1e4, .unit = "Hz"});
    all.number("amplitude_slew_v_per_s", &P::amplitudeSlew_V_per_s, {.low = 0, .high = 1e6, .unit = "V/s"});
    all.number("amplitude_ratio_per_train", &P::amplitudeRatioPerTrain, {.low = 0, .high = 1000});
    all.number("interval_ratio_per_train", &P::intervalRatioPerTrain, {.low = 0, .high = 1000});
    all.word("hold", &P::hold, kHolds);
    all.list("conditions", &P::conditions, condition.kind(), 1, 64);
    for (const auto rule :
         {rangesIncrease, strongestTrainIsPossible, conditionsDiffer, stepsAreLimitedOrNot, trainsDoNotOverlap})
        all.rule(rule);
    return all;
}

}  // namespace

std::string_view nameOf(CurveKind curve) noexcept { return wordFor(kCurves, curve); }
std::string_view nameOf(Hold hold) noexcept { return wordFor(kHolds, hold); }
std::string_view nameOf(Assignment assignment) noexcept { return wordFor(kAssignments, assignment); }

double Curve::at(double x, double from, double to) const noexcept {
    if (x <= 0) return from;
    if (x >= 1) return to;
    double y = from + x * (to - from);
    if (kind == CurveKind::Logarithmic) y = from * std::pow(to / from, x);
    if (kind == CurveKind::Power) y = from + (to - from) * std::pow(x, 1 / beta);
    return std::clamp(y, std::min(from, to), std::max(from, to));  // rounding must not exceed an end
}

std::vector<Condition> EncodingProfile::fourConditions(double low, double high) {
    return {{"smooth-low", low, low}, {"smooth-high", low, high}, {"rough-low", high, low}, {"rough-high", high, high}};
}

const Condition* EncodingProfile::condition(std::string_view name) const noexcept {
    for (const auto& each : conditions) {
        if (each.name == name) return &each;
    }
    return nullptr;
}

const RecordFields<EncodingProfile>& encodingFields() { return builtOnce<buildEncodingFields>(); }

Result<void> validate(const EncodingProfile& profile) { return encodingFields().check(profile, {}); }

Result<EncodingProfile> encodingProfileFrom(const nlohmann::json& section) {
    return encodingFields().read(section, {.path = "encoding"});
}

nlohmann::json toJson(const EncodingProfile& profile) { return encodingFields().write(profile); }

}  // namespace tacto
