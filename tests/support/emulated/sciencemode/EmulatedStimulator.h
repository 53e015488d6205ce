// EmulatedStimulator.h - a ScienceMode4 device without hardware: takes and returns bytes and puts pulses on a load, at
// the times it is given. No I/O and no thread: a pseudo-terminal, an emulated USB node or a test carries the bytes.
//
// Does what the P24's documentation says: low-level pulses end by themselves and are answered with their read-back and
// a result that depends on the load. A mid-level repetition, which another program may have begun, continues until it
// is stopped. Every pulse is kept with its time, so that tests can check for silence. Faulty answers come on request.
//
// Assumed where the protocol notes say nothing: LL_CHANNEL_CONFIG before LL_INIT, or after a stop, is answered "not
// initialised"; during a pulse it is answered "busy"; LL_INIT ends mid level.
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
    Seconds latency{500e-6};  ///< from a request (or the end of its pulse) to the ack
    bool sampleTimeIsTotal = false;
};

/// Ways in which an ack can be wrong.
enum class AckFault {
    Drop,         ///< never sent
    Delay,        ///< sent after EmulatedStimulator::kLate
    Duplicate,    ///< sent twice
    Junk,         ///< preceded by bytes that look like the beginning of a frame
    WrongLength,  ///< with a wrong length field in the frame
    WrongCrc,
    WrongNumber,   ///< with another packet number
    WrongCommand,  ///< as the ack of another command
    Truncated,     ///< one byte of the payload missing, in a valid frame
    WrongChannel,  ///< LL_CHANNEL_CONFIG: answers for another channel
    Refused,       ///< with result 4: the stimulation unit does not answer
};

class EmulatedStimulator {
public:
    static constexpr Seconds kLate{0.08};

    explicit EmulatedStimulator(EmulatedSettings settings = {});

    /// Receives bytes from the host.
    void receive(std::span<const std::uint8_t> bytes, Instant now);
    /// Moves bytes for the host that are due by `now` into `into`; returns how many.
    [[nodiscard]] std::size_t transmit(std::span<std::uint8_t> into, Instant now);
    /// Returns when the next bytes for the host are due.
    [[nodiscard]] std::optional<Instant> nextTransmit() const noexcept;

    /// Makes the next `times` acks wrong in this way, after the faults requested before.
    void misbehave(AckFault fault, int times = 1);
    /// Answers every request with `bytes` of noise from now on.
    void talkGarbage(std::size_t bytes) { garbage_ = bytes; }
    void fit(const Load& load, Instant now);
    /// Acts as if another program had begun a mid-level repetition: one pulse of `points` every `period`, from now on.
    void startRepeating(const Points& points, Seconds period, Instant now);
    /// Cuts the power: output ends, and everything is forgotten except the recorded pulses.
    void powerCycle(Instant now);

    /// Returns every pulse that began by `now`, oldest first.
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
    std::deque<Outgoing> outgoing_;  // answers, sorted by due time
    std::deque<AckFault> faults_;
    std::size_t garbage_ = 0;
    std::array<std::uint64_t, 128> requests_{};

    bool lowLevel_ = false;
    LowLevelInit init_;
    std::optional<Repetition> repetition_;
};

}  // namespace tacto::sciencemode
