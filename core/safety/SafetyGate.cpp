#include "core/safety/SafetyGate.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/safety/GateChecks.h"
#include "core/safety/GateState.h"

namespace tacto {

using namespace gate;

namespace {
constexpr Instant kImpedanceAge = std::chrono::seconds(5);
constexpr double kMaxStretch = 2;     // the next request may need more than this one
constexpr double kImpedanceJump = 2;  // skin drifts over minutes; an electrode that lifts does this between two trains

std::uint64_t firstEpoch() noexcept {
    static std::atomic<std::uint64_t> gates{0};
    return (gates.fetch_add(1) + 1) << 40U;
}
}  // namespace

SafetyGate::SafetyGate(const Clock& clock) : clock_(clock), epoch_(firstEpoch()), state_(std::make_unique<State>()) {}
SafetyGate::~SafetyGate() = default;

void SafetyGate::continueFrom(UnitRecord& record) noexcept {
    state_->record = &record;
    state_->residuals = record.replay(state_->meter);
}

Result<void> SafetyGate::configure(const GateSetup& setup) {
    latchStop();
    State& s = *state_;
    s.setup.reset();
    if (auto sound = checkSetup(setup); !sound) return sound;
    s.bounds.emplace(setup);
    s.limits = activeLimits(setup);
    s.area = areaOf(setup);
    s.check = checkTrainOf(setup);
    s.lastTrain = s.check;
    s.load = setup.load;
    s.impedance.reset();
    s.lastGood.reset();
    s.impedanceAt = Instant(std::numeric_limits<Instant::rep>::min());
    s.impedanceRejected = false;
    if (setup.mode == OutputMode::Person && setup.person) {
        const PersonSetup& person = *setup.person;
        s.load = LoadRange::between(person.impedanceLow, person.impedanceHigh);
        const auto [known, isNew] = s.people.try_emplace(person.participant);
        s.levels = &known->second;
        if (isNew) {
            s.levels->begin(person.discomfortLimit, person.rampStep);
        } else {
            s.levels->resume(person.discomfortLimit, person.rampStep);
        }
    }
    s.setup = setup;
    return {};
}

Result<void> SafetyGate::updateImpedance(Ohms magnitude, Instant at) {
    State& s = *state_;
    // No check: there is nothing to judge with.
    if (!s.setup) return fail(ErrorCode::NotArmed, "the gate is not configured");
    const double ohm = magnitude.value();
    const auto refuse = [&](ErrorCode code, const std::string& message) -> Result<void> {
        s.impedanceRejected = true;
        s.impedance.reset();
        latchStop();
        return fail(code, "{}", message);
    };
    if (checks(ImpedanceFromFuture) && at > clock_.now()) {
        return refuse(ErrorCode::InvalidArgument, fmt::format("the impedance reading is stamped {:.3g} s ahead of now",
                                                              toSeconds(at - clock_.now())));
    }
    if (at < s.impedanceAt) return {};
    if (checks(ImpedanceValue) && !(ohm > 0)) {
        return refuse(ErrorCode::InvalidArgument, fmt::format("a measured impedance of {} ohm is not above 0", ohm));
    }
    double low = 0;
    double high = 0;
    bool inRange = false;
    if (s.person()) {
        low = s.setup->person->impedanceLow.value();
        high = s.setup->person->impedanceHigh.value();
        inRange = ohm >= low && ohm <= high;
    } else {
        inRange = s.agreesWithDeclared(ohm);
    }
    if (checks(ImpedanceOutOfRange) && !inRange) {
        return refuse(
            ErrorCode::LimitExceeded,
            s.person()
                ? fmt::format("the measured impedance is {:.4g} ohm; {:.4g} to {:.4g} ohm is accepted", ohm, low, high)
                : fmt::format(
                      "the measured impedance is {:.4g} ohm; the declared load is {} and 20 % more or less is accepted",
                      ohm, s.setup->load.nominal.text()));
    }
    if (checks(ImpedanceJump) && s.person() && s.lastGood) {
        const double before = s.lastGood->value();
        if (!(ohm <= kImpedanceJump * before && before <= kImpedanceJump * ohm)) {
            return refuse(
                ErrorCode::LimitExceeded,
                fmt::format("the impedance went from {:.4g} to {:.4g} ohm between two readings; an electrode has moved",
                            before, ohm));
        }
    }
    s.impedanceRejected = false;
    s.impedance = s.lastGood = magnitude;
    s.impedanceAt = at;
    if (s.person())
        s.load = LoadRange::measured(magnitude);
    else
        s.load.nominal = s.measuredLoad(magnitude);
    return {};
}

Result<ApprovedTrain> SafetyGate::approve(const TrainRequest& request) {
    const std::uint64_t epoch = epoch_.load(std::memory_order_acquire);  // A stop from here on voids the result
    const Instant now = clock_.now();
    State& s = *state_;
    // No check: there is nothing to judge with.
    if (!s.setup) return fail(ErrorCode::NotArmed, "the gate is not configured: no limits, source and load are known");
    if (auto sound = checkRequest(request.train, request.interval, s.setup->source); !sound) return failure(sound);
    if (checks(OnsetAhead) && request.onset > now + kApprovalLife) {
        return fail(ErrorCode::InvalidArgument, "the train is planned {:.3g} s ahead; an approval lasts 0.1 s",
                    toSeconds(request.onset - now));
    }
    if (checks(ImpedanceRejected) && s.impedanceRejected) {
        return fail(ErrorCode::LimitExceeded,
                    "the last impedance reading was out of range; a good one is needed first");
    }
    if (s.person()) {
        if (checks(PersonMonophasic) && request.train.shape == PulseShape::Monophasic) {
            return fail(ErrorCode::LimitExceeded, "monophasic pulses are refused for a person");
        }
        if (checks(PersonNoImpedance) && !s.impedance) {
            return fail(ErrorCode::LimitExceeded, "no impedance was measured; a person's is needed before a train");
        }
        if (checks(PersonStaleImpedance) && s.impedance && !(now - s.impedanceAt <= kImpedanceAge)) {
            return fail(ErrorCode::LimitExceeded, "the impedance was measured {:.3g} s ago; at most 5 s is accepted",
                        toSeconds(now - s.impedanceAt));
        }
        if (auto known = s.withinCalibration(request); !known) return failure(known);
        if (checks(PersonLevel)) {
            if (auto permitted = s.levels->permits(s.bounds->levelOf(request.train)); !permitted)
                return failure(permitted);
        }
    }
    return grant(request.train, request.interval, epoch, now);
}

Result<ApprovedTrain> SafetyGate::approveCheck(Instant onset) {
    const std::uint64_t epoch = epoch_.load(std::memory_order_acquire);
    const Instant now = clock_.now();
    State& s = *state_;
    // No check: there is nothing to judge with.
    if (!s.setup) return fail(ErrorCode::NotArmed, "the gate is not configured: no limits, source and load are known");
    if (checks(OnsetAhead) && onset > now + kApprovalLife) {
        return fail(ErrorCode::InvalidArgument, "the check is planned {:.3g} s ahead; an approval lasts 0.1 s",
                    toSeconds(onset - now));
    }
    const Seconds interval = std::max(kCheckInterval, s.check.duration());
    if (s.person() && checks(CheckDiscomfort)) {
        const double level = siValue(s.bounds->levelOf(s.check).amplitude) * 1e3;
        if (!(level <= s.levels->discomfortLimit().value())) {
            return fail(ErrorCode::LimitExceeded,
                        "the check pulse of {:.4g} mA is above this person's discomfort limit of {:.4g} mA", level,
                        s.levels->discomfortLimit().value());
        }
    }
    return grant(s.check, interval, epoch, now);
}

Result<ApprovedTrain> SafetyGate::grant(const PulseTrain& train, Seconds interval, std::uint64_t epoch, Instant now) {
    State& s = *state_;
    State::Judged request;
    const DeliveryBounds& bounds = *s.bounds;
    request.interval = interval;
    request.intervals = bounds.intervals(interval);
    if (checks(IntervalBelowTrain) && !(train.duration() <= request.intervals.least * (1 + kRounding))) {
        return fail(ErrorCode::InvalidArgument,
                    "interval {:.6g} s would come out as {:.6g} s, which is shorter than the train, {:.6g} s",
                    interval.count(), request.intervals.least.count(), train.duration().count());
    }
    const PulseTrain longest = bounds.largest(train);
    if (checks(PulseBeyondPeriod) && !validate(longest)) {
        return fail(ErrorCode::InvalidArgument,
                    "a pulse of {:.6g} us may come out as {:.6g} us, which is longer than its period of {:.6g} us",
                    Micros(train.pulseDuration()).count(), Micros(longest.pulseDuration()).count(),
                    1e6 / train.rate.value());
    }
    const Seconds lasts = longest.outputDuration();
    if (checks(LongWithoutDeadMan) && !(s.setup->source.deadMan.count() > 0) && !(lasts <= kLongestWithoutDeadMan)) {
        return fail(ErrorCode::LimitExceeded,
                    "the train would last {:.4g} s; this stimulator has no dead-man switch that would end it if the "
                    "program failed, and at most {:.4g} s is accepted",
                    lasts.count(), kLongestWithoutDeadMan.count());
    }
    if (checks(PastUnknown) && s.record != nullptr && now < s.record->quietUntil()) {
        return fail(
            ErrorCode::LimitExceeded,
            "what this stimulator delivered last is not known: {}. It rests for another {:.1f} s; then try again",
            s.record->whyQuiet(), toSeconds(s.record->quietUntil() - now));
    }
    request.stretch = bounds.stretch(interval);
    s.meter.forget(now, std::max(request.stretch, kMaxStretch));
    if (checks(MeterFull) && !s.meter.canBook()) {
        return fail(ErrorCode::LimitExceeded, "{} trains were approved in the last seconds; the meter holds no more",
                    s.meter.size());
    }
    request.carried_V = s.carriedAt(now);
    request.command = bounds.commandOf(train);
    const auto& source = s.setup->source;
    request.overRange = bounds.worst(train, [&](const PulseTrain& out) {
        return worstExposure(out, request.intervals.least, s.load, source, s.area, {request.carried_V});
    });
    request.at500 = bounds.worst(train, [&](const PulseTrain& out) {
        return exposureOf(out, request.intervals.least, Load::resistor(Ohms(500)), source, s.area);
    });
    const double command_V = commandVoltage(request.command, s.load.nominal, source);
    for (TrainExposure* exposure : {&request.overRange, &request.at500})
        exposure->values[indexOf(Quantity::CommandVoltage)] = command_V;
    if (auto kept = s.judge(request); !kept) return failure(kept);
    if (auto kept = s.judgeMetered(request, now); !kept) return failure(kept);

    const Instant expires = now + kApprovalLife;
    const Instant ended = expires + toInstant(train.duration());
    const BookedTrain booked{now, ended, request.hz(), request.overRange, request.at500};
    if (checks(MeterBooking)) s.meter.book(booked);
    auto& residual = s.residuals[static_cast<std::size_t>(source.gap)];
    residual = {std::max(request.carried_V, request.overRange.residual_V), std::max(residual.at, ended)};
    if (s.record != nullptr && checks(RecordBooking)) s.record->book(booked, s.residuals);
    s.lastTrain = train;
    return ApprovedTrain(train, interval, epoch, expires);
}

Result<ApprovedBurst> SafetyGate::approve(const VibrationBurst& burst) {
    const std::uint64_t epoch = epoch_.load(std::memory_order_acquire);
    if (checks(BurstIntensity) && !(burst.intensity >= 0 && burst.intensity <= 1)) {
        return fail(ErrorCode::InvalidArgument, "vibration intensity {} is not between 0 and 1", burst.intensity);
    }
    const double seconds = burst.duration.count();
    if (checks(BurstDuration) && !(seconds > 0 && seconds <= 1)) {
        return fail(ErrorCode::InvalidArgument, "vibration of {} s is not above 0 and at most 1 s long", seconds);
    }
    return ApprovedBurst(burst, epoch, clock_.now() + kApprovalLife);
}

Result<void> SafetyGate::accept(const PulseTrain& train) {
    if (!state_->setup || (checks(LevelOfPerson) && !state_->person()))
        return fail(ErrorCode::NotArmed, "levels are accepted in person mode only");
    if (auto sound = validate(train); checks(LevelMalformed) && !sound) return sound;
    return state_->levels->accept(state_->bounds->acceptedAs(train));
}

Result<void> SafetyGate::reportDiscomfort(Milliamps level) {
    if (!state_->setup || (checks(LevelOfPerson) && !state_->person()))
        return fail(ErrorCode::NotArmed, "discomfort is reported in person mode only");
    if (checks(DiscomfortValue) && !(std::isfinite(level.value()) && level.value() >= 0)) {
        return fail(ErrorCode::InvalidArgument, "a discomfort level of {} mA is not a finite current of 0 or more",
                    level.value());
    }
    latchStop();
    state_->levels->reportDiscomfort(level);
    return {};
}

void SafetyGate::beginAscending() noexcept {
    latchStop();
    state_->levels->beginAscending();
}

void SafetyGate::endAscending() noexcept { state_->levels->endAscending(); }

std::optional<Milliamps> SafetyGate::levelCeiling(const PulseTrain& train) const noexcept {
    if (!state_->setup || !state_->person()) return std::nullopt;
    return state_->levels->ceilingFor(train);
}

std::optional<LoadRange> SafetyGate::loadRange() const {
    if (!state_->setup) return std::nullopt;
    return state_->load;
}

void SafetyGate::latchStop() noexcept { epoch_.fetch_add(1, std::memory_order_acq_rel); }

bool SafetyGate::isCurrent(const ApprovedTrain& approved) const noexcept {
    const bool sameEpoch = approved.epoch_ == epoch_.load(std::memory_order_acquire);
    const bool inTime = clock_.now() <= approved.expires_;
    return (sameEpoch || !checks(Epoch)) && (inTime || !checks(Expiry));
}

bool SafetyGate::isCurrent(const ApprovedBurst& approved) const noexcept {
    const bool sameEpoch = approved.epoch_ == epoch_.load(std::memory_order_acquire);
    const bool inTime = clock_.now() <= approved.expires_;
    return (sameEpoch || !checks(Epoch)) && (inTime || !checks(Expiry));
}

void SafetyGate::exposure(std::vector<ExposureRow>& rows) const {
    const State& s = *state_;
    rows.clear();
    const Instant now = clock_.now();
    const auto second = s.meter.booked(Seconds(1), now);
    const auto five = s.meter.booked(Seconds(5), now);
    for (const ActiveLimit& limit : s.limits) {
        const LimitRow& row = limit.row;
        const bool into500 = row.judged == JudgedAt::Ohm500;
        double value = 0;
        if (windowOf(row.quantity) > 0) {
            const auto& sums = windowOf(row.quantity) == 1 ? second : five;
            if (sums.trains > 0 && !row.holdsAt(sums.lowestHz)) continue;
            value = windowedValue(row.quantity, into500 ? sums.at500 : sums.overRange, s.area);
        } else {
            value = s.meter.largest(row.quantity, row.judged, now);
        }
        rows.push_back(rowOf(limit, value, !std::isnan(s.area), s.commandIsComputed()));
    }
    for (const auto quantity : kShown) {
        if (hasRow(rows, quantity)) continue;
        rows.push_back(shownRow(quantity, windowOf(quantity) == 1
                                              ? windowedValue(quantity, second.overRange, s.area)
                                              : s.meter.largest(quantity, JudgedAt::LoadRange, now)));
    }
}

}  // namespace tacto
