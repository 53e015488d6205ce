// GateFixtures.h - setups from which the gate's tests start: complete and valid; each test spoils one thing.
//
// Thread-safety: the test's own thread.
#pragma once

#include <string>

#include "core/safety/SafetyGate.h"
#include "tests/support/Limits.h"
#include "tests/support/Support.h"

namespace tacto::test {

inline LimitSet limitsOf(std::vector<LimitRow> rows, std::string id = "test") {
    LimitSet set;
    set.id = std::move(id);
    set.title = "a set for a test";
    for (auto& row : rows) row.source = "a test";
    set.rows = std::move(rows);
    return set;
}

inline LimitRow rowFor(Quantity quantity, double max, LimitAction action = LimitAction::Refuse) {
    LimitRow row;
    row.quantity = quantity;
    row.max = max;
    row.action = action;
    return row;
}

/// Returns limits that refuse nothing in these tests.
inline LimitSet lenient() { return limitsOf({rowFor(Quantity::PeakVoltage, 1e6)}, "lenient"); }

/// Voltage and current sources that deliver exactly the programmed value, so that limits can be met to the last digit.
inline SourceTraits voltageSource() {
    SourceTraits source;
    source.accuracy = StatedAccuracy::exact();
    source.drive = Drive::Voltage;
    source.amplitudeMax = 60;
    source.compliance = Volts(60);
    return source;
}

inline SourceTraits currentSource() {
    SourceTraits source;
    source.accuracy = StatedAccuracy::exact();
    source.drive = Drive::Current;
    source.amplitudeMax = 100;
    source.compliance = Volts(100);
    return source;
}

inline GateSetup benchSetup(Load load = Load::resistor(Ohms(1000))) {
    GateSetup setup;
    setup.source = voltageSource();
    setup.load = LoadRange::declared(load);
    setup.limits = {lenient()};
    return setup;
}

/// Returns a calibration line without uncertainty.
inline CalibrationLine exactLine(double gain, double offset, double lowest, double highest) {
    return {gain, offset, lowest, highest, Spread{}};
}

inline GateSetup personSetup() {
    GateSetup setup;
    setup.mode = OutputMode::Person;
    setup.source = currentSource();
    setup.limits = limitSets();
    setup.electrodeArea = SquareCentimetres(1);
    PersonSetup person;
    person.participant = "P01";
    person.consentRecorded = true;
    person.discomfortLimit = Milliamps(5);
    person.rampStep = Milliamps(0.5);
    setup.person = person;
    setup.calibration = StimulatorCalibration{exactLine(1, 0, 0.1, 50), exactLine(1, 0, 0.01, 10),
                                              exactLine(1, 0, 10e-6, 1e-3), exactLine(1, 0, 10e-6, 1e-3)};
    setup.calibrated = true;
    return setup;
}

/// A setup for a person at a massager, which has no source, calibration or electrodes.
inline GateSetup vibrationSetup() {
    GateSetup setup;
    setup.mode = OutputMode::Person;
    setup.limits = {lenient()};
    PersonSetup person;
    person.participant = "P02";
    person.consentRecorded = true;
    person.vibration = PersonVibration{.discomfortLimit = 1, .rampStep = 0.1};
    setup.source = voltageSource();
    setup.person = person;
    return setup;
}

/// A single pulse: 200 µs + 200 µs, 100 µs apart.
inline PulseTrain volts(double v) {
    PulseTrain train;
    train.amplitude = Volts(v);
    return train;
}
inline PulseTrain milliamps(double mA) {
    PulseTrain train;
    train.amplitude = Milliamps(mA);
    return train;
}

/// A gate with a clock that the test moves.
struct Rig {
    VirtualClock clock;
    SafetyGate gate{clock};
    explicit Rig(const GateSetup& setup) : configured(gate.configure(setup)) {}
    Rig() = default;
    Result<void> configured;

    Result<ApprovedTrain> ask(const PulseTrain& train, double interval_s = 2) {
        return gate.approve({train, Seconds(interval_s), clock.now()});
    }
    void wait(double seconds) { clock.advanceTo(clock.now() + toInstant(seconds)); }
};

/// True if `result` is an error with this code and these words.
template <class T>
[[nodiscard]] bool refuses(const Result<T>& result, ErrorCode code, std::string_view words) {
    return !result && result.error().code == code && result.error().message.find(words) != std::string::npos;
}

}  // namespace tacto::test
