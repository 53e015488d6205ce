// BenchGate.h - a safety gate that allows a source everything it can do on a bench load, and trains approved by it.
//
// Thread-safety: as SafetyGate.
#pragma once

#include <algorithm>
#include <memory>

#include "core/safety/SafetyGate.h"
#include "tests/support/Refused.h"

namespace tacto::test {

/// Makes a gate for `source` on a 1 kohm bench load that allows up to 1000 V and has no other limits.
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

/// Returns `train` approved now; no train follows within `interval`, or within this train's length if that is longer.
[[nodiscard]] inline ApprovedTrain approve(SafetyGate& gate, const Clock& clock, const PulseTrain& train,
                                           Seconds interval = Seconds(2)) {
    TrainRequest request;
    request.train = train;
    request.interval = std::max(interval, train.duration());
    request.onset = clock.now();
    return accepted(gate.approve(request));
}

}  // namespace tacto::test
