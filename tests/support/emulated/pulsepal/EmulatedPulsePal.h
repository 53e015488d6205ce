// EmulatedPulsePal.h - a Pulse Pal 2 without hardware, with the habits of its firmware. It takes one command per cycle
// of 50 µs. A trigger starts its train in the next cycle; a trigger during a train is kept and starts another train as
// soon as the first ends, even if an abort ended it. The device waits 0.5 s for a missing part of a command, with
// unchanged outputs, and then freezes until its joystick is clicked. Replies are lost while DTR is off; continuous mode
// never ends.
//
// Takes and returns bytes; stored trains and bursts are kept as parameters but not played.
//
// Thread-safety: none; the line locks. Times never go back.
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

/// A period in which an output was not at its resting voltage.
struct EmittedPhase {
    int channel = 1;
    Instant begin{0};
    Instant end{0};  ///< Instant::max() while the phase lasts
    Volts volts{0};
};

class EmulatedPulsePal {
public:
    static constexpr Instant kReadTimeout = std::chrono::milliseconds(500);

    explicit EmulatedPulsePal(std::uint32_t firmware = 21);

    /// Sets the host's DTR line, which is off at first.
    void setReady(bool ready) noexcept { ready_ = ready; }
    /// Receives one transfer.
    void receive(std::span<const std::uint8_t> bytes, Instant now);
    /// Moves the answers that are due by `now` into `into`; returns how many bytes.
    [[nodiscard]] std::size_t transmit(std::span<std::uint8_t> into, Instant now);

    void clickJoystick(Instant now);
    /// Acts as if "continuous" were chosen in the device's menu: the channel's parameters, and everything triggered
    /// later, play until aborted.
    void setContinuous(int channel, bool on, Instant now);
    /// Cuts the power: the device forgets parameters, bytes and trains.
    void powerCycle(Instant now);

    [[nodiscard]] const std::vector<EmittedPhase>& phases(Instant now);
    /// True if any train is in progress.
    [[nodiscard]] bool active(Instant now);
    [[nodiscard]] Volts level(int channel, Instant now);
    [[nodiscard]] bool frozen(Instant now);
    /// Returns how many bytes were received and not yet carried out.
    [[nodiscard]] std::size_t pending(Instant now);
    /// Returns the stored value; nothing if there is no such parameter.
    [[nodiscard]] std::optional<std::uint32_t> stored(Parameter parameter, int channel) const;
    /// Returns how many commands of this code were carried out.
    [[nodiscard]] std::uint64_t commands(std::uint8_t code) const noexcept { return counts_[code]; }
    [[nodiscard]] const std::string& clientName() const noexcept { return name_; }

private:
    enum class Stage { Rest, Phase1, Gap, Phase2 };
    struct Output {
        std::map<Parameter, std::uint32_t> parameters;
        bool scheduled = false, triggered = false;  // a trigger for the next cycle; a trigger kept until it can start
        bool playing = false, continuous = false;
        Stage stage = Stage::Rest;
        std::uint64_t next = 0, end = 0;  // in cycles
        std::uint16_t code = kZeroVolts;
        std::optional<std::size_t> phase;  // index of the current phase
    };

    void advance(Instant now);
    void cycle();
    /// Carries out the first command; returns false if a part of it is missing.
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
    std::optional<Instant> waiting_;  // since when the device has waited for the rest of a command
    std::uint64_t cycle_ = 0;         // the next cycle
    std::deque<std::uint8_t> in_, out_;
    std::array<Output, kChannels> outputs_;
    std::array<std::uint8_t, 2> triggerModes_{};
    std::array<std::uint64_t, 256> counts_{};
    std::vector<EmittedPhase> phases_;
    std::string name_;
};

}  // namespace tacto::pulsepal
