#include "core/safety/SafetyGate.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/safety/GateState.h"
#include "core/safety/Rules.h"

namespace tacto {

using namespace gate;

namespace {
constexpr double kMaxStretch = 2;     // spare room: the next request may need a larger stretch
constexpr double kImpedanceJump = 2;  // skin drifts over minutes; a lifted electrode does this between two trains

// --- impedance ------------------------------------------------------------------------------------------------------

struct Reading {
    const State& state;
    double ohm;
    Instant at;
    Instant now;
    [[nodiscard]] double before() const noexcept { return state.lastGood->value(); }
};

constexpr Rule<Reading> kStampRules[] = {
    {ImpedanceFromFuture, [](auto& r) { return r.at > r.now; },
     [](auto& r) {
         return invalid("the impedance reading is stamped {:.3g} s ahead of now", toSeconds(r.at - r.now));
     }},
};

constexpr Rule<Reading> kReadingRules[] = {
    {ImpedanceValue, [](auto& r) { return !(r.ohm > 0); },
     [](auto& r) { return invalid("a measured impedance of {} ohm is not above 0", r.ohm); }},
    {ImpedanceOutOfRange,
     [](auto& r) {
         if (!r.state.person()) return !r.state.agreesWithDeclared(r.ohm);
         const PersonSetup& person = *r.state.setup->person;
         return !(r.ohm >= person.impedanceLow.value() && r.ohm <= person.impedanceHigh.value());
     },
     [](auto& r) {
         if (!r.state.person()) {
             return fail(
                 ErrorCode::LimitExceeded,
                 "the measured impedance is {:.4g} ohm; the declared load is {} and 20 % more or less is accepted",
                 r.ohm, r.state.setup->load.nominal.text());
         }
         const PersonSetup& person = *r.state.setup->person;
         return fail(ErrorCode::LimitExceeded, "the measured impedance is {:.4g} ohm; {:.4g} to {:.4g} ohm is accepted",
                     r.ohm, person.impedanceLow.value(), person.impedanceHigh.value());
     }},
    {ImpedanceJump,
     [](auto& r) {
         return r.state.person() && r.state.lastGood &&
                !(r.ohm <= kImpedanceJump * r.before() && r.before() <= kImpedanceJump * r.ohm);
     },
     [](auto& r) {
         return fail(ErrorCode::LimitExceeded,
                     "the impedance went from {:.4g} to {:.4g} ohm between two readings; an electrode has moved",
                     r.before(), r.ohm);
     }},
};

// --- a person's levels ----------------------------------------------------------------------------------------------

struct AcceptedTrain {
    const State& state;
    const PulseTrain& train;
};

constexpr Rule<AcceptedTrain> kAcceptRules[] = {
    {LevelOfPerson, [](auto& a) { return !a.state.person(); },
     [](auto&) { return fail(ErrorCode::NotArmed, "levels are accepted in person mode only"); }},
    {LevelMalformed, [](auto& a) { return !validate(a.train); }, [](auto& a) { return failure(validate(a.train)); }},
};

struct Discomfort {
    const State& state;
    double level;
};

constexpr Rule<Discomfort> kDiscomfortRules[] = {
    {DiscomfortOfPerson, [](auto& d) { return !d.state.person(); },
     [](auto&) { return fail(ErrorCode::NotArmed, "discomfort is reported in person mode only"); }},
    {DiscomfortValue, [](auto& d) { return !(std::isfinite(d.level) && d.level >= 0); },
     [](auto& d) { return invalid("a discomfort level of {} mA is not a finite current of 0 or more", d.level); }},
};

// --- vibrations, approvals, bookings --------------------------------------------------------------------------------

constexpr Rule<VibrationBurst> kBurstRules[] = {
    {BurstIntensity, [](auto& b) { return !(b.intensity >= 0 && b.intensity <= 1); },
     [](auto& b) { return invalid("vibration intensity {} is not between 0 and 1", b.intensity); }},
    {BurstDuration, [](auto& b) { return !(b.duration.count() > 0 && b.duration.count() <= 1); },
     [](auto& b) { return invalid("vibration of {} s is not above 0 and at most 1 s long", b.duration.count()); }},
};

constexpr Rule<State> kVibratedRules[] = {
    {BurstAtElectrodes, [](auto& s) { return s.person() && !s.vibrates(); },
     [](auto&) {
         return fail(ErrorCode::LimitExceeded,
                     "a vibration for a person at electrodes; a person at a massager is expected");
     }},
};

constexpr Rule<State> kIntensityOwnerRules[] = {
    {IntensityOfPerson, [](auto& s) { return !s.vibrates(); },
     [](auto&) { return fail(ErrorCode::NotArmed, "intensities are accepted by a person at a massager only"); }},
};

constexpr Rule<double> kAcceptedIntensityRules[] = {
    {IntensityMalformed, [](auto& x) { return !(x >= 0 && x <= 1); },
     [](auto& x) { return invalid("an accepted intensity of {}; 0 to 1 is expected", x); }},
};

constexpr Rule<double> kUncomfortableIntensityRules[] = {
    {IntensityDiscomfort, [](auto& x) { return !(x >= 0 && x <= 1); },
     [](auto& x) { return invalid("an uncomfortable intensity of {}; 0 to 1 is expected", x); }},
};

struct Approval {
    std::uint64_t epoch, current;
    Instant expires, now;
};

constexpr Condition<Approval> kApprovalConditions[] = {
    {Epoch, [](auto& a) noexcept { return a.epoch != a.current; }},
    {Expiry, [](auto& a) noexcept { return !(a.now <= a.expires); }},
};

struct Booking {
    State& state;
    const BookedTrain& train;
};

constexpr Duty<Booking> kBookings[] = {
    {MeterBooking, [](auto& b) noexcept { b.state.meter.book(b.train); }},
    {RecordBooking,
     [](auto& b) noexcept {
         if (b.state.record != nullptr) b.state.record->book(b.train, b.state.residuals);
     }},
};

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
    s.levels = &s.none;
    s.intensities = &s.noIntensities;
    if (setup.mode == OutputMode::Person && setup.person && setup.person->vibration) {
        const auto& vibration = *setup.person->vibration;
        const auto [known, isNew] = s.vibrated.try_emplace(setup.person->participant);
        s.intensities = &known->second;
        if (isNew)
            s.intensities->begin(vibration.discomfortLimit, vibration.rampStep);
        else
            s.intensities->resume(vibration.discomfortLimit, vibration.rampStep);
    } else if (setup.mode == OutputMode::Person && setup.person) {
        const PersonSetup& person = *setup.person;
        s.load = LoadRange::between(person.impedanceLow, person.impedanceHigh);
        const auto [known, isNew] = s.people.try_emplace(person.participant);
        s.levels = &known->second;
        if (isNew) {
            s.levels->begin(person.discomfortLimit, person.rampStep, person.cap);
        } else {
            s.levels->resume(person.discomfortLimit, person.rampStep, person.cap);
        }
    }
    s.setup = setup;
    return {};
}

Result<void> SafetyGate::updateImpedance(Ohms magnitude, Instant at) {
    State& s = *state_;
    // No rule: there is nothing to judge with.
    if (!s.setup) return fail(ErrorCode::NotArmed, "limits and load are not set");
    const Reading reading{s, magnitude.value(), at, clock_.now()};
    auto sound = judge(kStampRules, reading);
    if (sound && at < s.impedanceAt) return {};
    if (sound) sound = judge(kReadingRules, reading);
    if (!sound) {
        s.impedanceRejected = true;
        s.impedance.reset();
        latchStop();
        return sound;
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
    const std::uint64_t epoch = epoch_.load(std::memory_order_acquire);  // a stop after this line voids the result
    const State& s = *state_;
    const AskedTrain asked{s, request.train, request.interval, request.onset, clock_.now()};
    // No rule: there is nothing to judge with.
    if (!s.setup) return fail(ErrorCode::NotArmed, "limits, source and load are not set");
    if (auto sound = checkRequest(request.train, request.interval, s.setup->source); !sound) return failure(sound);
    if (auto kept = checkAsked(asked); !kept) return failure(kept);
    return grant(asked, epoch);
}

Result<ApprovedTrain> SafetyGate::approveCheck(Instant onset) {
    const std::uint64_t epoch = epoch_.load(std::memory_order_acquire);
    const State& s = *state_;
    const AskedTrain asked{s, s.check, checkInterval(s.check), onset, clock_.now()};
    // No rule: there is nothing to judge with.
    if (!s.setup) return fail(ErrorCode::NotArmed, "limits, source and load are not set");
    if (auto kept = checkAskedCheck(asked); !kept) return failure(kept);
    return grant(asked, epoch);
}

Result<ApprovedTrain> SafetyGate::grant(const AskedTrain& asked, std::uint64_t epoch) {
    State& s = *state_;
    const auto& [state, train, interval, onset, now] = asked;
    if (auto kept = checkTimes(asked); !kept) return failure(kept);
    const DeliveryBounds& bounds = *s.bounds;
    JudgedTrain judged;
    judged.interval = interval;
    judged.intervals = bounds.intervals(interval);
    judged.stretch = bounds.stretch(interval);
    s.meter.forget(now, std::max(judged.stretch, kMaxStretch));
    if (auto kept = checkMeter(s); !kept) return failure(kept);
    judged.carried_V = s.carriedAt(now);
    judged.command = bounds.commandOf(train);
    const auto& source = s.setup->source;
    judged.overRange = bounds.worst(train, s.load, [&](const auto& out) {
        return worstExposure(out, judged.intervals.least, s.load, source, s.area, {judged.carried_V});
    });
    judged.at500 = exposureOf(bounds.densest(train), judged.intervals.least, Load::resistor(Ohms(500)), source, s.area);
    const double command_V = commandVoltage(judged.command, s.load.nominal, source);
    for (TrainExposure* exposure : {&judged.overRange, &judged.at500})
        exposure->values[indexOf(Quantity::CommandVoltage)] = command_V;
    if (auto kept = checkLimits(s, judged, now); !kept) return failure(kept);

    const Instant expires = now + kApprovalLife;
    const Instant ended = expires + toInstant(bounds.longest(train).duration());
    const BookedTrain booked{now, ended, judged.hz(), judged.overRange, judged.at500};
    auto& residual = s.residuals[static_cast<std::size_t>(source.gap)];
    residual = {std::max(judged.carried_V, judged.overRange.residual_V), std::max(residual.at, ended)};
    Booking booking{s, booked};
    fulfil(kBookings, booking);
    s.lastTrain = train;
    return ApprovedTrain(train, interval, epoch, expires, judged.nearest);
}

Result<ApprovedBurst> SafetyGate::approve(const VibrationBurst& burst) {
    const std::uint64_t epoch = epoch_.load(std::memory_order_acquire);
    if (auto kept = judge(kBurstRules, burst); !kept) return failure(kept);
    const State& s = *state_;
    if (auto kept = judge(kVibratedRules, s); !kept) return failure(kept);
    if (s.vibrates()) {
        if (auto kept = s.intensities->permits(burst.intensity); !kept) return failure(kept);
    }
    return ApprovedBurst(burst, epoch, clock_.now() + kApprovalLife);
}

Result<void> SafetyGate::accept(const PulseTrain& train) {
    if (auto kept = judge(kAcceptRules, AcceptedTrain{*state_, train}); !kept) return kept;
    return state_->levels->accept(state_->bounds->acceptedAs(train));
}

Result<void> SafetyGate::reportDiscomfort(Milliamps level) {
    if (auto kept = judge(kDiscomfortRules, Discomfort{*state_, level.value()}); !kept) return kept;
    latchStop();
    state_->levels->reportDiscomfort(level);
    return {};
}

Result<void> SafetyGate::acceptIntensity(double intensity) {
    const State& s = *state_;
    if (auto kept = judge(kIntensityOwnerRules, s); !kept) return kept;
    if (auto kept = judge(kAcceptedIntensityRules, intensity); !kept) return kept;
    return s.intensities->accept(intensity);
}

Result<void> SafetyGate::reportUncomfortable(double intensity) {
    const State& s = *state_;
    if (auto kept = judge(kIntensityOwnerRules, s); !kept) return kept;
    if (auto kept = judge(kUncomfortableIntensityRules, intensity); !kept) return kept;
    latchStop();
    s.intensities->reportDiscomfort(intensity);
    return {};
}

std::optional<double> SafetyGate::intensityCeiling() const noexcept {
    if (!state_->vibrates()) return std::nullopt;
    return state_->intensities->ceiling();
}

void SafetyGate::beginAscending() noexcept {
    latchStop();
    state_->levels->beginAscending();
    state_->intensities->beginAscending();
}

void SafetyGate::endAscending() noexcept {
    state_->levels->endAscending();
    state_->intensities->endAscending();
}

std::optional<Milliamps> SafetyGate::levelCeiling(const PulseTrain& train) const noexcept {
    if (!state_->person()) return std::nullopt;
    return state_->levels->ceilingFor(train);
}

void SafetyGate::latchStop() noexcept { epoch_.fetch_add(1, std::memory_order_acq_rel); }

bool SafetyGate::isCurrent(std::uint64_t epoch, Instant expires) const noexcept {
    const Approval approval{epoch, epoch_.load(std::memory_order_acquire), expires, clock_.now()};
    return firstBroken(kApprovalConditions, approval) == nullptr;
}

SafetyGate::Amplitudes SafetyGate::amplitudes(double programmed) const noexcept {
    constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
    if (!state_->bounds) return {kUnknown, kUnknown};
    const auto range = state_->bounds->amplitudes(programmed);
    return {range.least, range.most};
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
