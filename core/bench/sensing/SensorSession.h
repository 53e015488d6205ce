// SensorSession.h - the only caller of a fingertip: reads its samples and hands them to the control loop through one
// ring per stream (which, when full, drops and counts the oldest sample).
//
// A failed device is not read again until askHealth(), which searches for it by identity.
//
// Thread-safety: serve() has one caller, the device's thread (on the virtual clock, the bench); collect()
// has one caller, the control loop; the rest any thread, if not said otherwise.
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
#include "core/devices/EncoderLoader.h"
#include "core/devices/EncodingSensor.h"
#include "core/devices/TactileSensor.h"
#include "core/safety/FixedText.h"

namespace tacto {

class SensorSession {
public:
    static constexpr std::size_t kMaxChannels = 63;            // the most that the session recorder takes
    static constexpr std::size_t kFrames = 128, kTrains = 32;  ///< of an encoder, at most, between two collect()

    /// Errors: Unsupported for a stream with more than kMaxChannels channels. `device` outlives the session.
    [[nodiscard]] static Result<std::unique_ptr<SensorSession>> create(TactileSensor& device);

    /// Reads the available samples and returns the time of the next call.
    Instant serve(Instant now) noexcept;

    /// Moves the samples since the last call into `blocks`, one per stream, each cleared first.
    void collect(std::span<SampleBlock> blocks) noexcept;
    /// True if the fingertip's board encodes, and if its trains are played while it drives. Constant.
    [[nodiscard]] bool boardEncodes() const noexcept { return encodes_; }
    [[nodiscard]] bool boardDrives() const noexcept { return drives_; }
    /// True for a board into which load() writes a profile. Constant.
    [[nodiscard]] bool takesProfile() const noexcept { return loader_ != nullptr; }
    /// Writes a profile into the board's encoder, between two serve(). Has one caller, the bench, which must not be
    /// armed. Errors: as EncoderLoader::load().
    [[nodiscard]] Result<void> load(const BoardProfile& profile, bool rested);
    /// Moves what the board's encoder said since the last call into `encoded`, cleared first.
    void collect(Encoded& encoded) noexcept;

    /// Number of samples lost because the loop did not collect for a second.
    [[nodiscard]] std::uint64_t samplesLost() const noexcept;
    /// True from a failure of the device until it answers again; error() gives the reason.
    [[nodiscard]] bool failed() const noexcept { return failed_.load(std::memory_order_acquire); }
    /// How often the device failed while it was read.
    [[nodiscard]] std::uint64_t failures() const noexcept { return failures_.load(std::memory_order_acquire); }
    /// Asks a failed device to be opened again, to leave a fault. The next serve() answers and may wait for the
    /// device.
    void askHealth() noexcept { healthAsked_.store(true, std::memory_order_release); }
    /// Returns nothing until answered; then success if the device answers, else the reason.
    [[nodiscard]] std::optional<Result<void>> health();
    [[nodiscard]] FixedText<160> error() const noexcept;
    /// True if the device has no more samples and all were collected.
    [[nodiscard]] bool finished() const noexcept { return finished_.load(std::memory_order_acquire); }
    [[nodiscard]] const TactileSensor& device() const noexcept { return device_; }

private:
    template <std::size_t N>
    struct Sample {
        double t_s;
        std::array<double, N> values;
    };
    using NarrowRing = SpscRing<Sample<3>>;
    using ArrayRing = SpscRing<Sample<8>>;  // the taxels of a fingertip
    using WideRing = SpscRing<Sample<kMaxChannels>>;
    struct Stream {
        std::size_t channels;
        std::variant<std::unique_ptr<NarrowRing>, std::unique_ptr<ArrayRing>, std::unique_ptr<WideRing>> ring;
    };

    explicit SensorSession(TactileSensor& device);
    void answerHealth() noexcept;
    [[nodiscard]] Result<void> recover();
    void fail(std::string_view why) noexcept;
    void hand() noexcept;

    TactileSensor& device_;
    std::vector<Stream> streams_;  // constant after construction
    const EncodingSensor* const encoding_;
    const bool encodes_, drives_;
    EncoderLoader* const loader_;
    std::mutex called_;  // held while the device is called
    SpscRing<EncodedFrame> frames_{kFrames};
    SpscRing<EncodedTrain> trains_{kTrains};
    SpscRing<EncodedSilence> silences_{kTrains};
    std::vector<SampleBlock> blocks_;  // used by the device's thread
    std::atomic<bool> failed_{false};
    std::atomic<std::uint64_t> failures_{0};
    std::atomic<bool> finished_{false};
    std::atomic<bool> healthAsked_{false};
    mutable std::mutex told_;  // guards error_ and health_; held for a copy only
    FixedText<160> error_;
    std::optional<Result<void>> health_;
};

}  // namespace tacto
