// BenchGate.h - a gate that allows a source what it can do on a bench load, and what it approves.
//
// Thread-safety: as SafetyGate.
#pragma once

#include <algorithm>
#include <memory>

#include "core/safety/SafetyGate.h"
#include "tests/support/Refused.h"

namespace tacto::test {

/// A gate for `source` on a 1 kohm bench load that allows up to 1000 V; nothing else is asked of it.
[[nodiscard]] inline std::unique_ptr<SafetyGate> benchGate(const Clock& clock, const SourceTraits& source) {
    LimitRow row;
    row.quantity = tacto::Quantity::PeakVoltage;
    row.max = 1000;
    row.source = "test";
    LimitSet limits;
    limits.id = limits.title = "test";
    limits.rows.push_back(row);
    GateSetup setup;
    setup.source = source;
    setup.load = LoadRange::declared(Load::resistor(Ohms(1000)));
    setup.limits.push_back(limits);
    auto gate = std::make_unique<SafetyGate>(clock);
    accepted(gate->configure(setup));
    return gate;
}

/// What it approves now; no train follows for `interval`, or for as long as this one lasts.
[[nodiscard]] inline ApprovedTrain approve(SafetyGate& gate, const Clock& clock, const PulseTrain& train,
                                           Seconds interval = Seconds(2)) {
    TrainRequest request;
    request.train = train;
    request.interval = std::max(interval, train.duration());
    request.onset = clock.now();
    return accepted(gate.approve(request));
}

}  // namespace tacto::test
