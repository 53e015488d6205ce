#include "drivers/sciencemode/PulsePlan.h"

#include <cmath>

namespace tacto::sciencemode {
namespace {

constexpr double kRounding_us = 1e-6;
constexpr double kCompliance_V = 150;  // the device's highest supply voltage

/// Adds `duration` at `current_mA`, in several points if one cannot hold it. Errors: as encodePoint(), but Device.
Result<void> addStretch(Points& points, std::string_view what, Micros duration, double current_mA) {
    const double us = std::round(duration.count());
    if (!(std::abs(duration.count() - us) <= kRounding_us) || !(us >= kMinPoint_us)) {
        return fail(ErrorCode::Device, "the stimulator refused a {} of {} µs: whole µs from {} up", what,
                    duration.count(), kMinPoint_us);
    }
    const int pieces = static_cast<int>(std::ceil(us / kMaxPoint_us));
    if (!(pieces <= static_cast<int>(kMaxPoints - points.count))) {
        return fail(ErrorCode::Device,
                    "the stimulator refused a pulse whose {} of {} µs does not fit its {} points of at most {} µs",
                    what, us, kMaxPoints, kMaxPoint_us);
    }
    const int total = static_cast<int>(us);
    for (int piece = 0; piece < pieces; ++piece) {
        // Equal parts: each is far above the shortest point.
        const int from = total * piece / pieces;
        const int to = total * (piece + 1) / pieces;
        const Point point{Micros(to - from), Milliamps(current_mA)};
        if (const auto bytes = encodePoint(point); !bytes) return fail(ErrorCode::Device, "{}", bytes.error().message);
        static_cast<void>(points.add(point));
    }
    return {};
}

Result<void> addPulse(Points& points, const PulseTrain& train, const PulsePlan& plan) {
    const double lead = plan.amplitude.value() * (train.polarity == Polarity::Positive ? 1 : -1);
    if (auto added = addStretch(points, "phase width", plan.leading, lead); !added) return added;
    if (plan.second.count() == 0) return {};
    if (plan.gap.count() > 0) {
        if (auto added = addStretch(points, "inter-phase gap", plan.gap, 0); !added) return added;
    }
    const double second = train.shape == PulseShape::AsymmetricBiphasic ? -lead / train.rechargeRatio : -lead;
    return addStretch(points, "second phase", plan.second, second);
}

}  // namespace

SourceTraits sourceTraits(bool readsBack) noexcept {
    SourceTraits traits;
    traits.drive = Drive::Current;
    traits.gap = GapState::HighImpedance;  // a point of 0 mA carries no current
    traits.amplitudeStep = kCurrentStep_mA;
    traits.amplitudeMax = kMaxCurrent_mA;
    traits.compliance = Volts(kCompliance_V);
    traits.currentLimit = Milliamps(kMaxCurrent_mA);
    traits.widthStep = Micros(1);
    traits.widthMin = Micros(kMinPoint_us);
    traits.widthMax = Micros(kMaxPoint_us);
    traits.pulsesMax = 1000;
    traits.deadMan = Seconds(2);
    traits.readsBack = readsBack;
    traits.checkCurrent = Milliamps(kCurrentStep_mA);
    return traits;
}

Result<PulsePlan> planPulse(const PulseTrain& train) {
    if (auto sane = validate(train); !sane) return failure(sane);
    const auto* current = std::get_if<Milliamps>(&train.amplitude);
    if (current == nullptr) {
        return fail(ErrorCode::Device, "the stimulator is a current source and refused a train in volts");
    }
    PulsePlan plan;
    plan.amplitude = *current;
    plan.leading = train.phaseWidth;
    if (!(plan.leading.count() <= kMaxPoint_us)) {
        return fail(ErrorCode::Device, "the stimulator refused a phase width of {} µs: {} to {} µs",
                    plan.leading.count(), kMinPoint_us, kMaxPoint_us);
    }
    if (train.shape != PulseShape::Monophasic) {
        plan.gap = train.interPhaseGap;
        plan.second = plan.leading * (train.shape == PulseShape::AsymmetricBiphasic ? train.rechargeRatio : 1.0);
    }
    if (auto added = addPulse(plan.points, train, plan); !added) return failure(added);
    return plan;
}

}  // namespace tacto::sciencemode
