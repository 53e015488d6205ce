#include "drivers/pulsepal/TrainProgram.h"

namespace tacto::pulsepal {

namespace {

/// The output changes every cycle, but one cycle is just the converter's settling time (wire notes; the maker's menu
/// allows 1). Two cycles give a plateau.
constexpr std::uint32_t kMinPhaseCycles = 2;
constexpr std::uint32_t kMinPauseCycles = 2;
/// Includes the last cycle, which lies after the train's end.
constexpr auto kCyclesLongestTrain = static_cast<std::uint64_t>(Micros(kLongestWithoutDeadMan) / kCycle) + 1;

template <class T>
tl::unexpected<Error> unsupported(const Result<T>& failed) {
    return fail(ErrorCode::Unsupported, "Pulse Pal: {}", failed.error().message);
}

}  // namespace

SourceTraits sourceTraits() noexcept {
    SourceTraits traits;
    traits.drive = Drive::Voltage;
    traits.gap = GapState::HoldsZero;  // the device drives the resting voltage
    traits.amplitudeStep = 0;          // continuous: 16 bits over 20 V give steps of only 0.31 mV
    traits.amplitudeMax = kMaxVolts;
    traits.compliance = Volts(kMaxVolts);
    traits.widthStep = kCycle;
    traits.widthMin = kCycle * static_cast<double>(kMinPhaseCycles);
    traits.widthMax = Micros(100'000);
    traits.pulsesMax = 1000;
    traits.deadMan = Seconds(0);
    traits.readsBack = false;
    traits.checkVoltage = Volts(1);
    return traits;
}

std::vector<CommandBytes> quietChannel(Channel channel) {
    const auto none = Cycles::exactly(0);
    return {set(Switch::LinkTrigger1, channel, false),
            set(Switch::LinkTrigger2, channel, false),
            noCustomTrain(channel),
            set(Switch::CustomTarget, channel, false),
            set(Switch::CustomLoop, channel, false),
            set(Duration::Burst, channel, none),
            set(Duration::InterBurst, channel, none),
            set(Duration::TrainDelay, channel, none),
            set(Voltage::Resting, channel, VoltageCode::zero())};
}

Result<TrainProgram> programTrain(const PulseTrain& train, Channel channel) {
    if (auto sound = validate(train); !sound) return failure(sound);
    if (isCurrent(train.amplitude)) {
        return fail(ErrorCode::Unsupported, "Pulse Pal: a train in mA; it is a voltage source and takes V");
    }
    const double sign = train.polarity == Polarity::Positive ? 1 : -1;
    const bool biphasic = train.shape != PulseShape::Monophasic;
    const double ratio = train.shape == PulseShape::AsymmetricBiphasic ? train.rechargeRatio : 1;
    const double lead = sign * siValue(train.amplitude);

    const auto phase1 = VoltageCode::of(Volts(lead));
    if (!phase1) return unsupported(phase1);
    const auto phase2 = VoltageCode::of(Volts(biphasic ? -lead / ratio : 0));
    if (!phase2) return unsupported(phase2);
    const auto width1 = Cycles::of(train.phaseWidth, "phase width");
    if (!width1) return unsupported(width1);
    if (width1->count() < kMinPhaseCycles) {
        return fail(ErrorCode::Unsupported, "Pulse Pal: phase width {:.6g} us; {:.0f} us or more is accepted",
                    train.phaseWidth.count(), kCycle.count() * kMinPhaseCycles);
    }
    const auto gap = Cycles::of(biphasic ? train.interPhaseGap : Micros(0), "inter-phase gap");
    if (!gap) return unsupported(gap);
    const auto width2 = Cycles::of(biphasic ? train.phaseWidth * ratio : Micros(0), "second phase width");
    if (!width2) return unsupported(width2);

    const std::uint64_t pulse = std::uint64_t{width1->count()} + gap->count() + width2->count();
    std::uint64_t period = pulse + kMinPauseCycles;  // a single pulse needs no rate
    if (train.pulses > 1) {
        const auto asked = Cycles::of(Seconds(1 / train.rate.value()), "period");
        if (!asked) return unsupported(asked);
        period = asked->count();
        if (period < pulse + kMinPauseCycles) {
            return fail(ErrorCode::Unsupported,
                        "Pulse Pal: {:.6g} Hz leaves {} cycles between pulses; {} or more are accepted",
                        train.rate.value(), static_cast<std::int64_t>(period - pulse), kMinPauseCycles);
        }
    }
    const std::uint64_t whole = period * static_cast<std::uint64_t>(train.pulses - 1) + pulse + 1;
    // The gate refuses it earlier; this check keeps a fault of the gate from starting an output that does not end.
    if (whole > kCyclesLongestTrain) {
        return fail(ErrorCode::Unsupported,
                    "Pulse Pal: a train of {:.6g} s; it has no dead-man switch, and at most {:.4g} s is accepted",
                    static_cast<double>(whole - 1) * kCycle.count() * 1e-6, kLongestWithoutDeadMan.count());
    }

    TrainProgram program;
    program.duration = Cycles::exactly(static_cast<std::uint32_t>(whole));
    program.commands = quietChannel(channel);
    for (const auto& command :
         {set(Switch::Biphasic, channel, biphasic), set(Voltage::Phase1, channel, *phase1),
          set(Voltage::Phase2, channel, *phase2), set(Duration::Phase1, channel, *width1),
          set(Duration::InterPhase, channel, *gap), set(Duration::Phase2, channel, *width2),
          set(Duration::InterPulse, channel, Cycles::exactly(static_cast<std::uint32_t>(period - pulse))),
          set(Duration::Train, channel, program.duration)}) {
        program.commands.push_back(command);
    }
    return program;
}

}  // namespace tacto::pulsepal
