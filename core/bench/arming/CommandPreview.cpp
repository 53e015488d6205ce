#include "core/bench/arming/CommandPreview.h"

#include "core/base/Clock.h"
#include "core/safety/SafetyGate.h"

namespace tacto {

namespace {

/// No grid, and no ceiling of its own but the standard's 500 V.
SourceTraits idealVoltageSource() {
    SourceTraits source;
    source.drive = Drive::Voltage;
    source.amplitudeMax = 500;
    source.compliance = Volts(500);
    source.widthStep = Micros(0);
    source.widthMin = Micros(1);
    source.widthMax = Micros(100'000);
    return source;
}

}  // namespace

Result<CommandPreview> previewOf(const Command& command, const Profile& profile, const std::vector<LimitSet>& limits,
                                 const Load& load) {
    if (const auto valid = validate(profile.encoding); !valid) return failure(valid);
    GateSetup setup;
    setup.source = idealVoltageSource();
    setup.load = LoadRange::declared(load);
    setup.limits = limits;
    setup.ceilings = profile.ceilings;
    setup.electrodeArea = profile.electrodeArea;
    setup.check = profile.encoding.train;
    const VirtualClock clock;
    SafetyGate gate(clock);
    if (const auto configured = gate.configure(setup); !configured) return failure(configured);
    const auto train = voltageTrain(profile.encoding, command.amplitude);
    CommandPreview preview{impedanceOf(load, train, setup.source), exposureTable(setup, train, command.interval), {}};
    const auto approved = gate.approve(TrainRequest{train, command.interval, Instant(0)});
    if (!approved) preview.refusal = approved.error();
    return preview;
}

}  // namespace tacto
