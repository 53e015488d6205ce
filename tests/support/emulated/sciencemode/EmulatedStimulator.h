// EmulatedStimulator.h - a ScienceMode4 device without hardware: bytes in, bytes out, pulses on a load, all on the time
// it is given. No I/O and no thread: a pseudo-terminal, an emulated USB node or a test carries its bytes.
//
// It does what a P24 is documented to do: low-level pulses that end by themselves and are answered with their
// read-back, and results as the load makes them. A repetition in mid level, which another program may have begun, goes
// on until it is stopped. Every pulse is kept with its time, so that silence can be judged. It answers wrongly on
// demand.
//
// Assumed where the wire description is silent: LL_CHANNEL_CONFIG before LL_INIT, or after a stop, is answered "not
// initialised"; one during a pulse "busy"; LL_INIT ends mid level.
//
// Thread-safety: none; the owner locks. Time never goes back between calls.
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "tests/support/emulated/sciencemode/DeviceSide.h"
#include "tests/support/emulated/sciencemode/EmulatedOutput.h"

namespace tacto::sciencemode {

struct EmulatedSettings {
    std::string id = "EMU0000001";
    Version firmware{1, 0, 0};
    Version protocol{4, 0, 0};
    Load load = Load::resistor(Ohms(1000));
    Volts compliance{150};
    Seconds latency{500e-6};  ///< the time from a request (or the end of its pulse) to the ack
    bool sampleTimeIsTotal = false;
};

/// The ways in which an ack fails.
enum class AckFault {
    Drop,         ///< never sent
    Delay,        ///< sent after EmulatedStimulator::kLate
    Duplicate,    ///< sent twice
    Junk,         ///< bytes that look like a frame's beginning before it
    WrongLength,  ///< the frame's length field lies
    WrongCrc,
    WrongNumber,   ///< answers with another packet number
    WrongCommand,  ///< the ack of another command
    Truncated,     ///< a payload a byte too short, in a sound frame
    WrongChannel,  ///< LL_CHANNEL_CONFIG: as if another channel had been used
    Refused,       ///< result 4: the stimulation unit does not answer
};

class EmulatedStimulator {
public:
    static constexpr Seconds kLate{0.08};

    explicit EmulatedStimulator(EmulatedSettings settings = {});

    /// Bytes from the host.
    void receive(std::span<const std::uint8_t> bytes, Instant now);
    /// Bytes for the host that are due by `now`; returns how many were written to `into`.
    [[nodiscard]] std::size_t transmit(std::span<std::uint8_t> into, Instant now);
    /// When the next bytes for the host are due.
    [[nodiscard]] std::optional<Instant> nextTransmit() const noexcept;

    /// The next `times` acks go wrong in this way, after those asked for before.
    void misbehave(AckFault fault, int times = 1);
    /// Requests are not understood any more: every one is answered with `bytes` of noise, for ever.
    void talkGarbage(std::size_t bytes) { garbage_ = bytes; }
    void fit(const Load& load, Instant now);
    /// Another program has begun a repetition in mid level: one pulse of `points` every `period`, from now on.
    void startRepeating(const Points& points, Seconds period, Instant now);
    /// The mains go: output ends, everything is forgotten but the pulses.
    void powerCycle(Instant now);

    /// Every pulse that began by `now`, oldest first.
    [[nodiscard]] const std::deque<EmittedPulse>& pulses(Instant now);
    [[nodiscard]] bool repeating(Instant now);
    [[nodiscard]] Stimulation state(Instant now);
    [[nodiscard]] std::uint64_t requests(Command command) const noexcept;

private:
    struct Repetition {
        Points points;
        Instant period{0};
        Instant next{0};
    };
    struct Outgoing {
        Instant due{0};
        std::vector<std::uint8_t> bytes;
    };
    void advance(Instant now);
    void handle(const Packet& packet, Instant now);
    void configureChannel(const Packet& packet, Instant now);
    void acknowledge(const Packet& to, const Payload& payload, Instant due);
    void acknowledge(const Packet& to, ResultCode result, Instant due);
    void queue(std::vector<std::uint8_t> bytes, Instant due);

    const EmulatedSettings settings_;
    EmulatedOutput output_;
    FrameDecoder decoder_;
    std::deque<Outgoing> outgoing_;  // answers by due time
    std::deque<AckFault> faults_;
    std::size_t garbage_ = 0;
    std::array<std::uint64_t, 128> requests_{};

    bool lowLevel_ = false;
    LowLevelInit init_;
    std::optional<Repetition> repetition_;
};

}  // namespace tacto::sciencemode
