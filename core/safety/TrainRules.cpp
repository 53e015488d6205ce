#include <cmath>

#include "core/safety/GateState.h"
#include "core/safety/Rules.h"

namespace tacto::gate {

namespace {
constexpr Instant kImpedanceAge = std::chrono::seconds(5);

double inOwnUnit(const Amplitude& amplitude) noexcept {
    return std::visit([](auto a) { return a.value(); }, amplitude);
}

// --- form, source and grid ------------------------------------------------------------------------------------------

/// A train with its interval, and the source's abilities.
struct TrainForm {
    const PulseTrain& train;
    Seconds interval;
    const SourceTraits& source;
    [[nodiscard]] bool current() const noexcept { return isCurrent(train.amplitude); }
    [[nodiscard]] const char* unit() const noexcept { return amplitudeUnit(train.amplitude); }
    [[nodiscard]] double amplitude() const noexcept { return inOwnUnit(train.amplitude); }
};

/// True if the value is a multiple of `step`, apart from the rounding of decimal steps in binary.
bool onGrid(double value, double step) noexcept {
    if (step == 0) return true;
    const double steps = value / step;
    return std::abs(steps - std::round(steps)) <= 1e-6;
}

constexpr Rule<TrainForm> kFormRules[] = {
    {MalformedTrain, [](auto& f) { return !validate(f.train); }, [](auto& f) { return failure(validate(f.train)); }},
    {SourceKind, [](auto& f) { return f.current() != (f.source.drive == Drive::Current); },
     [](auto& f) { return invalid("an amplitude in {} was asked of a {} source", f.unit(), nameOf(f.source.drive)); }},
    {AmplitudeMax, [](auto& f) { return !(f.amplitude() <= f.source.amplitudeMax * (1 + kRounding)); },
     [](auto& f) {
         return invalid("amplitude {:.6g} {} is above the device's largest, {:.6g} {}", f.amplitude(), f.unit(),
                        f.source.amplitudeMax, f.unit());
     }},
    {AmplitudeGrid, [](auto& f) { return !onGrid(f.amplitude(), f.source.amplitudeStep); },
     [](auto& f) {
         return invalid("amplitude {:.9g} {} is not a multiple of the device's step, {:.6g} {}", f.amplitude(),
                        f.unit(), f.source.amplitudeStep, f.unit());
     }},
    {WidthRange,
     [](auto& f) {
         const double width = f.train.phaseWidth.count();
         return !(width >= f.source.widthMin.count() * (1 - kRounding) &&
                  width <= f.source.widthMax.count() * (1 + kRounding));
     },
     [](auto& f) {
         return invalid("phase width {:.6g} us is outside the device's {:.6g} to {:.6g} us", f.train.phaseWidth.count(),
                        f.source.widthMin.count(), f.source.widthMax.count());
     }},
    {WidthGrid, [](auto& f) { return !onGrid(f.train.phaseWidth.count(), f.source.widthStep.count()); },
     [](auto& f) {
         return invalid("phase width {:.9g} us is not a multiple of the device's step, {:.6g} us",
                        f.train.phaseWidth.count(), f.source.widthStep.count());
     }},
    {GapGrid,
     [](auto& f) {
         return f.train.shape != PulseShape::Monophasic &&
                !onGrid(f.train.interPhaseGap.count(), f.source.widthStep.count());
     },
     [](auto& f) {
         return invalid("inter-phase gap {:.9g} us is not a multiple of the device's step, {:.6g} us",
                        f.train.interPhaseGap.count(), f.source.widthStep.count());
     }},
    {PulsesMax, [](auto& f) { return !(f.train.pulses <= f.source.pulsesMax); },
     [](auto& f) {
         return invalid("{} pulses a train are more than the device's {}", f.train.pulses, f.source.pulsesMax);
     }},
    {IntervalValue, [](auto& f) { return !(std::isfinite(f.interval.count()) && f.interval.count() > 0); },
     [](auto& f) { return invalid("interval {} s is not a finite time above 0", f.interval.count()); }},
    {IntervalBelowTrain, [](auto& f) { return !(f.train.duration().count() <= f.interval.count() * (1 + kRounding)); },
     [](auto& f) {
         return invalid("interval {:.6g} s is shorter than the train, {} pulses at {:.6g} Hz", f.interval.count(),
                        f.train.pulses, f.train.rate.value());
     }},
};

// --- what the gate knows --------------------------------------------------------------------------------------------

constexpr Rule<AskedTrain> kAskedRules[] = {
    {OnsetAhead, [](auto& a) { return a.onset > a.now + kApprovalLife; },
     [](auto& a) {
         return invalid("the train is planned {:.3g} s ahead; an approval lasts 0.1 s", toSeconds(a.onset - a.now));
     }},
    {ImpedanceRejected, [](auto& a) { return a.state.impedanceRejected; },
     [](auto&) {
         return fail(ErrorCode::LimitExceeded,
                     "the last impedance reading was out of range; a good one is needed first");
     }},
};

/// Values may leave the calibrated range by the largest calibration error, or to the side that adds no exposure.
constexpr double kSlack = 1 + kLargestMiscalibration;

/// Returns null if no calibration is complete; configure() refuses that.
const StimulatorCalibration* calibrationOf(const AskedTrain& a) noexcept {
    const auto& known = a.state.setup->calibration;
    return known && known->complete() ? &*known : nullptr;
}

tl::unexpected<Error> beyond(std::string_view what, double programmed, std::string_view unit, double end) {
    return fail(ErrorCode::LimitExceeded,
                "{} {:.4g} {} is beyond the range in which the stimulator was calibrated, which ends at {:.4g} {}",
                what, programmed, unit, end, unit);
}

Result<void> permittedLevel(const AskedTrain& a) { return a.state.levels->permits(a.state.bounds->levelOf(a.train)); }

constexpr Rule<AskedTrain> kPersonTrainRules[] = {
    {PersonMonophasic, [](auto& a) { return a.train.shape == PulseShape::Monophasic; },
     [](auto&) { return fail(ErrorCode::LimitExceeded, "monophasic pulses are refused for a person"); }},
    {PersonNoImpedance, [](auto& a) { return !a.state.impedance; },
     [](auto&) {
         return fail(ErrorCode::LimitExceeded, "no impedance was measured; a person's is needed before a train");
     }},
    {PersonStaleImpedance, [](auto& a) { return a.state.impedance && !(a.now - a.state.impedanceAt <= kImpedanceAge); },
     [](auto& a) {
         return fail(ErrorCode::LimitExceeded, "the impedance was measured {:.3g} s ago; at most 5 s is accepted",
                     toSeconds(a.now - a.state.impedanceAt));
     }},
    {PersonBeyondAmplitude,
     [](auto& a) {
         const auto* known = calibrationOf(a);
         return known != nullptr && !(inOwnUnit(a.train.amplitude) <= known->amplitude.highest * kSlack);
     },
     [](auto& a) {
         return beyond("amplitude", inOwnUnit(a.train.amplitude), "mA", calibrationOf(a)->amplitude.highest);
     }},
    {PersonBeyondWidth,
     [](auto& a) {
         const auto* known = calibrationOf(a);
         return known != nullptr && !(Seconds(a.train.phaseWidth).count() <= known->phaseWidth->highest * kSlack);
     },
     [](auto& a) {
         return beyond("phase width", Seconds(a.train.phaseWidth).count() * 1e6, "us",
                       calibrationOf(a)->phaseWidth->highest * 1e6);
     }},
    {PersonBeyondInterval,
     [](auto& a) {
         const auto* known = calibrationOf(a);
         return known != nullptr && !(a.interval.count() >= known->interval->lowest / kSlack);
     },
     [](auto& a) { return beyond("interval", a.interval.count(), "s", calibrationOf(a)->interval->lowest); }},
    {PersonLevel, [](auto& a) { return !permittedLevel(a); }, [](auto& a) { return failure(permittedLevel(a)); }},
};

double checkLevel(const AskedTrain& a) noexcept { return siValue(a.state.bounds->levelOf(a.train).amplitude) * 1e3; }

constexpr Rule<AskedTrain> kCheckRules[] = {
    {CheckOnsetAhead, [](auto& a) { return a.onset > a.now + kApprovalLife; },
     [](auto& a) {
         return invalid("the check is planned {:.3g} s ahead; an approval lasts 0.1 s", toSeconds(a.onset - a.now));
     }},
    {CheckDiscomfort,
     [](auto& a) { return a.state.person() && !(checkLevel(a) <= a.state.levels->discomfortLimit().value()); },
     [](auto& a) {
         return fail(ErrorCode::LimitExceeded,
                     "the check pulse of {:.4g} mA is above this person's discomfort limit of {:.4g} mA", checkLevel(a),
                     a.state.levels->discomfortLimit().value());
     }},
};

// --- times, and the unit's past -------------------------------------------------------------------------------------

Seconds shortestInterval(const AskedTrain& a) noexcept { return a.state.bounds->intervals(a.interval).least; }
PulseTrain densestOf(const AskedTrain& a) noexcept { return a.state.bounds->densest(a.train); }
PulseTrain longestOf(const AskedTrain& a) noexcept { return a.state.bounds->longest(a.train); }

constexpr Rule<AskedTrain> kTimeRules[] = {
    {IntervalMayBeBelowTrain,
     [](auto& a) { return !(longestOf(a).duration() <= shortestInterval(a) * (1 + kRounding)); },
     [](auto& a) {
         return invalid(
             "interval {:.6g} s may come out as {:.6g} s and the train of {:.6g} s as {:.6g} s, which is longer",
             a.interval.count(), shortestInterval(a).count(), a.train.duration().count(),
             longestOf(a).duration().count());
     }},
    {PulseBeyondPeriod, [](auto& a) { return !validate(densestOf(a)); },
     [](auto& a) {
         return invalid("a pulse of {:.6g} us may come out as {:.6g} us, which is longer than its period of {:.6g} us",
                        Micros(a.train.pulseDuration()).count(), Micros(densestOf(a).pulseDuration()).count(),
                        1e6 / densestOf(a).rate.value());
     }},
    {LongWithoutDeadMan,
     [](auto& a) {
         return !(a.state.setup->source.deadMan.count() > 0) &&
                !(longestOf(a).outputDuration() <= kLongestWithoutDeadMan);
     },
     [](auto& a) {
         return fail(ErrorCode::LimitExceeded,
                     "the train would last {:.4g} s; this stimulator has no dead-man switch that would end it if the "
                     "program failed, and at most {:.4g} s is accepted",
                     longestOf(a).outputDuration().count(), kLongestWithoutDeadMan.count());
     }},
    {PastUnknown, [](auto& a) { return a.state.record != nullptr && a.now < a.state.record->quietUntil(); },
     [](auto& a) {
         return fail(
             ErrorCode::LimitExceeded,
             "what this stimulator delivered last is not known: {}. It rests for another {:.1f} s; then try again",
             a.state.record->whyQuiet(), toSeconds(a.state.record->quietUntil() - a.now));
     }},
};

constexpr Rule<ExposureMeter> kMeterRules[] = {
    {MeterFull, [](auto& meter) { return !meter.canBook(); },
     [](auto& meter) {
         return fail(ErrorCode::LimitExceeded,
                     "{} trains were approved in the last seconds; the exposure meter holds no more", meter.size());
     }},
};
}  // namespace

Result<void> checkRequest(const PulseTrain& train, Seconds interval, const SourceTraits& source) {
    return judge(kFormRules, TrainForm{train, interval, source});
}

Result<void> checkAsked(const AskedTrain& asked) {
    auto kept = judge(kAskedRules, asked);
    return kept && asked.state.person() ? judge(kPersonTrainRules, asked) : kept;
}

Result<void> checkAskedCheck(const AskedTrain& asked) { return judge(kCheckRules, asked); }
Result<void> checkTimes(const AskedTrain& asked) { return judge(kTimeRules, asked); }
Result<void> checkMeter(const State& state) { return judge(kMeterRules, state.meter); }

}  // namespace tacto::gate
