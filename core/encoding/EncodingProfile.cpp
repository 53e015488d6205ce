#include "core/encoding/EncodingProfile.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace tacto {
namespace {

/// A range that a field must lie in, ends included, unless `above` excludes the lower one.
Result<void> within(std::string_view name, double value, double low, double high, std::string_view unit) {
    if (value >= low && value <= high) return {};
    return fail(ErrorCode::InvalidArgument, "{} {}{} is outside {} to {}{}", name, value, unit, low, high, unit);
}

Result<void> increasing(std::string_view low, double lowValue, std::string_view high, double highValue,
                        std::string_view unit) {
    if (lowValue < highValue) return {};
    return fail(ErrorCode::InvalidArgument, "{} {}{} is not below {} {}{}", low, lowValue, unit, high, highValue, unit);
}

Result<void> checkConditions(const std::vector<Condition>& conditions) {
    if (conditions.empty() || conditions.size() > 64) {
        return fail(ErrorCode::InvalidArgument, "{} conditions are not 1 to 64", conditions.size());
    }
    std::set<std::string_view> names;
    for (const auto& condition : conditions) {
        if (condition.name.empty()) return fail(ErrorCode::InvalidArgument, "a condition has no name");
        if (!names.insert(condition.name).second) {
            return fail(ErrorCode::InvalidArgument, "condition \"{}\" is there twice", condition.name);
        }
        for (const auto& [axis, value] : {std::pair{"R", condition.R}, std::pair{"P", condition.P}}) {
            if (auto checked = within(fmt::format("{} of condition \"{}\"", axis, condition.name), value, 0, 1, "");
                !checked) {
                return checked;
            }
        }
    }
    return {};
}

}  // namespace

std::string_view nameOf(CurveKind curve) noexcept {
    switch (curve) {
        case CurveKind::Linear:
            return "linear";
        case CurveKind::Logarithmic:
            return "logarithmic";
        case CurveKind::Power:
            return "power";
    }
    return "unknown";
}

std::string_view nameOf(Hold hold) noexcept {
    switch (hold) {
        case Hold::Charge:
            return "charge";
        case Hold::Energy:
            return "energy";
        default:
            return "voltage";
    }
}

std::string_view nameOf(Assignment assignment) noexcept {
    return assignment == Assignment::Swapped ? "swapped" : "texture_to_amplitude";
}

double Curve::at(double x, double from, double to) const noexcept {
    if (x <= 0) return from;
    if (x >= 1) return to;
    double y = from + x * (to - from);
    if (kind == CurveKind::Logarithmic) y = from * std::pow(to / from, x);
    if (kind == CurveKind::Power) y = from + (to - from) * std::pow(x, 1 / beta);
    return std::clamp(y, std::min(from, to), std::max(from, to));  // never beyond an end by a last bit
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

Result<void> validate(const EncodingProfile& p) {
    const double aMin = p.amplitudeMin.value();
    const double aMax = p.amplitudeMax.value();
    const double tMin = p.intervalMin.count();
    const double tMax = p.intervalMax.count();
    PulseTrain strongest = p.train;
    strongest.amplitude = p.amplitudeMax;
    for (const auto& checked : {
             within("amplitude_min_v", aMin, 0.01, 500, " V"),
             within("amplitude_max_v", aMax, 0.01, 500, " V"),
             increasing("amplitude_min_v", aMin, "amplitude_max_v", aMax, " V"),
             within("interval_min_s", tMin, 0.01, 60, " s"),
             within("interval_max_s", tMax, 0.01, 60, " s"),
             increasing("interval_min_s", tMin, "interval_max_s", tMax, " s"),
             within("amplitude_beta", p.amplitudeCurve.beta, 0.1, 10, ""),
             within("interval_beta", p.intervalCurve.beta, 0.1, 10, ""),
             validate(strongest),
             within("phase_width_us", p.train.phaseWidth.count(), 1, 1e5, " µs"),
             within("inter_phase_gap_us", p.train.interPhaseGap.count(), 0, 1e5, " µs"),
             within("recharge_ratio", p.train.rechargeRatio, 1, 1000, ""),
             within("pulses", p.train.pulses, 1, 1000, ""),
             within("rate_hz", p.train.rate.value(), 0.1, 1e4, " Hz"),
             within("amplitude_slew_v_per_s", p.amplitudeSlew_V_per_s, 0, 1e6, " V/s"),
             checkConditions(p.conditions),
         }) {
        if (!checked) return checked;
    }
    for (const auto& [key, ratio] : {std::pair{"amplitude_ratio_per_train", p.amplitudeRatioPerTrain},
                                     std::pair{"interval_ratio_per_train", p.intervalRatioPerTrain}}) {
        if (ratio != 0 && !(ratio > 1 && ratio <= 1000)) {
            return fail(ErrorCode::InvalidArgument, "{} {} is neither 0 (no limit) nor above 1 to 1000", key, ratio);
        }
    }
    const double duration = p.train.duration().count();
    if (!(duration < tMin)) {
        return fail(ErrorCode::InvalidArgument,
                    "a train of {} pulses at {} Hz lasts {:.6g} s, which is not below interval_min_s {} s",
                    p.train.pulses, p.train.rate.value(), duration, tMin);
    }
    return {};
}

}  // namespace tacto
