// SensorSession.h - the only caller of a fingertip: reads it and hands its samples to the control loop
// through one ring per stream (overflow drops the oldest and counts).
//
// Thread-safety: serve() has one caller, the device's thread (on the virtual clock, the bench); collect()
// has one caller, the control loop; the rest any thread.
#pragma once

#include <array>
#include <atomic>
#include <memory>
#include <span>
#include <variant>
#include <vector>

#include "core/base/SpscRing.h"
#include "core/devices/TactileSensor.h"
#include "core/safety/FixedText.h"

namespace tacto {

class SensorSession {
public:
    static constexpr std::size_t kMaxChannels = 63;  // what the session recorder takes

    /// Errors: Unsupported for a stream of more than kMaxChannels channels. `device` outlives the session.
    [[nodiscard]] static Result<std::unique_ptr<SensorSession>> create(TactileSensor& device);

    /// Reads what the device has and returns when to call again.
    Instant serve(Instant now) noexcept;

    /// Moves what arrived since the last call into `blocks`, one per stream, cleared first.
    void collect(std::span<SampleBlock> blocks) noexcept;

    /// Samples lost because the loop did not collect for a second.
    [[nodiscard]] std::uint64_t samplesLost() const noexcept;
    /// True once the device failed; why is in error().
    [[nodiscard]] bool failed() const noexcept { return failed_.load(std::memory_order_acquire); }
    [[nodiscard]] FixedText<160> error() const noexcept;
    /// True when the device has no more samples and all were collected.
    [[nodiscard]] bool finished() const noexcept { return finished_.load(std::memory_order_acquire); }
    [[nodiscard]] const TactileSensor& device() const noexcept { return device_; }

private:
    template <std::size_t N>
    struct Sample {
        double t_s;
        std::array<double, N> values;
    };
    using NarrowRing = SpscRing<Sample<3>>;
    using WideRing = SpscRing<Sample<kMaxChannels>>;
    struct Stream {
        std::size_t channels;
        std::variant<std::unique_ptr<NarrowRing>, std::unique_ptr<WideRing>> ring;
    };

    explicit SensorSession(TactileSensor& device);

    TactileSensor& device_;
    std::vector<Stream> streams_;      // Constant after construction
    std::vector<SampleBlock> blocks_;  // the device thread's
    std::atomic<bool> failed_{false};
    std::atomic<bool> finished_{false};
    FixedText<160> error_;  // written once, before failed_ is set
};

}  // namespace tacto
