// EmulatedPulsePal.h - a Pulse Pal 2 without hardware, with its firmware's habits: everything happens in cycles of 50
// µs, one command each; a trigger starts its train in the next cycle, and one that comes during a train is kept and
// starts another as soon as that ends, also when an abort ended it; a command of which a part is missing is waited for
// 0.5 s, with the outputs as they are, and then the device is frozen until its joystick is clicked; replies are lost
// while the host does not set DTR; continuous mode plays on for ever.
//
// Bytes in, bytes out; stored trains and bursts are kept as parameters but not played.
//
// Thread-safety: none; its line locks. Times never go back.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "drivers/pulsepal/PulsePalCommands.h"

namespace tacto::pulsepal {

/// A stretch in which an output was not at its resting voltage.
struct EmittedPhase {
    int channel = 1;
    Instant begin{0};
    Instant end{0};  ///< its end is not yet known while it lasts: Instant::max()
    Volts volts{0};
};

class EmulatedPulsePal {
public:
    static constexpr Instant kReadTimeout = std::chrono::milliseconds(500);

    explicit EmulatedPulsePal(std::uint32_t firmware = 21);

    /// The host's DTR line. Off at first.
    void setReady(bool ready) noexcept { ready_ = ready; }
    /// One transfer.
    void receive(std::span<const std::uint8_t> bytes, Instant now);
    /// Takes what it has answered by now; returns how many bytes.
    [[nodiscard]] std::size_t transmit(std::span<std::uint8_t> into, Instant now);

    void clickJoystick(Instant now);
    /// As if "continuous" were chosen in its menu: the channel's parameters play until they are aborted, and so does
    /// whatever is triggered later.
    void setContinuous(int channel, bool on, Instant now);
    /// The mains go: parameters, bytes and trains are forgotten.
    void powerCycle(Instant now);

    [[nodiscard]] const std::vector<EmittedPhase>& phases(Instant now);
    /// Whether any train is in progress.
    [[nodiscard]] bool active(Instant now);
    [[nodiscard]] Volts level(int channel, Instant now);
    [[nodiscard]] bool frozen(Instant now);
    /// Bytes that it has received and not yet carried out.
    [[nodiscard]] std::size_t pending(Instant now);
    /// The stored value; nothing for a number without a parameter.
    [[nodiscard]] std::optional<std::uint32_t> stored(Parameter parameter, int channel) const;
    /// How many commands of this code it has carried out.
    [[nodiscard]] std::uint64_t commands(std::uint8_t code) const noexcept { return counts_[code]; }
    [[nodiscard]] const std::string& clientName() const noexcept { return name_; }

private:
    enum class Stage { Rest, Phase1, Gap, Phase2 };
    struct Output {
        std::map<Parameter, std::uint32_t> parameters;
        bool scheduled = false, triggered = false;  // a trigger: for the next cycle, and kept until it can start
        bool playing = false, continuous = false;
        Stage stage = Stage::Rest;
        std::uint64_t next = 0, end = 0;  // cycles
        std::uint16_t code = kZeroVolts;
        std::optional<std::size_t> phase;  // index of the phase that lasts
    };

    void advance(Instant now);
    void cycle();
    /// Carries out the command in front; false when a part of it is missing.
    [[nodiscard]] bool handle();
    void setParameter(std::uint8_t number, std::uint8_t channel, std::size_t at);
    void play(int index);
    void start(Output& output);
    void kill(int index);
    void put(int index, std::uint16_t code);
    void reply(std::initializer_list<std::uint8_t> bytes);
    [[nodiscard]] bool idle() const noexcept;
    [[nodiscard]] std::uint32_t of(const Output& output, Parameter parameter) const;
    [[nodiscard]] Instant timeOf(std::uint64_t cycles) const noexcept { return cycles * Instant(50'000); }

    const std::uint32_t firmware_;
    bool ready_ = false;
    bool frozen_ = false;
    std::optional<Instant> waiting_;  // since when it has waited for the rest of a command
    std::uint64_t cycle_ = 0;         // the next one
    std::deque<std::uint8_t> in_, out_;
    std::array<Output, kChannels> outputs_;
    std::array<std::uint8_t, 2> triggerModes_{};
    std::array<std::uint64_t, 256> counts_{};
    std::vector<EmittedPhase> phases_;
    std::string name_;
};

}  // namespace tacto::pulsepal
