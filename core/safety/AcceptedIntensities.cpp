#include "core/safety/AcceptedIntensities.h"

#include <algorithm>

#include "core/safety/Rules.h"

namespace tacto {

using namespace gate;

namespace {
// 0.1 + 0.2 exceeds 0.3 in binary: levels on a decimal grid may miss their ceiling by rounding alone.
constexpr double kIntensityRounding = 1e-9;

/// An intensity beside what the person permits.
struct AskedIntensity {
    double intensity, discomfort, ceiling, step;
    bool ascending;
};

constexpr Rule<AskedIntensity> kIntensityRules[] = {
    {BurstDiscomfort, [](auto& a) { return !(a.intensity <= a.discomfort * (1 + kIntensityRounding)); },
     [](auto& a) {
         return fail(ErrorCode::LimitExceeded,
                     "the vibration would have intensity {:.4g}; this person's discomfort limit is {:.4g}", a.intensity,
                     a.discomfort);
     }},
    {BurstRamp, [](auto& a) { return !(a.intensity <= a.ceiling * (1 + kIntensityRounding)); },
     [](auto& a) {
         return fail(ErrorCode::LimitExceeded,
                     "the vibration would have intensity {:.4g}; {} allows at most {:.4g}, one step of {:.4g} above "
                     "the last accepted one",
                     a.intensity, a.ascending ? "this ascending series" : "the ramp rule", a.ceiling, a.step);
     }},
};

constexpr Rule<Result<void>> kIntensityAcceptanceRules[] = {
    {IntensityAccept, [](auto& permitted) { return !permitted; }, [](auto& permitted) { return failure(permitted); }},
};
}  // namespace

void AcceptedIntensities::begin(double discomfortLimit, double rampStep) noexcept {
    *this = AcceptedIntensities{};
    discomfort_ = discomfortLimit;
    step_ = rampStep;
}

void AcceptedIntensities::resume(double discomfortLimit, double rampStep) noexcept {
    discomfort_ = std::min(discomfort_, discomfortLimit);
    step_ = rampStep;
}

double AcceptedIntensities::ceiling() const noexcept {
    return std::min((ascending_ ? seriesLast_ : highest_) + step_, discomfort_);
}

Result<void> AcceptedIntensities::permits(double intensity) const {
    return judge(kIntensityRules, AskedIntensity{intensity, discomfort_, ceiling(), step_, ascending_});
}

Result<void> AcceptedIntensities::accept(double intensity) {
    if (auto kept = judge(kIntensityAcceptanceRules, permits(intensity)); !kept) return kept;
    highest_ = std::max(highest_, intensity);
    seriesLast_ = intensity;
    return {};
}

void AcceptedIntensities::reportDiscomfort(double intensity) noexcept {
    discomfort_ = std::min(discomfort_, intensity);
    highest_ = std::min(highest_, discomfort_);
    seriesLast_ = std::min(seriesLast_, discomfort_);
}

void AcceptedIntensities::beginAscending() noexcept {
    ascending_ = true;
    seriesLast_ = 0;
}

}  // namespace tacto
