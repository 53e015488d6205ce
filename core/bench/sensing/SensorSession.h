// SensorSession.h - the only caller of a fingertip: reads it and hands its samples to the control loop
// through one ring per stream (overflow drops the oldest and counts).
//
// A device that failed is not read again until askHealth(), which looks for it by identity.
//
// Thread-safety: serve() has one caller, the device's thread (on the virtual clock, the bench); collect()
// has one caller, the control loop; the rest any thread.
#pragma once

#include <array>
#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "core/base/SpscRing.h"
#include "core/devices/TactileSensor.h"
#include "core/safety/FixedText.h"

namespace tacto {

class SensorSession {
public:
    static constexpr std::size_t kMaxChannels = 63;  // as many as the session recorder takes

    /// Errors: Unsupported for a stream of more than kMaxChannels channels. `device` outlives the session.
    [[nodiscard]] static Result<std::unique_ptr<SensorSession>> create(TactileSensor& device);

    /// Reads what the device has and returns when to call again.
    Instant serve(Instant now) noexcept;

    /// Moves what arrived since the last call into `blocks`, one per stream, cleared first.
    void collect(std::span<SampleBlock> blocks) noexcept;

    /// Samples lost because the loop did not collect for a second.
    [[nodiscard]] std::uint64_t samplesLost() const noexcept;
    /// True from when the device failed until it answers again; why is in error().
    [[nodiscard]] bool failed() const noexcept { return failed_.load(std::memory_order_acquire); }
    /// Times that the device failed while it was read.
    [[nodiscard]] std::uint64_t failures() const noexcept { return failures_.load(std::memory_order_acquire); }
    /// Asks a device that failed to be opened again: for leaving a fault. Answered by the next serve(), which may wait
    /// for the device.
    void askHealth() noexcept { healthAsked_.store(true, std::memory_order_release); }
    /// Nothing while unanswered; then success when the device answers, else why it does not.
    [[nodiscard]] std::optional<Result<void>> health();
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
    void answerHealth() noexcept;
    [[nodiscard]] Result<void> recover();
    void fail(std::string_view why) noexcept;
    void hand() noexcept;

    TactileSensor& device_;
    std::vector<Stream> streams_;      // Constant after construction
    std::vector<SampleBlock> blocks_;  // the device thread's
    std::atomic<bool> failed_{false};
    std::atomic<std::uint64_t> failures_{0};
    std::atomic<bool> finished_{false};
    std::atomic<bool> healthAsked_{false};
    mutable std::mutex told_;  // guards what follows; held for a copy only
    FixedText<160> error_;
    std::optional<Result<void>> health_;
};

}  // namespace tacto
