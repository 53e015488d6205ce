#include "drivers/sensor_board/StreamTrack.h"

#include <cmath>

namespace tacto::sensorboard {

namespace {
/// Returns how far `number` is ahead of `expected` (negative: behind); both numbers wrap around.
std::int32_t ahead(std::uint32_t number, std::uint32_t expected) noexcept {
    return static_cast<std::int32_t>(number - expected);
}

std::int32_t rawInt16(const std::uint8_t* bytes) noexcept {
    return static_cast<std::int16_t>(static_cast<std::uint16_t>(bytes[0] | bytes[1] << 8));
}

std::int32_t rawInt32(const std::uint8_t* bytes) noexcept {
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(bytes[0]) | static_cast<std::uint32_t>(bytes[1]) << 8 |
                                     static_cast<std::uint32_t>(bytes[2]) << 16 |
                                     static_cast<std::uint32_t>(bytes[3]) << 24);
}
}  // namespace

StreamTrack::StreamTrack(StreamConfiguration configuration)
    : configuration_(std::move(configuration)), nominal_ns_(1e9 / configuration_.rate_hz()) {}

std::uint64_t StreamTrack::endOf(const DataBlock& block) noexcept {
    return block.time_us + static_cast<std::uint64_t>(block.count - 1) * block.interval_ns / 1000;
}

bool StreamTrack::sound(const DataBlock& block) const noexcept {
    const auto bytes = block.count * configuration_.columns.size() * bytesOf(configuration_.format);
    if (block.samples.size() != bytes) return false;
    if (!(std::abs(block.interval_ns - nominal_ns_) <= kIntervalTolerance * nominal_ns_)) return false;
    // A time near the 64-bit limit cannot be a time since power-up, and sums with it would overflow.
    constexpr std::uint64_t kMaxTime = std::uint64_t{1} << 53U;
    if (block.time_us > kMaxTime) return false;
    if (!begun_) return true;
    return block.time_us > last_us_ && ahead(block.index, nextIndex_) >= 0;
}

StreamTrack::Verdict StreamTrack::take(const DataBlock& block) noexcept {
    const auto lostBlocks = ahead(block.sequence, nextSequence_);
    if (lostBlocks < 0) {
        ++counts_.late;
        ++lateInARow_;
        return Verdict::Late;
    }
    if (!sound(block)) {
        ++counts_.unsound;
        return Verdict::Unsound;
    }
    lateInARow_ = 0;
    const auto lostSamples = ahead(block.index, nextIndex_);
    if (lostBlocks > 0 || lostSamples > 0) {
        ++counts_.gaps;
        counts_.lostBlocks += static_cast<std::uint64_t>(lostBlocks);
        if (lostSamples > 0) counts_.lostSamples += static_cast<std::uint64_t>(lostSamples);
    }
    begun_ = true;
    nextSequence_ = block.sequence + 1;
    nextIndex_ = block.index + block.count;
    last_us_ = endOf(block);
    ++counts_.blocks;
    counts_.samples += block.count;
    return Verdict::Next;
}

void StreamTrack::append(const DataBlock& block, const std::function<double(double us)>& timeOf,
                         SampleBlock& into) const {
    const auto columns = configuration_.columns.size();
    // Between two times this close together the mapping is a straight line.
    const double first = timeOf(static_cast<double>(block.time_us));
    const double span_us = (block.count - 1) * (block.interval_ns * 1e-3);
    const double last = timeOf(static_cast<double>(block.time_us) + span_us);
    const double step = block.count > 1 ? (last - first) / (block.count - 1) : 0;
    for (int i = 0; i < block.count; ++i) into.t_s.push_back(first + i * step);

    const bool narrow = configuration_.format == SampleFormat::Int16;
    const auto width = bytesOf(configuration_.format);
    const auto* raw = block.samples.data();
    for (int i = 0; i < block.count; ++i) {
        for (std::size_t c = 0; c < columns; ++c, raw += width) {
            const auto& column = configuration_.columns[c];
            into.values.push_back(column.scale * (narrow ? rawInt16(raw) : rawInt32(raw)) + column.offset);
        }
    }
}

}  // namespace tacto::sensorboard
