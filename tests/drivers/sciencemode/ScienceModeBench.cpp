#include "tests/drivers/sciencemode/ScienceModeBench.h"

#include <algorithm>

#include "tests/support/Refused.h"

namespace tacto::test {

PulseTrain biphasic(double milliamps, int pulses, double rate_hz) {
    PulseTrain train;
    train.amplitude = Milliamps(milliamps);
    train.pulses = pulses;
    train.rate = Hertz(rate_hz);
    return train;
}

void startRepeating(sciencemode::EmulatedStimulator& device, Instant now) {
    device.startRepeating(sciencemode::planPulse(biphasic(5))->points, Seconds(0.05), now);
}

bool cameLate(const Error& error) {
    return error.code == ErrorCode::Timeout || error.message.find("approval expired") != std::string::npos;
}

ScienceModeBench::ScienceModeBench(sciencemode::EmulatedSettings device, sciencemode::StimulatorSettings settings)
    : line(std::make_shared<EmulatedLine>(clock, &clock, std::move(device))) {
    stimulator =
        accepted(sciencemode::ScienceModeStimulator::open(line->connector(), "sciencemode:", {}, settings, clock));
    gate_ = benchGate(clock, stimulator->traits());
}

ScienceModeBench::~ScienceModeBench() = default;

void ScienceModeBench::wait(Seconds duration) {
    static_cast<void>(line->pulses());  // lets bytes on their way reach the device before time passes
    const Instant until = clock.now() + toInstant(duration);
    while (stimulator) {
        const Instant next = stimulator->serve(clock.now());
        if (next > until) break;
        clock.advanceTo(next);
    }
    clock.advanceTo(until);
}

ApprovedTrain ScienceModeBench::approved(double milliamps, int pulses, double rate_hz) {
    return approved(biphasic(milliamps, pulses, rate_hz));
}

ApprovedTrain ScienceModeBench::approved(const PulseTrain& train, Seconds interval) {
    return approve(*gate_, clock, train, std::max(interval, 1.2 * train.duration()));
}

Result<void> ScienceModeBench::deliver(const PulseTrain& train) {
    auto delivered = stimulator->deliver(approved(train));
    if (delivered) wait(train.duration() + Seconds(0.01));
    return delivered;
}

StimulatorStatus ScienceModeBench::status() { return accepted(stimulator->status()); }

}  // namespace tacto::test
