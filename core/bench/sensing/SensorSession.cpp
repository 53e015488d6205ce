#include "core/bench/sensing/SensorSession.h"

#include <algorithm>
#include <utility>

#include "core/devices/TactileSensor.h"

namespace tacto {

namespace {
constexpr Instant kReadEvery = std::chrono::milliseconds(2);
constexpr Instant kRecoveryPollInterval = std::chrono::milliseconds(100);  // how often a failed device is tried
constexpr double kRingSeconds = 1;

std::optional<BoardEncoder> encoderOf(const EncodingSensor* board) noexcept {
    return board != nullptr ? board->encoder() : std::nullopt;
}

/// Nothing for a board that keeps the profile that it has.
EncoderLoader* loaderOf(TactileSensor& device) noexcept {
    auto* const loader = dynamic_cast<EncoderLoader*>(&device);
    return loader != nullptr && loader->wantsProfile() ? loader : nullptr;
}
}  // namespace

Result<std::unique_ptr<SensorSession>> SensorSession::create(TactileSensor& device) {
    for (const auto& stream : device.streams()) {
        if (stream.channels == 0 || stream.channels > kMaxChannels) {
            return tacto::fail(ErrorCode::Unsupported, "stream \"{}\" of {} has {} channels; 1 to {} are supported",
                               stream.name, device.identity().name, stream.channels, kMaxChannels);
        }
    }
    return std::unique_ptr<SensorSession>(new SensorSession(device));
}

SensorSession::SensorSession(TactileSensor& device)
    : device_(device),
      encoding_(dynamic_cast<const EncodingSensor*>(&device)),
      encodes_(encoderOf(encoding_).has_value()),
      drives_(encodes_ && encoding_->encoder()->drives),
      loader_(encodes_ ? loaderOf(device) : nullptr) {
    for (const auto& info : device.streams()) {
        const auto capacity = static_cast<std::size_t>(std::max(64.0, info.rate_hz * kRingSeconds));
        Stream stream{info.channels, {}};
        if (info.channels <= 3)
            stream.ring = std::make_unique<NarrowRing>(capacity);
        else if (info.channels <= 8)
            stream.ring = std::make_unique<ArrayRing>(capacity);
        else
            stream.ring = std::make_unique<WideRing>(capacity);
        streams_.push_back(std::move(stream));
    }
    blocks_.resize(streams_.size());
}

Instant SensorSession::serve(Instant now) noexcept {
    const std::scoped_lock calling(called_);
    if (healthAsked_.exchange(false, std::memory_order_acq_rel)) answerHealth();
    if (failed()) return now + kRecoveryPollInterval;
    for (auto& block : blocks_) block.clear();
    if (const auto read = device_.read(blocks_); !read) {
        fail(read.error().message);
        failures_.fetch_add(1, std::memory_order_acq_rel);
        return now + kRecoveryPollInterval;
    }
    hand();
    if (device_.finished()) finished_.store(true, std::memory_order_release);
    return now + kReadEvery;
}

Result<void> SensorSession::load(const BoardProfile& profile, bool rested) {
    const std::scoped_lock calling(called_);
    return loader_->load(profile.bytes, rested);
}

/// Puts what was read into the rings.
void SensorSession::hand() noexcept {
    for (std::size_t s = 0; s < streams_.size(); ++s) {
        const auto& block = blocks_[s];
        const auto channels = streams_[s].channels;
        std::visit(
            [&](auto& ring) {
                typename std::remove_cvref_t<decltype(*ring)>::Element sample{};
                for (std::size_t i = 0; i < block.samples(); ++i) {
                    sample.t_s = block.t_s[i];
                    for (std::size_t c = 0; c < channels; ++c) sample.values[c] = block.values[i * channels + c];
                    ring->push(sample);
                }
            },
            streams_[s].ring);
    }
    if (!encodes_) return;
    const auto& encoded = encoding_->encoded();
    for (const auto& frame : encoded.frames) frames_.push(frame);
    for (const auto& train : encoded.trains) trains_.push(train);
    for (const auto& silence : encoded.silences) silences_.push(silence);
}

void SensorSession::collect(Encoded& encoded) noexcept {
    encoded.clear();
    while (const auto frame = frames_.pop()) encoded.frames.push_back(*frame);
    while (const auto train = trains_.pop()) encoded.trains.push_back(*train);
    while (const auto silence = silences_.pop()) encoded.silences.push_back(*silence);
}

void SensorSession::fail(std::string_view why) noexcept {
    const std::scoped_lock lock(told_);
    error_ = why;
    failed_.store(true, std::memory_order_release);
}

Result<void> SensorSession::recover() {
    if (auto* lost = dynamic_cast<Reconnecting*>(&device_)) {
        if (auto again = lost->reconnect(); !again) return again;
    }
    for (auto& block : blocks_) block.clear();
    return device_.read(blocks_);
}

void SensorSession::answerHealth() noexcept {
    Result<void> answer;
    if (failed()) {
        answer = recover();
        if (answer) {
            hand();
            failed_.store(false, std::memory_order_release);
        } else {
            fail(answer.error().message);
        }
    }
    const std::scoped_lock lock(told_);
    health_ = std::move(answer);
}

std::optional<Result<void>> SensorSession::health() {
    const std::scoped_lock lock(told_);
    return std::exchange(health_, std::nullopt);
}

void SensorSession::collect(std::span<SampleBlock> blocks) noexcept {
    for (std::size_t s = 0; s < streams_.size(); ++s) {
        blocks[s].clear();
        const auto channels = streams_[s].channels;
        std::visit(
            [&](auto& ring) {
                std::array<typename std::remove_cvref_t<decltype(*ring)>::Element, 16> samples;
                while (const auto count = ring->pop(samples)) {
                    const auto before = blocks[s].samples();
                    blocks[s].t_s.resize(before + count);
                    blocks[s].values.resize((before + count) * channels);
                    auto* value = &blocks[s].values[before * channels];
                    for (std::size_t i = 0; i < count; ++i) {
                        blocks[s].t_s[before + i] = samples[i].t_s;
                        for (std::size_t c = 0; c < channels; ++c) *value++ = samples[i].values[c];
                    }
                }
            },
            streams_[s].ring);
    }
}

std::uint64_t SensorSession::samplesLost() const noexcept {
    std::uint64_t lost = 0;
    for (const auto& stream : streams_) {
        lost += std::visit([](const auto& ring) { return ring->dropped(); }, stream.ring);
    }
    return lost;
}

FixedText<160> SensorSession::error() const noexcept {
    const std::scoped_lock lock(told_);
    return failed() ? error_ : FixedText<160>{};
}

}  // namespace tacto
