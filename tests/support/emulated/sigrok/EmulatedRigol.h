// EmulatedRigol.h - an emulated Rigol DS2072A: answers its commands and takes its records from a signal.
//
// Written from the maker's public command set (DS2000A programming guide) and the commands that libsigrok's rigol-ds
// driver sends; it answers only those. Eight bits, 25 steps a division, 14 divisions; 14000 samples of memory shared by
// the channels that are on, 1400 on the screen; noise of 0.4 steps, so that no two records are equal.
//
// Thread-safety: one caller; no I/O.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/Clock.h"
#include "drivers/simulated/FastNoise.h"

namespace tacto::sigrok_driver {

/// The voltages at the two inputs, in V.
class ScopeInput {
public:
    virtual ~ScopeInput() = default;
    /// Returns the first time from `from_s` to `to_s` at which input `channel` (0, 1) crosses `level_V`, upwards or
    /// downwards.
    [[nodiscard]] virtual std::optional<double> passes(int channel, double level_V, bool upwards, double from_s,
                                                       double to_s) = 0;
    /// Sets `out[k]` to input `channel` at start + k * step.
    virtual void sample(int channel, double start_s, double step_s, std::vector<double>& out) = 0;
};

class EmulatedRigol {
public:
    /// `model` is only the name that the instrument reports; every model answers as a DS2072A.
    EmulatedRigol(std::shared_ptr<ScopeInput> input, const Clock& clock, std::uint64_t seed = 1,
                  std::string model = "DS2072A");

    /// Takes one command without its end of line; returns the answer with one, or an empty text if no answer is due.
    [[nodiscard]] std::string take(std::string_view command);

    /// True if the instrument waits for a trigger.
    [[nodiscard]] bool waiting();
    /// Returns how many records were read out completely, with all channels that are on.
    [[nodiscard]] std::uint64_t readOut() const noexcept { return readOut_; }

private:
    static constexpr int kDivisions = 14;
    static constexpr double kStepsPerDivision = 25;
    static constexpr int kZeroCode = 127;
    static constexpr std::size_t kMemory = 14'000;
    static constexpr std::size_t kScreen = 1400;

    struct Channel {
        bool on = true;
        double probe = 1;
        double scale_V = 1;  ///< volts per division
        std::string coupling = "DC";
    };
    enum class State { Stopped, Waiting, Running };

    [[nodiscard]] std::string ask(std::string_view what);
    void set(std::string_view what, std::string_view value);
    void setChannel(Channel& channel, std::string_view what, std::string_view value);
    [[nodiscard]] std::string askChannel(const Channel& channel, std::string_view what) const;
    void advance();
    [[nodiscard]] std::size_t length() const;
    [[nodiscard]] double before_s() const { return screen_s() / 2 - offset_s_; }
    [[nodiscard]] double screen_s() const { return kDivisions * timebase_s_; }
    [[nodiscard]] std::string block();

    const std::shared_ptr<ScopeInput> input_;
    const Clock& clock_;
    const std::string model_;
    sim::FastNoise noise_;
    std::array<Channel, 2> channels_;
    double timebase_s_ = 1e-3;
    double offset_s_ = 0;  // time from the trigger to the middle of the screen
    int source_ = 0;
    bool rising_ = true;
    double level_V_ = 0;
    State state_ = State::Running;
    double searchFrom_s_ = 0;
    std::optional<double> trigger_s_;  // trigger of the current or last record
    bool complete_ = false;            // true once the record is complete
    std::size_t depth_ = kMemory;
    bool memory_ = false;  // state of :WAV:MODE; true: RAW
    int read_ = 0;         // channel of :WAV:SOUR
    std::uint64_t readOut_ = 0;
};

}  // namespace tacto::sigrok_driver
