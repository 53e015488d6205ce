#include "tests/safety/GateSequences.h"

#include <deque>
#include <utility>

#include "core/safety/SafetyGate.h"
#include "core/safety/UnitRecord.h"
#include "tests/safety/SequenceReferee.h"
#include "tests/support/Limits.h"
#include "tests/support/Support.h"

namespace tacto::test {

namespace {

/// The computer's time, which follows the test's clock.
struct ComputerTime final : SystemTime {
    explicit ComputerTime(const Clock& ofTest) : clock(ofTest) {}
    [[nodiscard]] Instant sinceBoot() const noexcept override { return std::chrono::hours(1) + clock.now(); }
    [[nodiscard]] std::string boot() const override { return "boot"; }
    [[nodiscard]] std::chrono::sys_seconds wall() const noexcept override { return SystemTime::real().wall(); }
    const Clock& clock;
};

/// A stimulator with its record, and the program that drives the stimulator until the next program does.
class Unit {
public:
    explicit Unit(const Clock& clock) : clock_(clock), time_(clock) { reopen(); }
    /// Ends the program and starts another.
    void reopen() {
        gate_.reset();
        record_.reset();
        record_ = UnitRecord::open({folder_.path(), claims_.path()}, "a unit", clock_, time_).value();
        gate_ = std::make_unique<SafetyGate>(clock_);
        gate_->continueFrom(*record_);
    }
    [[nodiscard]] SafetyGate& gate() const noexcept { return *gate_; }

private:
    ScratchDir folder_;
    ScratchDir claims_;
    const Clock& clock_;
    ComputerTime time_;
    std::unique_ptr<UnitRecord> record_;
    std::unique_ptr<SafetyGate> gate_;
};

class Sequence : SequenceReferee {
public:
    Sequence(Unit& unit, VirtualClock& clock, Dice& dice, SequenceCount& total, bool traced)
        : SequenceReferee(clock, dice, total, traced), unit_(unit) {}

    void run() {
        clock_.advanceTo(clock_.now() + std::chrono::seconds(7));
        body_.forget();
        at500_.forget();
        at500_.fit({500, 0, 0});
        ++total_.sequences;
        if (dice_.chance(0.15)) pace_ = dice_.between(0.9, 1.1);
        configure();
        const int commands = 2 + dice_.pick(10);
        for (int k = 0; k < commands && total_.violation.empty(); ++k) command();
        total_.delivering += delivered_ > 0 ? 1 : 0;
        total_.close += close_ ? 1 : 0;
    }

private:
    [[nodiscard]] SafetyGate& gate() const noexcept { return unit_.gate(); }

    /// Checks that no approval given so far is still valid.
    void voidPending(const char* after) {
        for (const Pending& p : pending_) {
            if (gate().isCurrent(p.approval)) violation(fmt::format("an approval is current after {}", after));
        }
        if (dice_.chance(0.5)) pending_.clear();
    }

