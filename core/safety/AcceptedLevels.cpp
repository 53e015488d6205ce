#include "core/safety/AcceptedLevels.h"

#include <algorithm>

#include "core/safety/Rules.h"

namespace tacto {

using namespace gate;

namespace {
// 0.1 + 0.2 exceeds 0.3 in binary: a level on a decimal grid may exceed its ceiling by rounding alone.
constexpr double kLevelRounding = 1e-9;

/// Does not convert through amperes: 4.5 mA would come back as slightly more, and exceed a limit of 4.5.
double milliamps(const PulseTrain& train) noexcept {
    const auto* current = std::get_if<Milliamps>(&train.amplitude);
    return current != nullptr ? current->value() : siValue(train.amplitude) * 1e3;
}

PulseTrain kindOf(PulseTrain train) noexcept {
    train.amplitude = Milliamps(0);
    return train;
}

/// A requested level and what the person permits, in mA.
struct AskedLevel {
    bool inVolts;
    double level, discomfort, cap, ceiling, step;
    bool ascending;
};

constexpr Rule<AskedLevel> kLevelRules[] = {
    {LevelInVolts, [](auto& a) { return a.inVolts; },
     [](auto&) { return invalid("a person's level is a current in mA; volts were asked for"); }},
    {LevelDiscomfort, [](auto& a) { return !(a.level <= a.discomfort); },
     [](auto& a) {
         return fail(ErrorCode::LimitExceeded,
                     "current would be {:.4g} mA; this person's discomfort limit is {:.4g} mA", a.level, a.discomfort);
     }},
    {LevelCap, [](auto& a) { return !(a.level <= a.cap * (1 + kLevelRounding)); },
     [](auto& a) {
         return fail(ErrorCode::LimitExceeded, "current would be {:.4g} mA; the study's cap is {:.4g} mA", a.level,
                     a.cap);
     }},
    {LevelRamp, [](auto& a) { return !(a.level <= a.ceiling * (1 + kLevelRounding)); },
     [](auto& a) {
         return fail(ErrorCode::LimitExceeded,
                     "current would be {:.4g} mA; {} allows at most {:.4g} mA, one step of {:.4g} mA above the last "
                     "accepted level",
                     a.level, a.ascending ? "this ascending series" : "the ramp rule", a.ceiling, a.step);
     }},
};

constexpr Rule<Result<void>> kAcceptanceRules[] = {
    {LevelAccept, [](auto& permitted) { return !permitted; }, [](auto& permitted) { return failure(permitted); }},
};

/// A requested intensity and what the person permits.
struct AskedIntensity {
    double intensity, discomfort, ceiling, step;
    bool ascending;
};

constexpr Rule<AskedIntensity> kIntensityRules[] = {
    {BurstDiscomfort, [](auto& a) { return !(a.intensity <= a.discomfort * (1 + kLevelRounding)); },
     [](auto& a) {
         return fail(ErrorCode::LimitExceeded,
                     "the vibration would have intensity {:.4g}; this person's discomfort limit is {:.4g}", a.intensity,
                     a.discomfort);
     }},
    {BurstRamp, [](auto& a) { return !(a.intensity <= a.ceiling * (1 + kLevelRounding)); },
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

void AcceptedScale::begin(double discomfortLimit, double rampStep) noexcept {
    *this = AcceptedScale{};
    discomfort_ = discomfortLimit;
    step_ = rampStep;
}

void AcceptedScale::resume(double discomfortLimit, double rampStep) noexcept {
    discomfort_ = std::min(discomfort_, discomfortLimit);
    step_ = rampStep;
}

void AcceptedScale::keep(double level) noexcept {
    highest_ = std::max(highest_, level);
    seriesLast_ = level;
}

void AcceptedScale::reportDiscomfort(double level) noexcept {
    discomfort_ = std::min(discomfort_, level);
    highest_ = std::min(highest_, discomfort_);
    seriesLast_ = std::min(seriesLast_, discomfort_);
}

void AcceptedScale::beginAscending() noexcept {
    ascending_ = true;
    seriesLast_ = 0;
}

void AcceptedLevels::begin(Milliamps discomfortLimit, Milliamps rampStep, std::optional<Milliamps> cap) noexcept {
    *this = AcceptedLevels{};
    AcceptedScale::begin(discomfortLimit.value(), rampStep.value());
    if (cap) cap_ = cap->value();
}

void AcceptedLevels::resume(Milliamps discomfortLimit, Milliamps rampStep, std::optional<Milliamps> cap) noexcept {
    AcceptedScale::resume(discomfortLimit.value(), rampStep.value());
    cap_ = cap ? cap->value() : std::numeric_limits<double>::infinity();
}

bool AcceptedLevels::sameKind(const PulseTrain& train) const noexcept { return kindOf(train) == kindOf(kind_); }

Milliamps AcceptedLevels::ceilingFor(const PulseTrain& train) const noexcept {
    return Milliamps(std::min({(sameKind(train) ? accepted() : 0) + step_, discomfort_, cap_}));
}

Result<void> AcceptedLevels::permits(const PulseTrain& train) const {
    return judge(kLevelRules, AskedLevel{!isCurrent(train.amplitude), milliamps(train), discomfort_, cap_,
                                         ceilingFor(train).value(), step_, ascending_});
}

Result<void> AcceptedLevels::accept(const PulseTrain& train) {
    if (auto kept = judge(kAcceptanceRules, permits(train)); !kept) return kept;
    if (!sameKind(train)) {
        kind_ = kindOf(train);
        forget();
    }
    keep(milliamps(train));
    return {};
}

double AcceptedIntensities::ceiling() const noexcept { return std::min(accepted() + step_, discomfort_); }

Result<void> AcceptedIntensities::permits(double intensity) const {
    return judge(kIntensityRules, AskedIntensity{intensity, discomfort_, ceiling(), step_, ascending_});
}

Result<void> AcceptedIntensities::accept(double intensity) {
    if (auto kept = judge(kIntensityAcceptanceRules, permits(intensity)); !kept) return kept;
    keep(intensity);
    return {};
}

}  // namespace tacto
