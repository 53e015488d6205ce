#include "tests/safety/GateCases.h"

#include <cmath>
#include <filesystem>

#include "core/base/Statistics.h"
#include "core/safety/Rules.h"
#include "core/safety/TrainExposure.h"
#include "core/safety/UnitRecord.h"
#include "tests/safety/GateFixtures.h"

namespace tacto::test {

using namespace gate;

namespace {

/// Setups that configure() must refuse, each for one reason.
void addConfigureCases(std::vector<GateCase>& cases) {
    const auto add = [&cases](Check check, GateSetup setup, std::string words) {
        cases.push_back({check, "configure: " + words,
                         [setup, words] { return refuses(Rig(setup).configured, ErrorCode::InvalidArgument, words); }});
    };
    const auto bench = [](auto spoil) {
        GateSetup setup = benchSetup();
        spoil(setup);
        return setup;
    };
    const auto person = [](auto spoil) {
        GateSetup setup = personSetup();
        spoil(setup);
        return setup;
    };
    add(NoLimitSet, bench([](auto& s) { s.limits.clear(); }), "no limit set");
    add(NoLimitSet,
        bench([](auto& s) { s.limits = {limitsOf({rowFor(Quantity::PeakVoltage, 9, LimitAction::Warn)})}; }),
        "no limit set");
    add(BadLimitRow, bench([](auto& s) { s.limits.push_back(limitsOf({rowFor(Quantity::PeakVoltage, kNaN)})); }),
        "has a row");
    add(BadCeiling, bench([](auto& s) { s.ceilings = {{Quantity::PeakCurrent, kNaN}}; }), "ceiling is");
    add(LoosenedCeiling, bench([](auto& s) { s.ceilings = {{Quantity::PeakVoltage, 1.1e6}}; }), "only tighten");
    add(TooManyLimits,
        bench([](auto& s) { s.limits.push_back(limitsOf(std::vector(61, rowFor(Quantity::PeakVoltage, 1e6)))); }),
        "can be watched at once");
    add(SourceAmplitudeMax, bench([](auto& s) { s.source.amplitudeMax = kNaN; }), "largest amplitude");
    add(SourceAmplitudeStep, bench([](auto& s) { s.source.amplitudeStep = -0.1; }), "amplitude step");
    for (Micros SourceTraits::*width : {&SourceTraits::widthStep, &SourceTraits::widthMin, &SourceTraits::widthMax})
        add(SourceWidths, bench([width](auto& s) { s.source.*width = Micros(kNaN); }), "pulse widths are");
    add(SourcePulses, bench([](auto& s) { s.source.pulsesMax = 0; }), "0 pulses a train");
    add(SourceCompliance, bench([](auto& s) { s.source.compliance = Volts(-1); }), "compliance of -1 V");
    add(SourceCurrentLimit, bench([](auto& s) { s.source.currentLimit = Milliamps(kNaN); }), "current limit of nan");
    add(SourceDrive, bench([](auto& s) { s.source.drive = Drive::HighImpedance; }), "neither voltage nor current");
    add(SourceNoCompliance, bench([](auto& s) {
            s.source = currentSource();
            s.source.compliance = Volts(0);
        }),
        "no compliance");
    for (const Spread wrong : {Spread{1, 0}, Spread{-0.1, 0}, Spread{kNaN, 0}, Spread{0, -1}, Spread{0, kNaN}}) {
        add(SourceAccuracy, bench([wrong](auto& s) { s.source.accuracy.gap = wrong; }), "states an accuracy");
        add(SourceAccuracy, bench([wrong](auto& s) { s.source.accuracy.rate = wrong; }), "states an accuracy");
        add(BadCalibration, bench([wrong](auto& s) {
                s.calibration = StimulatorCalibration{CalibrationLine{1, 0, 10, 40, wrong}};
            }),
            "has an uncertainty");
    }
    add(BadLoad, bench([](auto& s) { s.load = LoadRange::declared(Load::openCircuit()); }), "cannot be judged");
    add(BadLoad, bench([](auto& s) { s.load.max.series = Ohms(kNaN); }), "cannot be judged");
    add(BadArea, bench([](auto& s) { s.electrodeArea = SquareCentimetres(0); }), "electrode area is");
    add(BadCheckTrain, bench([](auto& s) { s.check.pulses = 0; }), "impedance check");
    add(PersonMissing, person([](auto& s) { s.person.reset(); }), "needs a person's consent");
    add(PersonConsent, person([](auto& s) { s.person->consentRecorded = false; }), "recorded consent");
    add(PersonPseudonym, person([](auto& s) { s.person->participant.clear(); }), "pseudonym");
    add(PersonArea, person([](auto& s) { s.electrodeArea.reset(); }), "electrode area");
    add(PersonCalibration, person([](auto& s) { s.calibration.reset(); }), "not calibrated");
    add(PersonCalibration, person([](auto& s) { s.calibrated = false; }), "not calibrated");
    add(PersonCalibration, person([](auto& s) { s.calibration->interval.reset(); }), "interval, phase width and gap");
    add(PersonCalibration, person([](auto& s) { s.calibration->phaseWidth.reset(); }), "not calibrated");
    add(PersonCalibration, person([](auto& s) { s.calibration->gap.reset(); }), "not calibrated");
    add(BadCalibration, bench([](auto& s) {
            s.calibration = StimulatorCalibration{{1.21, 0, 10, 40}};
            s.calibrated = true;
        }),
        "out of order");
    add(BadCalibration, bench([](auto& s) { s.calibration = StimulatorCalibration{{1, kNaN, 10, 40}}; }), "offset");
    // The calibration is not applied, so it may be far off; but an interval of length zero would empty the meter.
    add(BadCalibration, bench([](auto& s) {
            s.calibration = StimulatorCalibration{{1, 0, 10, 40}, CalibrationLine{1, -0.6, 0.5, 10}};
        }),
        "a hundredth");
    add(PersonDiscomfort, person([](auto& s) { s.person->discomfortLimit = Milliamps(0); }), "discomfort limit");
    add(PersonRampStep, person([](auto& s) { s.person->rampStep = Milliamps(kNaN); }), "ramp step");
    add(PersonCap, person([](auto& s) { s.person->cap = Milliamps(0); }), "the study's cap is 0 mA");
    add(PersonCap, person([](auto& s) { s.person->cap = Milliamps(kNaN); }), "the study's cap");
    add(PersonImpedanceBounds, person([](auto& s) { s.person->impedanceLow = Ohms(20'000); }), "impedance range");
    add(PersonVoltageSource, person([](auto& s) { s.source = voltageSource(); }), "voltage source is refused");
    const auto vibrated = [](auto spoil) {
        GateSetup setup = vibrationSetup();
        spoil(*setup.person->vibration);
        return setup;
    };
    for (const double wrong : {0.0, -0.1, 1.1, kNaN}) {
        add(PersonVibrationLimit, vibrated([wrong](auto& v) { v.discomfortLimit = wrong; }), "discomfort limit is");
        add(PersonVibrationStep, vibrated([wrong](auto& v) { v.rampStep = wrong; }), "ramp step is");
    }
    add(PersonMonophasicCheck, person([](auto& s) { s.check.shape = PulseShape::Monophasic; }), "monophasic check");
}

/// Requests that approve() must refuse for their form, each compared with the same request without the fault.
void addRequestCases(std::vector<GateCase>& cases) {
    const auto add = [&cases](Check check, auto spoilSource, auto spoil, std::string words) {
        cases.push_back({check, "approve: " + words, [spoilSource, spoil, words] {
                             GateSetup setup = benchSetup();
                             spoilSource(setup.source);
                             Rig rig(setup);
                             TrainRequest request{volts(10), Seconds(2), rig.clock.now()};
                             const bool fine = rig.gate.approve(request).has_value();
                             spoil(request);
                             return fine && refuses(rig.gate.approve(request), ErrorCode::InvalidArgument, words);
                         }});
    };
    const auto plain = [](SourceTraits&) {};
    add(
        MalformedTrain, plain, [](auto& r) { r.train.amplitude = Volts(kNaN); }, "amplitude nan V");
    add(
        MalformedTrain, plain, [](auto& r) { r.train.interPhaseGap = Micros(-50); }, "gap -50");
    add(
        SourceKind, plain, [](auto& r) { r.train.amplitude = Milliamps(1); }, "of a voltage source");
    add(
        AmplitudeMax, plain, [](auto& r) { r.train.amplitude = Volts(60.1); }, "above the device's largest");
    add(
        AmplitudeGrid, [](auto& s) { s.amplitudeStep = 0.1; }, [](auto& r) { r.train.amplitude = Volts(10.05); },
        "device's step");
    add(
        WidthRange, plain, [](auto& r) { r.train.phaseWidth = Micros(4001); }, "outside the device's");
    add(
        WidthRange, plain, [](auto& r) { r.train.phaseWidth = Micros(9); }, "outside the device's");
    add(
        WidthGrid, plain, [](auto& r) { r.train.phaseWidth = Micros(200.5); }, "phase width 200.5");
    add(
        GapGrid, plain, [](auto& r) { r.train.interPhaseGap = Micros(100.5); }, "gap 100.5");
    add(
        PulsesMax, [](auto& s) { s.pulsesMax = 3; }, [](auto& r) { r.train.pulses = 4; }, "more than the device's");
    add(
        IntervalValue, plain, [](auto& r) { r.interval = Seconds(kNaN); }, "not a finite time");
    add(
        IntervalBelowTrain, plain, [](auto& r) { r.interval = Seconds(0.009); }, "interval 0.009 s is shorter");
    add(
        OnsetAhead, plain, [](auto& r) { r.onset += std::chrono::milliseconds(101); }, "planned");
    cases.push_back({CheckOnsetAhead, "a check pulse planned ahead", [] {
                         Rig rig(benchSetup());
                         return rig.gate.approveCheck(rig.clock.now()).has_value() &&
                                refuses(rig.gate.approveCheck(std::chrono::seconds(1)), ErrorCode::InvalidArgument,
                                        "planned");
                     }});
}

void addStateCases(std::vector<GateCase>& cases) {
    const auto add = [&cases](Check check, std::string name, std::function<bool()> holds) {
        cases.push_back({check, std::move(name), std::move(holds)});
    };
    add(ImpedanceValue, "an impedance that is not a number", [] {
        Rig rig(personSetup());
        return refuses(rig.gate.updateImpedance(Ohms(kNaN), rig.clock.now()), ErrorCode::InvalidArgument,
                       "not above 0");
    });
    add(ImpedanceFromFuture, "an impedance from the future", [] {
        Rig rig(personSetup());
        return refuses(rig.gate.updateImpedance(Ohms(1000), std::chrono::seconds(1)), ErrorCode::InvalidArgument,
                       "ahead of now");
    });
    add(ImpedanceOutOfRange, "a person's impedance out of range", [] {
        Rig rig(personSetup());
        return refuses(rig.gate.updateImpedance(Ohms(499), rig.clock.now()), ErrorCode::LimitExceeded, "500 to 1e+04");
    });
    add(ImpedanceJump, "a person's impedance that doubles between two trains", [] {
        const auto after = [](double ohm, double wait_s) {
            Rig rig(personSetup());
            (void)rig.gate.updateImpedance(Ohms(2000), rig.clock.now());
            rig.wait(wait_s);
            return rig.gate.updateImpedance(Ohms(ohm), rig.clock.now());
        };
        return refuses(after(4001, 2), ErrorCode::LimitExceeded, "an electrode has moved") &&
               refuses(after(999, 2), ErrorCode::LimitExceeded, "an electrode has moved") &&
               refuses(after(6000, 60), ErrorCode::LimitExceeded, "an electrode has moved") &&
               after(4000, 2).has_value() && after(1000, 2).has_value();
    });
    add(ImpedanceJump, "the same reading again after a jump", [] {
        Rig rig(personSetup());
        for (const double ohm : {2000, 9000}) (void)rig.gate.updateImpedance(Ohms(ohm), rig.clock.now());
        return refuses(rig.gate.updateImpedance(Ohms(9000), rig.clock.now()), ErrorCode::LimitExceeded, "has moved");
    });
    add(ImpedanceOutOfRange, "a bench load that is not the declared one", [] {
        Rig rig(benchSetup());
        return rig.gate.updateImpedance(Ohms(1190), rig.clock.now()).has_value() &&
               refuses(rig.gate.updateImpedance(Ohms(100), rig.clock.now()), ErrorCode::LimitExceeded, "declared load");
    });
    add(ImpedanceRejected, "a train after a bad reading", [] {
        Rig rig(benchSetup());
        (void)rig.gate.updateImpedance(Ohms(100), rig.clock.now());
        const bool refused = refuses(rig.ask(volts(10)), ErrorCode::LimitExceeded, "out of range");
        const bool checked = rig.gate.approveCheck(rig.clock.now()).has_value();
        return refused && checked && rig.gate.updateImpedance(Ohms(1000), rig.clock.now()) && rig.ask(volts(10));
    });
    add(MoreThanProgrammed, "a stimulator that delivers more than it is programmed to", [] {
        GateSetup setup = benchSetup();
        setup.limits = {limitsOf({rowFor(Quantity::PeakVoltage, 11)})};
        const bool fine = Rig(setup).ask(volts(10)).has_value();
        setup.calibration = StimulatorCalibration{exactLine(1.15, 0, 5, 40)};
        return fine && refuses(Rig(setup).ask(volts(10)), ErrorCode::LimitExceeded, "11.5");
    });
    // 40 V into 1 kohm, 0.4 ms every 0.5 s: 1.13 mA RMS.
    const auto refusedOnly = [](Quantity quantity, double limit, KnownLines known, const std::string& value) {
        GateSetup setup = benchSetup();
        setup.load = LoadRange::around(Load::resistor(Ohms(1000)), 1, 1);
        setup.limits = {limitsOf({rowFor(quantity, limit)})};
        PulseTrain train = volts(40);
        train.rate = Hertz(1000);
        const bool fine = Rig(setup).ask(train, 0.5).has_value();
        setup.calibration = std::move(known);
        return fine && refuses(Rig(setup).ask(train, 0.5), ErrorCode::LimitExceeded, value);
    };
    const CalibrationLine known = exactLine(1, 0, 10, 50);
    const auto times = [](double gain, double offset_us) { return exactLine(gain, offset_us * 1e-6, 50e-6, 1e-3); };
    add(MoreThanProgrammed, "a phase that comes out longer than programmed", [=] {
        return refusedOnly(Quantity::PhaseCharge, 8.5, StimulatorCalibration{known, {}, times(1.05, 5), {}}, "8.6");
    });
    add(MoreThanProgrammed, "a gap that comes out shorter than programmed", [=] {
        // With a gap of 100 us, the capacitor would be empty before the second phase.
        GateSetup setup = benchSetup(Load::skin(Ohms(500), Ohms(20'000), Nanofarads(50)));
        setup.limits = {limitsOf({rowFor(Quantity::PeakCurrent, 102.5)})};
        PulseTrain train = volts(40);
        train.rate = Hertz(1000);
        const bool fine = Rig(setup).ask(train, 0.5).has_value();
        setup.calibration = StimulatorCalibration{known, {}, {}, times(1, -20)};
        return fine && refuses(Rig(setup).ask(train, 0.5), ErrorCode::LimitExceeded, "peak current");
    });
    add(MoreThanProgrammed, "trains that come out sooner than programmed", [=] {
        const CalibrationLine sooner = exactLine(0.9, 0, 0.1, 10);
        return refusedOnly(Quantity::RmsCurrent5s, 1.15, StimulatorCalibration{known, sooner, {}, {}}, "1.239");
    });
    add(IntervalMayBeBelowTrain, "an interval that comes out shorter than its train", [=] {
        GateSetup setup = benchSetup();
        PulseTrain train = volts(10);
        train.pulses = 50;  // 0.5 s at 100 Hz
        const bool fine = Rig(setup).ask(train, 0.5).has_value();
        setup.calibration = StimulatorCalibration{known, exactLine(0.99, 0, 0.1, 10), {}, {}};
        return fine && refuses(Rig(setup).ask(train, 0.5), ErrorCode::InvalidArgument, "come out as 0.495 s");
    });
    add(IntervalMayBeBelowTrain, "a train that comes out longer than its interval", [=] {
        GateSetup setup = benchSetup();
        PulseTrain train = volts(10);
        train.pulses = 48;  // 0.48 s at 100 Hz
        const bool fine = Rig(setup).ask(train, 0.5).has_value();
        setup.source.accuracy.rate = Spread{0.05, 0};
        return fine && refuses(Rig(setup).ask(train, 0.5), ErrorCode::InvalidArgument, "of 0.48 s as 0.505263 s");
    });
    // Only one quantity's spread makes the difference, whether from an applied calibration, an old one or the source.
    for (const auto part : {0, 1, 2, 3}) {
        static constexpr std::array kNames{"amplitude", "phase width", "gap", "interval"};
        const auto spoilt = [part](auto spread) {
            std::array<Spread, 4> all{};
            all[static_cast<std::size_t>(part)] = spread;
            return all;
        };
        const auto refusedWith = [](const auto& spoil) {
            GateSetup setup = benchSetup(Load::skin(Ohms(500), Ohms(20'000), Nanofarads(50)));
            setup.source.amplitudeMax = 100;
            PulseTrain train = volts(40);
            train.rate = Hertz(1000);
            const auto exact = worstExposure(train, Seconds(0.5), setup.load, setup.source, kNaN);
            setup.limits.clear();
            for (const auto q : {Quantity::RmsCurrent5s, Quantity::PeakCurrent, Quantity::PhaseCharge})
                setup.limits.push_back(limitsOf({rowFor(q, exact.at(q) * 1.001)}));
            const bool fine = Rig(setup).ask(train, 0.5).has_value();
            spoil(setup);
            const auto asked = Rig(setup).ask(train, 0.5);
            return fine && !asked && asked.error().code == ErrorCode::LimitExceeded;
        };
        add(Uncertainty, std::string("a stated inaccuracy of the ") + kNames[static_cast<std::size_t>(part)], [=] {
            return refusedWith([&](GateSetup& setup) {
                const auto all = spoilt(Spread{0.05, 0});
                setup.source.accuracy = {all[0], all[1], all[2], all[3], Spread{}};
            });
        });
        for (const bool applied : {true, false}) {
            add(Uncertainty,
                std::string("a calibration's uncertainty of the ") + kNames[static_cast<std::size_t>(part)], [=] {
                    return refusedWith([&](GateSetup& setup) {
                        const auto all = spoilt(Spread{0, part == 0 ? 2 : part == 3 ? 0.02 : 10e-6});
                        setup.calibration = StimulatorCalibration{
                            CalibrationLine{1, 0, 10, 50, all[0]}, CalibrationLine{1, 0, 0.1, 10, all[3]},
                            CalibrationLine{1, 0, 50e-6, 1e-3, all[1]}, CalibrationLine{1, 0, 50e-6, 1e-3, all[2]}};
                        setup.calibrated = applied;
                    });
                });
        }
    }
    add(Uncertainty, "a stated inaccuracy of the rate", [=] {
        GateSetup setup = benchSetup();
        PulseTrain train = volts(10);
        train.pulses = 120;  // at 100 Hz longer than a second, which holds more pulses if the clock is fast
        const auto exact = worstExposure(train, Seconds(2), setup.load, setup.source, kNaN);
        setup.limits = {limitsOf({rowFor(Quantity::RmsCurrent1s, exact.at(Quantity::RmsCurrent1s) * 1.01)})};
        const bool fine = Rig(setup).ask(train, 2).has_value();
        setup.source.accuracy.rate = Spread{0.03, 0};
        return fine && refuses(Rig(setup).ask(train, 2), ErrorCode::LimitExceeded, "1 s");
    });
    add(Uncertainty, "a source that states no accuracy, and a calibration that states no uncertainty", [=] {
        const auto refused = [](auto spoil) {
            GateSetup setup = benchSetup();
            setup.limits = {limitsOf({rowFor(Quantity::PeakVoltage, 41.9)})};
            const bool fine = Rig(setup).ask(volts(40)).has_value();
            spoil(setup);
            return fine && refuses(Rig(setup).ask(volts(40)), ErrorCode::LimitExceeded, "would be 42 V");
        };
        return refused([](GateSetup& setup) { setup.source.accuracy = {}; }) && refused([](GateSetup& setup) {
                   setup.calibration = StimulatorCalibration{{1, 0, 10, 50}};
                   setup.calibrated = true;
               });
    });
    add(LongWithoutDeadMan, "a train over 2 s of a source without a dead-man switch", [] {
        const auto asked = [](double deadMan_s, int pulses, const Spread& ofRate = {}) {
            GateSetup setup = benchSetup();
            setup.source.deadMan = Seconds(deadMan_s);
            setup.source.accuracy.rate = ofRate;
            PulseTrain train = volts(1);
            train.pulses = pulses;  // at 100 Hz: the 201st pulse begins after 2 s
            return Rig(setup).ask(train, 4);
        };
        constexpr std::string_view kWords = "no dead-man switch";
        return asked(0, 200).has_value() && refuses(asked(0, 201), ErrorCode::LimitExceeded, kWords) &&
               refuses(asked(-1, 201), ErrorCode::LimitExceeded, kWords) &&
               refuses(asked(kNaN, 201), ErrorCode::LimitExceeded, kWords) && asked(2, 201).has_value() &&
               refuses(asked(0, 200, {0.01, 0}), ErrorCode::LimitExceeded, kWords);
    });
    add(PulseBeyondPeriod, "a pulse that may come out longer than its period", [] {
        GateSetup setup = benchSetup();
        PulseTrain train = volts(10);
        train.rate = Hertz(1990);
        const bool fine = Rig(setup).ask(train).has_value();
        setup.source.accuracy.phaseWidth = Spread{0, 5e-6};
        const bool wider = refuses(Rig(setup).ask(train), ErrorCode::InvalidArgument, "longer than its period");
        setup.source.accuracy = StatedAccuracy::exact();
        setup.source.accuracy.rate = Spread{0.01, 0};
        return fine && wider && refuses(Rig(setup).ask(train), ErrorCode::InvalidArgument, "period of 497.5");
    });
    // 40 V into 100 ohm: four trains exhaust the limit over 5 s.
    const auto fills = [](SafetyGate& gate, VirtualClock& clock) {
        GateSetup setup = benchSetup(Load::resistor(Ohms(100)));
        setup.limits = limitSets();
        if (!gate.configure(setup)) return false;
        for (int k = 0; k < 4; ++k) {
            if (!gate.approve({volts(40), Seconds(10), clock.now()})) return false;
        }
        return true;
    };
    const auto full = [](SafetyGate& gate, VirtualClock& clock) {
        return refuses(gate.approve({volts(40), Seconds(10), clock.now()}), ErrorCode::LimitExceeded,
                       "4 trains before");
    };
    add(MeterBooking, "what was approved before counts", [=] {
        Rig rig;
        return fills(rig.gate, rig.clock) && full(rig.gate, rig.clock);
    });
    const auto recorded = [](const ScratchDir& folder, const Clock& clock) {
        return UnitRecord::open({folder.path() / "records", folder.path()}, "a unit", clock).value();
    };
    add(RecordBooking, "what a run before approved counts", [=] {
        ScratchDir folder;
        {
            Rig first;
            const auto record = recorded(folder, first.clock);
            first.gate.continueFrom(*record);
            if (!fills(first.gate, first.clock)) return false;
        }
        Rig second;
        const auto record = recorded(folder, second.clock);
        second.gate.continueFrom(*record);
        GateSetup setup = benchSetup(Load::resistor(Ohms(100)));
        setup.limits = limitSets();
        return second.gate.configure(setup).has_value() && full(second.gate, second.clock);
    });
    add(PastUnknown, "a unit whose record is damaged", [=] {
        ScratchDir folder;
        Rig rig(benchSetup());
        (void)recorded(folder, rig.clock);
        std::filesystem::resize_file(std::filesystem::directory_iterator(folder.path() / "records")->path(), 10);
        const auto record = recorded(folder, rig.clock);
        const bool fine = rig.ask(volts(1)).has_value();
        rig.gate.continueFrom(*record);
        return fine && refuses(rig.ask(volts(1)), ErrorCode::LimitExceeded, "is not known");
    });
    add(MeterFull, "more trains than the meter holds", [] {
        Rig rig(benchSetup());
        int approved = 0;
        while (approved < 5000 && rig.ask(volts(1), 1).has_value()) ++approved;
        return approved == 4096;
    });
    const auto withPerson = [add](Check check, std::string name, std::function<bool(Rig&)> holds) {
        add(check, std::move(name), [holds] {
            Rig rig(personSetup());
            return rig.configured.has_value() && holds(rig);
        });
    };
    withPerson(PersonNoImpedance, "a person without an impedance", [](Rig& rig) {
        return refuses(rig.ask(milliamps(0.4)), ErrorCode::LimitExceeded, "no impedance") &&
               rig.gate.updateImpedance(Ohms(2000), rig.clock.now()) && rig.ask(milliamps(0.4));
    });
    withPerson(PersonStaleImpedance, "a person's impedance over 5 s old", [](Rig& rig) {
        (void)rig.gate.updateImpedance(Ohms(2000), rig.clock.now());
        rig.wait(5);
        const bool fresh = rig.ask(milliamps(0.4)).has_value();
        rig.wait(0.001);
        return fresh && refuses(rig.ask(milliamps(0.4)), ErrorCode::LimitExceeded, "at most 5 s");
    });
    withPerson(PersonMonophasic, "monophasic for a person", [](Rig& rig) {
        (void)rig.gate.updateImpedance(Ohms(2000), rig.clock.now());
        PulseTrain train = milliamps(0.4);
        train.shape = PulseShape::Monophasic;
        return refuses(rig.ask(train), ErrorCode::LimitExceeded, "monophasic");
    });
    add(PersonBeyondAmplitude, "a person beyond the calibrated amplitudes", [] {
        GateSetup setup = personSetup();
        setup.calibration->amplitude.highest = 0.3;
        Rig rig(setup);
        (void)rig.gate.updateImpedance(Ohms(2000), rig.clock.now());
        return rig.ask(milliamps(0.36)).has_value() &&
               refuses(rig.ask(milliamps(0.37)), ErrorCode::LimitExceeded, "beyond the range");
    });
    add(PersonBeyondWidth, "a person, with a phase beyond the calibrated widths", [] {
        GateSetup setup = personSetup();
        setup.calibration->phaseWidth->highest = 180e-6;
        Rig rig(setup);
        (void)rig.gate.updateImpedance(Ohms(2000), rig.clock.now());
        PulseTrain longer = milliamps(0.3);
        longer.phaseWidth = Micros(220);
        return rig.ask(milliamps(0.3)).has_value() &&
               refuses(rig.ask(longer), ErrorCode::LimitExceeded, "phase width 220 us is beyond");
    });
    add(PersonBeyondInterval, "a person, with an interval beyond the calibrated ones", [] {
        GateSetup setup = personSetup();
        setup.calibration->interval->lowest = 0.5;
        Rig rig(setup);
        (void)rig.gate.updateImpedance(Ohms(2000), rig.clock.now());
        return rig.ask(milliamps(0.3), 0.42).has_value() &&
               refuses(rig.ask(milliamps(0.3), 0.4), ErrorCode::LimitExceeded, "interval 0.4 s is beyond");
    });
    withPerson(PersonLevel, "a jump above the ramp", [](Rig& rig) {
        (void)rig.gate.updateImpedance(Ohms(2000), rig.clock.now());
        return refuses(rig.ask(milliamps(0.6)), ErrorCode::LimitExceeded, "ramp rule") && rig.ask(milliamps(0.5));
    });
    add(LevelMoreThanProgrammed, "a level that comes out above the ramp", [] {
        const auto asked = [](double gain) {
            GateSetup setup = personSetup();
            setup.calibration->amplitude = exactLine(gain, 0, 0.1, 50);
            Rig rig(setup);
            (void)rig.gate.updateImpedance(Ohms(2000), rig.clock.now());
            return rig.ask(milliamps(0.45));
        };
        return asked(1).has_value() && refuses(asked(1.15), ErrorCode::LimitExceeded, "current would be 0.5175 mA");
    });
    withPerson(CheckDiscomfort, "a check pulse above the discomfort limit", [](Rig& rig) {
        const bool fine = rig.gate.approveCheck(rig.clock.now()).has_value();
        (void)rig.gate.reportDiscomfort(Milliamps(0.4));
        return fine && refuses(rig.gate.approveCheck(rig.clock.now()), ErrorCode::LimitExceeded, "discomfort");
    });
    add(BurstIntensity, "a vibration above 1", [] {
        Rig rig;
        return rig.gate.approve(VibrationBurst{1, Seconds(1)}) &&
               refuses(rig.gate.approve(VibrationBurst{1.01, Seconds(1)}), ErrorCode::InvalidArgument, "intensity") &&
               refuses(rig.gate.approve(VibrationBurst{kNaN, Seconds(1)}), ErrorCode::InvalidArgument, "intensity");
    });
    add(BurstDuration, "a vibration over 1 s", [] {
        Rig rig;
        return refuses(rig.gate.approve(VibrationBurst{1, Seconds(1.01)}), ErrorCode::InvalidArgument,
                       "vibration of") &&
               refuses(rig.gate.approve(VibrationBurst{1, Seconds(kNaN)}), ErrorCode::InvalidArgument, "vibration of");
    });
    add(BurstAtElectrodes, "a vibration for a person at electrodes", [] {
        Rig bench(benchSetup());
        Rig rig(personSetup());
        return bench.gate.approve(VibrationBurst{0.1}) &&
               refuses(rig.gate.approve(VibrationBurst{0.1}), ErrorCode::LimitExceeded, "at electrodes");
    });
    const auto withVibrated = [&add](Check check, const char* words, bool (*holds)(SafetyGate&)) {
        add(check, words, [holds] {
            Rig rig(vibrationSetup());
            return rig.configured && holds(rig.gate);
        });
    };
    withVibrated(BurstRamp, "a vibration above the ramp", [](SafetyGate& gate) {
        return gate.approve(VibrationBurst{0.1}) &&
               refuses(gate.approve(VibrationBurst{0.11}), ErrorCode::LimitExceeded, "ramp rule") &&
               gate.acceptIntensity(0.1) && gate.approve(VibrationBurst{0.2});
    });
    withVibrated(BurstDiscomfort, "a vibration above the discomfort limit", [](SafetyGate& gate) {
        for (const double x : {0.1, 0.2, 0.3}) (void)gate.acceptIntensity(x);
        const bool fine = gate.approve(VibrationBurst{0.3}).has_value();
        return fine && gate.reportUncomfortable(0.2) && gate.approve(VibrationBurst{0.2}) &&
               refuses(gate.approve(VibrationBurst{0.3}), ErrorCode::LimitExceeded, "discomfort limit");
    });
    withVibrated(IntensityAccept, "an intensity that was not permitted", [](SafetyGate& gate) {
        return refuses(gate.acceptIntensity(0.5), ErrorCode::LimitExceeded, "ramp rule") &&
               !gate.approve(VibrationBurst{0.5});
    });
    withVibrated(IntensityMalformed, "an accepted intensity below 0", [](SafetyGate& gate) {
        return refuses(gate.acceptIntensity(-0.1), ErrorCode::InvalidArgument, "accepted intensity") &&
               refuses(gate.acceptIntensity(kNaN), ErrorCode::InvalidArgument, "accepted intensity");
    });
    withVibrated(IntensityDiscomfort, "an uncomfortable intensity that is not a number", [](SafetyGate& gate) {
        return refuses(gate.reportUncomfortable(kNaN), ErrorCode::InvalidArgument, "uncomfortable intensity") &&
               refuses(gate.reportUncomfortable(-0.1), ErrorCode::InvalidArgument, "uncomfortable intensity");
    });
    add(IntensityOfPerson, "an intensity of a person at electrodes", [] {
        Rig rig(personSetup());
        return refuses(rig.gate.acceptIntensity(0.1), ErrorCode::NotArmed, "at a massager") &&
               refuses(rig.gate.reportUncomfortable(0.1), ErrorCode::NotArmed, "at a massager") &&
               !rig.gate.intensityCeiling();
    });
    add(Epoch, "a train approved before a stop", [] {
        Rig rig(benchSetup());
        const auto train = rig.ask(volts(10));
        const auto burst = rig.gate.approve(VibrationBurst{1, Seconds(1)});
        const bool before = rig.gate.isCurrent(*train) && rig.gate.isCurrent(*burst);
        rig.gate.latchStop();
        return before && !rig.gate.isCurrent(*train) && !rig.gate.isCurrent(*burst);
    });
    add(Expiry, "a train approved over 100 ms ago", [] {
        Rig rig(benchSetup());
        const auto train = rig.ask(volts(10));
        const auto burst = rig.gate.approve(VibrationBurst{1, Seconds(1)});
        rig.wait(0.1);
        const bool inTime = rig.gate.isCurrent(*train) && rig.gate.isCurrent(*burst);
        rig.wait(0.001);
        return inTime && !rig.gate.isCurrent(*train) && !rig.gate.isCurrent(*burst);
    });
}

/// A monophasic train into the RC load: none of its quantities is zero.
GateSetup limitSetup() {
    GateSetup setup = benchSetup(benchRcLoad());
    setup.electrodeArea = SquareCentimetres(2);
    return setup;
}
PulseTrain limitTrain() {
    PulseTrain train = volts(10);
    train.shape = PulseShape::Monophasic;
    return train;
}

/// For each quantity: a value just above its limit is refused, one just below is approved. The limit is a row or a
/// ceiling; the request is judged alone and with earlier trains.
void addLimitCases(std::vector<GateCase>& cases) {
    for (std::size_t k = 0; k < kQuantityCount; ++k) {
        const auto q = static_cast<Quantity>(k);
        for (const bool ceiling : {false, true}) {
            const auto limited = [q, ceiling](double max) {
                GateSetup setup = limitSetup();
                if (ceiling) {
                    setup.ceilings = {{q, max}};
                } else {
                    setup.limits.push_back(limitsOf({rowFor(q, max)}));
                }
                return setup;
            };
            const std::string by = std::string(keyOf(q)) + (ceiling ? " by a ceiling" : " by a limit");
            cases.push_back({limitCheck(ceiling ? RequestCeiling : RequestLimit, q), by, [q, limited] {
                                 // Twice a second: over a window, the steady state exceeds one train alone.
                                 const GateSetup setup = limitSetup();
                                 const double value =
                                     worstExposure(limitTrain(), Seconds(0.25), setup.load, setup.source, 2).at(q);
                                 Rig below(limited(value * 1.001));
                                 Rig above(limited(value * 0.999));
                                 return value > 0 && below.ask(limitTrain(), 0.25) &&
                                        refuses(above.ask(limitTrain(), 0.25), ErrorCode::LimitExceeded, titleOf(q));
                             }});
            if (windowOf(q) == 0) continue;
            cases.push_back(
                {limitCheck(ceiling ? MeterCeiling : MeterLimit, q), by + " after another train", [q, limited] {
                     const GateSetup setup = limitSetup();
                     const double one = worstExposure(limitTrain(), Seconds(6), setup.load, setup.source, 2).at(q);
                     Rig rig(limited(one * 1.2));  // two trains: a factor √2 in an RMS, 2 in a mean
                     const bool first = rig.ask(limitTrain(), 6).has_value();
                     rig.wait(0.2);
                     const bool second = refuses(rig.ask(limitTrain(), 6), ErrorCode::LimitExceeded, "before it");
                     rig.wait(5.2);
                     return first && second && rig.ask(limitTrain(), 6);
                 }});
        }
    }
}
}  // namespace

std::vector<GateCase> gateCases() {
    std::vector<GateCase> cases;
    addConfigureCases(cases);
    addRequestCases(cases);
    addStateCases(cases);
    addLimitCases(cases);
    addInterlockCases(cases);
    return cases;
}

}  // namespace tacto::test