    void configure() {
        GateSetup setup;
        Allowed allowed;
        // A third of the setups relax all limits except one kind, so that this kind is met first.
        theme_ = dice_.chance(0.35) ? static_cast<Near>(dice_.pick(static_cast<int>(kKinds))) : Near::Count;
        allowed.person = theme_ == Near::Count ? dice_.chance(0.2) : theme_ == Near::Level;
        source_ = SourceTraits{};
        const bool current = allowed.person || (theme_ != Near::Rms500 && dice_.chance(0.5));
        source_.drive = current ? Drive::Current : Drive::Voltage;
        source_.gap = dice_.chance(0.5) ? GapState::HoldsZero : GapState::HighImpedance;
        source_.amplitudeStep = dice_.chance(0.5) ? 0 : dice_.chance(0.5) ? 0.1 : 0.01;
        source_.amplitudeMax = current ? 500 : 60;
        source_.compliance = Volts(current ? dice_.between(50, 150) : 60);
        source_.widthMax = Micros(theme_ == Near::Rms500 || dice_.chance(0.2) ? 400'000 : 4000);
        source_.widthMin = Micros(1);
        source_.deadMan = Seconds(dice_.chance(0.7) ? 2 : 0);
        setup.source = source_;
        setup.limits = limitSets();

        halving_ = 0;
        const bool capacitive = !allowed.person && theme_ != Near::Rms500 && dice_.chance(0.4);
        const double ohm = theme_ == Near::Rms500 ? dice_.decade(4000, 20'000) : dice_.decade(60, 20'000);
        Body nominal{ohm, 0, 0};
        Load load = Load::resistor(Ohms(ohm));
        if (capacitive) {
            nominal = {dice_.decade(80, 2000), dice_.decade(1000, 50'000), dice_.decade(5e-9, 2e-6)};
            load = Load::skin(Ohms(nominal.rs), Ohms(nominal.rp), Nanofarads(nominal.c * 1e9));
            // R_p falls with intensity; the referee cannot predict |Z| of such a load for a current source.
            if (!current && dice_.chance(0.25)) halving_ = dice_.decade(5, 100);
        }
        load.halvingVoltage = Volts(halving_);
        setup.load = LoadRange::declared(load);
        nominal_ = nominal;
        // The true load is in the range, often at one end; a bench load may drift within the range and lose contact.
        scale_ = dice_.chance(0.4) ? 0.8 : dice_.chance(0.5) ? 1.2 : dice_.between(0.8, 1.2);
        drifts_ = !allowed.person && dice_.chance(0.2) ? 0.05 : 0;
        loses_ = !capacitive && dice_.chance(0.1) ? 0.3 : 0;

        if (theme_ == Near::Power || allowed.person || (theme_ == Near::Count && dice_.chance(0.6))) {
            allowed.area = theme_ == Near::Power ? dice_.decade(0.001, 0.1) : dice_.decade(0.01, 10);
            setup.electrodeArea = SquareCentimetres(allowed.area);
        }
        const auto ceiling = [&](Near kind, Quantity q, double si, double perUnit, double& into) {
            if (theme_ == Near::Count ? !dice_.chance(0.15) : theme_ != kind) return;
            into = si;
            setup.ceilings.push_back({q, si * perUnit});
        };
        ceiling(Near::PeakCurrent, Quantity::PeakCurrent, dice_.decade(0.001, 0.3), 1e3, allowed.peakI);
        ceiling(Near::Charge, Quantity::PhaseCharge, dice_.decade(1e-7, 5e-5), 1e6, allowed.charge);
        ceiling(Near::NetCharge, Quantity::NetCharge, dice_.decade(1e-8, 1e-5), 1e6, allowed.net);
        ceiling(Near::Energy, Quantity::PulseEnergy, dice_.decade(1e-6, 1e-2), 1e3, allowed.energy);
        ceiling(Near::Rms1s, Quantity::RmsCurrent1s, dice_.decade(1e-4, 2e-2), 1e3, allowed.rms1);
        ceiling(Near::Dc, Quantity::DcCurrent, dice_.decade(1e-6, 1e-2), 1e3, allowed.dc);
        if (allowed.person) {
            setup.mode = OutputMode::Person;
            PersonSetup person;
            person.participant = "p" + std::to_string(total_.sequences);
            person.consentRecorded = true;
            allowed.discomfort = dice_.decade(0.5, 10) / 1e3;
            allowed.step = dice_.decade(0.1, 2) / 1e3;
            person.discomfortLimit = Milliamps(allowed.discomfort * 1e3);
            person.rampStep = Milliamps(allowed.step * 1e3);
            allowed.low = 500;
            allowed.high = 10'000;
            setup.person = person;
            accepted_ = seriesLast_ = 0;
            seriesOf_.reset();
        }
        known_ = {};
        if (dice_.chance(0.3)) known_.amplitude = {dice_.between(0.85, 1.15), dice_.between(-0.2, 0.2)};
        if (dice_.chance(0.15)) known_.width = {dice_.between(0.92, 1.08), dice_.between(-3, 3)};
        if (dice_.chance(0.15)) known_.gap = {dice_.between(0.92, 1.08), dice_.between(-3, 3)};
        const bool unsure = dice_.chance(0.4);
        const auto doubt = [&](double most) -> std::optional<Spread> {
            if (!unsure) return Spread{};
            if (dice_.chance(0.3)) return std::nullopt;  // unknown: 5 %
            return Spread{dice_.chance(0.4) ? 0 : dice_.between(0, 0.03),
                          dice_.chance(0.5) ? 0 : dice_.between(0, most)};
        };
        const auto ofAmplitude = doubt(0.2), ofWidth = doubt(2e-6), ofGap = doubt(2e-6), ofInterval = doubt(1e-4),
                   ofRate = doubt(1e-3);
        device_ = {truly(known_.amplitude, ofAmplitude, 1), truly(known_.width, ofWidth, 1e6),
                   truly(known_.gap, ofGap, 1e6), truly(known_.rate, ofRate, 1)};
        setup.source.accuracy = {ofAmplitude, ofWidth, ofGap, ofInterval, ofRate};
        // A calibration is known whenever the device is off by more than stated; sometimes it is out of date.
        if (allowed.person || !known_.none() || pace_ != 1) {
            const auto time = [](const Flaw& flaw, const std::optional<Spread>& spread) {
                return CalibrationLine{flaw.gain, flaw.offset * 1e-6, 50e-6, 0.5, spread};
            };
            const double paceKnown = pace_ / truly({1, 0}, ofInterval, 0).gain;
            setup.calibration = {{known_.amplitude.gain, known_.amplitude.offset, 5, 50, ofAmplitude},
                                 CalibrationLine{paceKnown, 0, 1e-4, 1000, ofInterval},
                                 time(known_.width, ofWidth),
                                 time(known_.gap, ofGap)};
        }
        setup.calibrated = setup.calibration && (allowed.person || dice_.chance(0.6));
        calibrated_ = setup.calibrated;
        const bool sound = !dice_.chance(0.03);
        if (!sound) spoil(setup);
        const auto done = gate().configure(setup);
        voidPending("configure()");
        configured_ = done.has_value();
        if (!sound && configured_) violation("a spoilt setup was accepted");
        allowed_ = allowed;
        note([&] {
            return fmt::format("configure {} {} area {} load {}x{} comp {}: {}", allowed.person ? "person" : "bench",
                               current ? "current" : "voltage", allowed.area, load.text(), scale_,
                               source_.compliance.value(), done ? "ok" : done.error().message);
        });
        body_.fit(nominal_.times(scale_));
        readAs_ = 1;
        last_ = PulseTrain{};  // the check pulse, which has this timing
        setUnit(last_);
        if (allowed.person && configured_) measure();
    }

    /// Returns a device's true errors, given the `known` errors and their uncertainty: often the largest possible.
    Flaw truly(const Flaw& known, const std::optional<Spread>& doubt, double perUnit) {
        const Spread spread = doubt.value_or(Spread{0.05, 0});
        const auto side = [&] { return dice_.chance(0.5) ? 1.0 : dice_.between(-1, 1); };
        const double off = 1 + side() * spread.relative;
        return {known.gain * off, known.offset * off + side() * spread.absolute * perUnit};
    }

    void spoil(GateSetup& setup) {
        switch (dice_.pick(7)) {
            case 0:
                setup.limits.clear();
                break;
            case 1:
                setup.ceilings.push_back({Quantity::CommandVoltage, dice_.chance(0.5) ? 41 : kNaN});
                break;
            case 2:
                setup.source.amplitudeMax = dice_.chance(0.5) ? kNaN : kInf;
                break;
            case 3:
                setup.electrodeArea = SquareCentimetres(dice_.chance(0.5) ? 0 : kNaN);
                break;
            case 4:
                setup.source.widthMax = Micros(-1);
                break;
            case 5:
                setup.calibration = {{dice_.chance(0.5) ? kNaN : 1.3, 0, 5, 50}, {}, {}, {}};
                setup.calibrated = true;
                break;
            default:
                setup.check.pulses = 0;
                break;
        }
    }

    void measure() {
        const double truth = nominal_.rs * scale_;
        const double reading = dice_.chance(0.1) ? (dice_.chance(0.5) ? kNaN : -5) : truth * dice_.between(0.8, 1.4);
        const bool good = reading >= allowed_.low && reading <= allowed_.high;
        const auto done = gate().updateImpedance(Ohms(reading), clock_.now());
        note([&] { return fmt::format("{:.6f} impedance {}: {}", now(), reading, done ? "ok" : "refused"); });
        if (done.has_value() != good) violation("an impedance reading was judged wrongly");
        measuredAt_ = good ? now() : -100;
        measured_ = reading;
        // The gate relies on 0.7 to 1.3 times the reading: a body outside this range is another hazard (H3).
        if (!(truth >= 0.7 * reading && truth <= 1.3 * reading)) measuredAt_ = -100;
        if (!good) voidPending("a bad impedance reading");
    }

    /// The load that a bench's device reads after the last train: the true value with some error.
    void measureLoad() {
        if (siValue(last_.amplitude) == 0) return;
        IndependentBody declared, real;
        declared.fit(nominal_);
        real.fit(nominal_.times(scale_));
        const double reading = real.magnitude(last_) * dice_.between(0.95, 1.05);
        const auto done = gate().updateImpedance(Ohms(reading), clock_.now());
        note([&] { return fmt::format("{:.6f} load read as {}: {}", now(), reading, done ? "ok" : "refused"); });
        if (done) readAs_ = reading / declared.magnitude(last_);
        if (!done) voidPending("a bad reading of the load");
    }

    /// Sends one small pulse, as needed for arming or after an old reading.
    void check() {
        // Skipped for a person without a valid |Z| reading.
        if (allowed_.person && measuredAt_ < 0) return;
        auto approved = gate().approveCheck(clock_.now());
        note([&] { return fmt::format("{:.6f} check: {}", now(), approved ? "ok" : approved.error().message); });
        if (!approved) return;
        if (!configured_) violation("a check was approved without a configuration");
        last_ = approved->train();
        pending_.push_back({std::move(*approved), now(), kCheckInterval.count(), readAs_, true});
        if (dice_.chance(0.9)) deliverPending();
    }

    /// A massager's vibration: refused for a person at electrodes, otherwise judged by its numbers; void after a stop
    /// like everything else.
    void burst() {
        const VibrationBurst wanted{dice_.chance(0.1) ? kNaN : dice_.between(-0.2, 1.2),
                                    Seconds(dice_.chance(0.1) ? kInf : dice_.between(-0.2, 1.2))};
        const bool atElectrodes = configured_ && allowed_.person;
        const bool sound = !atElectrodes && wanted.intensity >= 0 && wanted.intensity <= 1 &&
                           wanted.duration.count() > 0 && wanted.duration.count() <= 1;
        const auto approved = gate().approve(wanted);
        if (approved.has_value() != sound) violation("a vibration was judged wrongly");
        if (!approved) return;
        if (!gate().isCurrent(*approved)) violation("a vibration is void at once");
        if (!dice_.chance(0.3)) return;
        gate().latchStop();
        if (gate().isCurrent(*approved)) violation("a vibration is current after a stop");
        voidPending("a stop");
    }

    /// Ends the program, perhaps while the device holds approvals; another program takes over the unit.
    void reopen() {
        const auto before = std::move(pending_);
        pending_.clear();
        unit_.reopen();
        ascending_ = false;
        note([&] { return fmt::format("{:.6f} opened again", now()); });
        for (const Pending& p : before) {
            if (gate().isCurrent(p.approval)) violation("an approval is current in another program");
        }
        configure();
    }

    void ascend() {
        if (dice_.chance(0.7)) {
            gate().beginAscending();
            ascending_ = true;
            seriesLast_ = 0;
            note([&] { return std::string("ascending"); });
            voidPending("beginAscending()");
        } else {
            gate().endAscending();
            ascending_ = false;
            note([&] { return std::string("no longer ascending"); });
        }
    }

    void command() {
        if (dice_.chance(0.05)) return check();
        if (dice_.chance(0.02)) return burst();
        if (dice_.chance(0.004)) return reopen();
        if (allowed_.person && configured_ && dice_.chance(0.06)) return ascend();
        const double which = dice_.unit();
        if (which < 0.62) {
            approve();
        } else if (which < 0.72) {
            deliverPending();
        } else if (which < 0.80) {
            wait(dice_.chance(0.7) ? dice_.decade(1e-4, 0.3) : dice_.between(0, 6));
        } else if (which < 0.83) {
            gate().latchStop();
            note([&] { return std::string("stop"); });
            voidPending("a stop");
        } else if (which < 0.86) {
            configure();
        } else if (which < 0.94) {
            garbage();
        } else if (configured_ && !allowed_.person) {
            measureLoad();
        } else if (configured_) {
            if (dice_.chance(0.6)) {
                measure();
            } else {
                const double level = dice_.between(0, allowed_.discomfort * 1.2);
                if (gate().reportDiscomfort(Milliamps(level * 1e3))) {
                    allowed_.discomfort = std::min(allowed_.discomfort, level);
                    accepted_ = std::min(accepted_, allowed_.discomfort);
                    note([&] { return fmt::format("discomfort at {} A", level); });
                    voidPending("reported discomfort");
                }
            }
        }
    }

    void approve() {
        PulseTrain train = randomTrain();
        double interval = train.duration().count() * (dice_.chance(0.3) ? 1 : dice_.decade(1, 300));
        int repeats = dice_.chance(0.2) ? 2 + dice_.pick(12) : 1;
        const bool campaign = dice_.chance(theme_ == Near::Count ? 0.3 : 0.6);
        if (campaign) {
            const Near any = static_cast<Near>(dice_.pick(static_cast<int>(kKinds)));
            search(theme_ == Near::Count ? any : theme_, train, interval);
            repeats = static_cast<int>(std::min(14.0, std::ceil(5 / interval) + 1));
        }
        if (campaign && source_.amplitudeStep == 0 && dice_.chance(fills_ ? 0.6 : 0.05)) return edge(train, interval);
        const double shortest = train.duration().count();
        const double aim = aimed(train, interval);
        const double how = dice_.unit();
        const double factor = how < 0.35  ? dice_.between(0.96, 0.99999)
                              : how < 0.7 ? dice_.between(0.9, 1.1)
                                          : dice_.unit() * 2;
        setAmplitude(train, aim * factor);
        // Often faster than the promised interval, which the meter must notice.
        const double pace = campaign || dice_.chance(0.4) ? interval : std::max(shortest, interval * dice_.unit());
        for (int k = 0; k < repeats && total_.violation.empty(); ++k) {
            if (!ask(train, interval) && k + 1 < repeats && dice_.chance(0.7)) break;
            if (dice_.chance(0.9)) {
                if (dice_.chance(0.1)) wait(dice_.between(0, 0.12));
                deliverPending();
            }
            wait(pace);
        }
    }

    /// Delivers the largest amplitude that the gate approves, within 0.05 %, to find even small underestimates.
    void edge(PulseTrain train, double interval) {
        constexpr std::array kSteps{0.03, 0.004, 0.0005};
        double amplitude = 1.3 * aimed(train, interval);
        for (const double step : kSteps) {
            pending_.clear();
            wait(12);  // long enough that no window holds an earlier approval
            bool approved = false;
            for (int tries = 0; tries < 40 && !approved; ++tries) {
                amplitude *= 1 - step;
                setAmplitude(train, amplitude);
                approved = ask(train, interval);
            }
            if (!approved) return;
            if (step != kSteps.back()) amplitude /= 1 - step;
        }
        const int before = delivered_;
        deliverPending();
        if (delivered_ > before) ++total_.edges;
    }

    bool ask(const PulseTrain& train, double interval) {
        auto approved = gate().approve({train, Seconds(interval), clock_.now()});
        note([&] {
            return fmt::format("{:.6f} approve {} {} us gap {} shape {} pol {} n {} rate {} T {}: {}", now(),
                               siValue(train.amplitude), train.phaseWidth.count(), train.interPhaseGap.count(),
                               static_cast<int>(train.shape), static_cast<int>(train.polarity), train.pulses,
                               train.rate.value(), interval, approved ? "ok" : approved.error().message);
        });
        if (!approved) {
            ++total_.refused;
            return false;
        }
        if (!configured_) violation("approved without a configuration");
        last_ = approved->train();
        pending_.push_back({std::move(*approved), now(), interval, readAs_, false});
        return true;
    }

    /// Returns the load while `train` is delivered. R_p falls with the largest voltage of one pulse across R_p.
    [[nodiscard]] Body bodyUnder(PulseTrain train) const {
        Body body = nominal_.times(scale_);
        if (halving_ == 0) return body;
        IndependentBody probe;
        probe.fit(body);
        train.pulses = 1;
        probe.deliver(train, {source_.gap == GapState::HighImpedance}, 0);
        body.rp /= 1 + std::sqrt(2 * probe.mostStored() / body.c) / halving_;
        return body;
    }

    /// Acts as the device's thread: asks the gate, then delivers.
    void deliverPending() {
        if (pending_.empty()) return;
        Pending next = std::move(pending_.front());
        pending_.pop_front();
        // A device still busy with its last train waits for that train's end.
        if (now() < busyUntil_) clock_.advanceTo(toInstant(busyUntil_) + Instant(1));
        if (!gate().isCurrent(next.approval)) return;
        if (now() > next.granted + 0.1 + 1e-9) violation("an approval older than 100 ms is still current");
        if (dice_.chance(loses_)) return note([&] { return std::string("no contact"); });
        if (drifts_ > 0) scale_ = std::clamp(scale_ + dice_.between(-drifts_, drifts_), 0.8, 1.2);
        const PulseTrain train = device_.outOf(next.approval.train());
        if (drifts_ > 0 || halving_ > 0) body_.fit(bodyUnder(train));
        const double start = now() * pace_;
        ++total_.trains;
        ++delivered_;
        const Drain drain{source_.gap == GapState::HighImpedance,
                          source_.drive == Drive::Current ? source_.compliance.value() : 1e9};
        const PulseFacts facts = body_.deliver(train, drain, start);
        at500_.deliver(train, drain, start);
        busyUntil_ = now() + train.duration().count() / pace_;
        note([&] { return fmt::format("{:.6f} delivered, peak {} A", start, facts.peakI); });
        const double readSince = std::exchange(readAs_, next.readAs);
        referee(train, facts, next.interval * pace_, next.approval.train(), known_.outOf(next.approval.train()),
                next.isCheck);
        readAs_ = readSince;
        if (allowed_.person && dice_.chance(0.7) && gate().accept(next.approval.train())) {
            if (!sameKind(train)) accepted_ = 0;
            seriesOf_ = train;
            seriesLast_ = siValue(known_.outOf(next.approval.train()).amplitude);
            accepted_ = std::max(accepted_, siValue(known_.outOf(next.approval.train()).amplitude));
        }
    }

    /// Expects that a request with one fault is refused, whatever the rest of it.
    void garbage() {
        PulseTrain train = randomTrain();
        setAmplitude(train, aimed(train, train.duration().count() * 4) * 0.5);
        double interval = train.duration().count() * 4;
        const auto size = [&](double own) {
            train.amplitude = source_.drive == Drive::Current ? Amplitude(Milliamps(own)) : Amplitude(Volts(own));
        };
        const double wrong = std::array<double, 4>{kNaN, kInf, -kInf, -1}[static_cast<std::size_t>(dice_.pick(4))];
        switch (dice_.pick(12)) {
            case 0:
                size(wrong);
                break;
            case 1:
                size(1e300);
                break;
            case 2:
                train.phaseWidth = Micros(dice_.chance(0.2) ? 0.0 : wrong);
                break;
            case 3:
                train.shape = PulseShape::SymmetricBiphasic;
                train.interPhaseGap = Micros(wrong);
                break;
            case 4:
                train.rate = Hertz(dice_.chance(0.2) ? 0.0 : wrong);
                break;
            case 5:
                train.pulses =
                    std::array<int, 3>{0, -7, std::numeric_limits<int>::min()}[static_cast<std::size_t>(dice_.pick(3))];
                break;
            case 6:
                train.shape = PulseShape::AsymmetricBiphasic;
                train.rechargeRatio = wrong;
                break;
            case 7:
                interval = dice_.chance(0.2) ? 0.0 : wrong == kInf ? kNaN : wrong;
                break;
            case 8:
                interval = train.duration().count() * 0.9;
                break;
            case 9:
                train.amplitude = source_.drive == Drive::Current ? Amplitude(Volts(1)) : Amplitude(Milliamps(1));
                break;
            case 10:
                train.pulses = std::numeric_limits<int>::max();
                break;
            default:
                train.shape = static_cast<PulseShape>(17);
                break;
        }
        const auto approved = gate().approve({train, Seconds(interval), clock_.now()});
        if (approved) violation("garbage was approved");
    }

    struct Pending {
        ApprovedTrain approval;
        double granted;
        double interval;
        double readAs;  // readAs_ at the time of approval
        bool isCheck;
    };

    Unit& unit_;
    double drifts_ = 0;   // how far the load may change from train to train
    double loses_ = 0;    // probability that a train finds no contact
    double halving_ = 0;  // voltage at which the load's R_p has fallen to half; 0: R_p is constant
    double pace_ = 1;     // true time divided by the computer's time
    double scale_ = 1;    // true load divided by the nominal load
    bool configured_ = false;
    PulseTrain last_;  // the last train approved
    std::deque<Pending> pending_;
    double busyUntil_ = 0;
    int delivered_ = 0;
};
}  // namespace

namespace {
/// Runs sequences up to the first violation; with `traced` the message includes the last trains.
std::uint64_t run(std::uint64_t seed, std::uint64_t count, bool traced, SequenceCount& total) {
    VirtualClock clock;
    Unit unit(clock);
    Dice dice(seed);
    std::uint64_t done = 0;
    while (done < count && total.violation.empty()) {
        ++done;
        Sequence(unit, clock, dice, total, traced && done == count).run();
    }
    return done;
}
}  // namespace

void runSequences(std::uint64_t seed, std::uint64_t count, SequenceCount& total) {
    const auto done = run(seed, count, false, total);
    if (total.violation.empty()) return;
    // Tracing every sequence would take longer than the sequences themselves.
    SequenceCount again;
    run(seed, done, true, again);
    total.violation =
        fmt::format("{} (seed {}, sequence {})",
                    again.violation.empty() ? total.violation + ", but not again" : again.violation, seed, done - 1);
}

}  // namespace tacto::test
