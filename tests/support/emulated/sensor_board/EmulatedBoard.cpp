#include "tests/support/emulated/sensor_board/EmulatedBoard.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tacto::sensorboard {

namespace {

using FrameBuffer = std::array<std::uint8_t, TSB_FRAME_MOST>;

std::span<const std::uint8_t> firstOf(const FrameBuffer& frame, std::size_t size) {
    return std::span(frame).first(size);
}

constexpr double kStatusEvery_us = 1e6;
constexpr std::size_t kNoiseBytes = 200;

double limitOf(std::uint8_t format) noexcept {
    return format == TSB_FORMAT_INT16 ? std::numeric_limits<std::int16_t>::max()
                                      : std::numeric_limits<std::int32_t>::max();
}
}  // namespace

EmulatedBoard::EmulatedBoard(std::unique_ptr<BoardSignal> signal, EmulatedBoardSettings settings, Instant now)
    : settings_(std::move(settings)),
      signal_(std::move(signal)),
      flaws_(settings_.flaws),
      madeAt_(now),
      origin_us_(static_cast<double>(settings_.powerUp_us)),
      random_(settings_.seed, "sensor board line") {
    struct Made {
        std::uint8_t kind, unit, columns;
        double scale, rate_hz;
        std::uint8_t samples;
    };
    const std::array<Made, kStreams> made{{
        {TSB_KIND_ACCELERATION, TSB_UNIT_METRE_PER_SECOND_SQUARED, 3, CountingSignal::kAcceleration, settings_.rate_hz,
         settings_.blockSamples},
        {TSB_KIND_TAXELS, TSB_UNIT_PASCAL, BoardSignal::kTaxels, CountingSignal::kPressure, settings_.slowRate_hz,
         settings_.slowBlockSamples},
        {TSB_KIND_FORCE, TSB_UNIT_NEWTON, 1, CountingSignal::kForce, settings_.slowRate_hz, settings_.slowBlockSamples},
    }};
    for (std::size_t i = 0; i < kStreams; ++i) {
        auto& c = streams_[i].configuration;
        c.stream = static_cast<std::uint8_t>(i);
        c.flags = TSB_STREAM_ENABLED;
        c.kind = made[i].kind;
        c.unit = i == 0 ? settings_.unit.value_or(made[i].unit) : made[i].unit;
        c.format = i == 2 && settings_.wideForce ? TSB_FORMAT_INT32 : TSB_FORMAT_INT16;
        c.columns = made[i].columns;
        c.rate_mhz = static_cast<std::uint32_t>(std::llround(made[i].rate_hz * 1000));
        std::fill_n(c.scale, c.columns, static_cast<float>(made[i].scale));
        streams_[i].blockSamples = std::min(made[i].samples, tsb_block_most(c.columns, c.format));
        streams_[i].divisor = divisorOf(c.rate_mhz).value_or(1);
    }
}

std::optional<std::int64_t> EmulatedBoard::divisorOf(std::uint32_t rate_mhz) const noexcept {
    const auto tick_mhz = std::llround(settings_.tickRate_hz * 1000);
    if (rate_mhz == 0 || tick_mhz % rate_mhz != 0) return std::nullopt;
    return tick_mhz / rate_mhz;
}

std::uint64_t EmulatedBoard::time_us(Instant now) const noexcept {
    const double passed_us = static_cast<double>((now - madeAt_).count()) * 1e-3;
    return static_cast<std::uint64_t>(origin_us_ + passed_us * (1 + settings_.drift_ppm * 1e-6));
}

Instant EmulatedBoard::hostTime(double device_us) const noexcept {
    return madeAt_ + toInstant((device_us - origin_us_) * 1e-6 / (1 + settings_.drift_ppm * 1e-6));
}

void EmulatedBoard::begin(Instant now) {
    running_ = true;
    started_us_ = static_cast<double>(time_us(now));
    tick_ = 0;
    nextStatus_us_ = started_us_ + kStatusEvery_us;
    samplesLost_ = blocksDropped_ = 0;
    for (auto& stream : streams_) {
        stream.sequence = stream.index = stream.skip = 0;
        stream.held = 0;
        stream.waiting.clear();
        stream.fate = {};
    }
}

void EmulatedBoard::restart(Instant now) {
    advance(now);
    madeAt_ = now;
    origin_us_ = 0;
    if (running_) begin(now);
}

void EmulatedBoard::jumpClock(Seconds ahead) {
    const double us = ahead.count() * 1e6;
    origin_us_ += us;
    started_us_ += us;
    nextStatus_us_ += us;
}

void EmulatedBoard::overrun(std::size_t stream, std::uint32_t samples) { streams_[stream].skip += samples; }

void EmulatedBoard::advance(Instant now) {
    const auto until_us = static_cast<double>(time_us(now));
    while (running_) {
        const double t_us = started_us_ + static_cast<double>(tick_) * 1e6 / settings_.tickRate_hz;
        if (t_us > until_us) return;
        if (tick_ > 0) signal_->step();
        const Instant at = hostTime(t_us);
        for (std::size_t i = 0; i < kStreams; ++i) {
            auto& stream = streams_[i];
            if ((stream.configuration.flags & TSB_STREAM_ENABLED) == 0 || tick_ % stream.divisor != 0) continue;
            sample(stream, i, static_cast<std::uint64_t>(t_us), at);
        }
        if (t_us >= nextStatus_us_) {
            nextStatus_us_ += kStatusEvery_us;
            sendStatus(0, at);
        }
        ++tick_;
    }
}

std::array<double, BoardSignal::kTaxels> EmulatedBoard::valuesOf(std::size_t number) const {
    std::array<double, BoardSignal::kTaxels> values{};
    if (number == 1) return signal_->pressures_Pa();
    if (number == 2) {
        values[0] = signal_->force_N();
    } else {
        const auto a = signal_->acceleration();
        std::copy(a.begin(), a.end(), values.begin());
    }
    return values;
}

void EmulatedBoard::sample(Stream& stream, std::size_t number, std::uint64_t time_us, Instant at) {
    if (stream.skip > 0) {
        if (stream.held > 0) finishBlock(stream, number, at);
        --stream.skip;
        ++stream.index;
        ++samplesLost_;
        ++stream.fate.lostSamples;
        return;
    }
    if (stream.held == 0) stream.blockTime_us = time_us;
    const auto& c = stream.configuration;
    const auto values = valuesOf(number);
    const double limit = limitOf(c.format);
    for (std::size_t i = 0; i < c.columns; ++i) {
        const double raw = (values[i] - static_cast<double>(c.offset[i])) / static_cast<double>(c.scale[i]);
        stream.raw[stream.held * c.columns + i] =
            static_cast<std::int32_t>(std::llround(std::clamp(raw, -limit, limit)));
    }
    ++stream.held;
    if (stream.held == stream.blockSamples) finishBlock(stream, number, at);
}

void EmulatedBoard::finishBlock(Stream& stream, std::size_t number, Instant at) {
    const auto& c = stream.configuration;
    tsb_block block{};
    block.stream = static_cast<std::uint8_t>(number);
    block.count = stream.held;
    block.columns = c.columns;
    block.sequence = stream.sequence++;
    block.index = stream.index;
    block.time_us = stream.blockTime_us;
    block.interval_ns = static_cast<std::uint32_t>(std::llround(1e12 / c.rate_mhz));
    stream.index += stream.held;
    stream.held = 0;
    ++stream.fate.made;
    stream.fate.samples += block.count;

    std::array<std::uint8_t, TSB_FRAME_MOST> frame;
    std::size_t size = 0;
    const std::size_t values = static_cast<std::size_t>(block.count) * c.columns;
    if (c.format == TSB_FORMAT_INT16) {
        std::array<std::int16_t, 128> narrow;
        std::transform(stream.raw.begin(), stream.raw.begin() + static_cast<std::ptrdiff_t>(values), narrow.begin(),
                       [](std::int32_t v) { return static_cast<std::int16_t>(v); });
        size = tsb_encode_int16(frame.data(), &block, narrow.data());
    } else {
        size = tsb_encode_int32(frame.data(), &block, stream.raw.data());
    }
    sendBlock(stream, {frame.begin(), frame.begin() + static_cast<std::ptrdiff_t>(size)}, block.count, at);
}

void EmulatedBoard::lose(Stream& stream, std::uint8_t count) noexcept {
    ++stream.fate.lost;
    stream.fate.lostSamples += count;
}

void EmulatedBoard::sendBlock(Stream& stream, std::vector<std::uint8_t> bytes, std::uint8_t count, Instant at) {
    const auto number = static_cast<std::size_t>(&stream - streams_.data());
    if (queuedBytes_ + bytes.size() > settings_.bufferBytes) {
        ++blocksDropped_;
        return lose(stream, count);
    }
    if (!stream.waiting.empty()) {
        queue(bytes, at);
        queue(stream.waiting, at);
        stream.waiting.clear();
        return;
    }
    if (dropNext_[number]) {
        dropNext_[number] = false;
        return lose(stream, count);
    }
    double chance = random_.uniform();
    const auto happens = [&](double share) {
        chance -= share;
        return chance < 0;
    };
    if (happens(flaws_.drop)) return lose(stream, count);
    if (happens(flaws_.flip)) {
        const auto bit = random_.below(8 * (bytes.size() - 1));
        bytes[bit / 8] = static_cast<std::uint8_t>(bytes[bit / 8] ^ (1U << (bit % 8)));
        ++stream.fate.flipped;
        lose(stream, count);
        return queue(bytes, at);
    }
    if (happens(flaws_.swap)) {
        ++stream.fate.late;
        lose(stream, count);
        stream.waiting = std::move(bytes);
        return;
    }
    queue(bytes, at);
    if (happens(flaws_.duplicate)) {
        ++stream.fate.late;
        queue(bytes, at);
    }
}

void EmulatedBoard::queue(std::span<const std::uint8_t> bytes, Instant at) {
    if (silent_) return;
    const double late_s = settings_.latency.count() - settings_.jitter.count() * std::log(1 - random_.uniform());
    lastDue_ = std::max(lastDue_, at + toInstant(late_s));  // a line keeps the order of frames
    std::vector<std::uint8_t> sent(bytes.begin(), bytes.end());
    if (garbage_) {
        sent.resize(kNoiseBytes);
        std::ranges::generate(sent, [&] { return static_cast<std::uint8_t>(random_.below(256)); });
    }
    queuedBytes_ += sent.size();
    outgoing_.push_back({lastDue_, std::move(sent)});
}

std::size_t EmulatedBoard::transmit(std::span<std::uint8_t> into, Instant now) {
    advance(now);
    std::size_t written = 0;
    while (written < into.size() && !outgoing_.empty() && outgoing_.front().due <= now) {
        const auto& front = outgoing_.front().bytes;
        const auto part = std::min(into.size() - written, front.size() - sentOfFront_);
        std::copy_n(front.begin() + static_cast<std::ptrdiff_t>(sentOfFront_), part,
                    into.begin() + static_cast<std::ptrdiff_t>(written));
        written += part;
        sentOfFront_ += part;
        if (sentOfFront_ < front.size()) break;
        queuedBytes_ -= front.size();
        sentOfFront_ = 0;
        outgoing_.pop_front();
    }
    return written;
}

std::optional<Instant> EmulatedBoard::nextTransmit() const noexcept {
    if (!outgoing_.empty()) return outgoing_.front().due;
    if (!running_) return std::nullopt;
    return hostTime(started_us_ + static_cast<double>(tick_) * 1e6 / settings_.tickRate_hz);
}

void EmulatedBoard::receive(std::span<const std::uint8_t> bytes, Instant now) {
    advance(now);
    for (const auto byte : bytes) {
        tsb_command command{};
        if (tsb_receive(&receiver_, byte, &command) != 0) answer(command, now);
    }
}

void EmulatedBoard::answer(const tsb_command& command, Instant now) {
    FrameBuffer frame;
    const auto refuse = [&](std::uint8_t reason) {
        queue(firstOf(frame, tsb_encode_refused(frame.data(), command.token, command.type, reason)), now);
    };
    const auto done = [&] {
        const auto named = settings_.done.value_or(command.type);
        queue(firstOf(frame, tsb_encode_done(frame.data(), command.token, named, time_us(now))), now);
    };
    switch (command.type) {
        case TSB_HELLO: {
            const tsb_identity identity{settings_.lowestVersion, settings_.highestVersion, kStreams,
                                        settings_.name.c_str(),  settings_.serial.c_str(), settings_.firmware.c_str()};
            return queue(firstOf(frame, tsb_encode_identity(frame.data(), command.token, &identity)), now);
        }
        case TSB_GET_CONFIGURATION:
            if (command.stream >= kStreams) return refuse(TSB_REASON_NO_SUCH_STREAM);
            return queue(firstOf(frame, tsb_encode_configuration(frame.data(), command.token,
                                                                 &streams_[command.stream].configuration)),
                         now);
        case TSB_SET_CONFIGURATION:
            return setConfiguration(command, now);
        case TSB_GET_CALIBRATION: {
            if (command.stream >= kStreams) return refuse(TSB_REASON_NO_SUCH_STREAM);
            tsb_calibration calibration{};
            calibration.stream = command.stream;
            calibration.flags = TSB_STREAM_CALIBRATED;
            calibration.columns = streams_[command.stream].configuration.columns;
            calibration.date = "2026-11-20";
            calibration.reference = "emulated: exact";
            return queue(firstOf(frame, tsb_encode_calibration(frame.data(), command.token, &calibration)), now);
        }
        case TSB_START:
            done();
            return begin(now);
        case TSB_STOP:
            running_ = false;
            return done();
        case TSB_GET_STATUS:
            return sendStatus(command.token, now);
        case TSB_GET_ENCODER:
        case TSB_SET_ENCODER: {
            if (!settings_.encoder) return refuse(TSB_REASON_UNKNOWN_COMMAND);
            if (command.mode > TSB_MODE_ENCODE) return refuse(TSB_REASON_NOT_SUPPORTED);
            if (command.type == TSB_SET_ENCODER && running_) return refuse(TSB_REASON_RUNNING);
            if (command.type == TSB_SET_ENCODER)
                mode_ = settings_.encoder->refusal == 0 ? command.mode : std::uint8_t{TSB_MODE_OFF};
            auto state = *settings_.encoder;
            state.mode = mode_;
            return queue(firstOf(frame, tsb_encode_encoder(frame.data(), command.token, &state)), now);
        }
        default:
            return refuse(TSB_REASON_UNKNOWN_COMMAND);
    }
}

void EmulatedBoard::setConfiguration(const tsb_command& command, Instant now) {
    FrameBuffer frame;
    const auto& wanted = command.configuration;
    std::uint8_t reason = 0;
    if (command.stream >= kStreams) {
        reason = TSB_REASON_NO_SUCH_STREAM;
    } else if (running_) {
        reason = TSB_REASON_RUNNING;
    } else {
        const auto& now_ = streams_[command.stream].configuration;
        const bool same = wanted.kind == now_.kind && wanted.unit == now_.unit && wanted.format == now_.format &&
                          wanted.columns == now_.columns;
        if (!same || !divisorOf(wanted.rate_mhz)) reason = TSB_REASON_NOT_SUPPORTED;
    }
    if (reason != 0) {
        return queue(firstOf(frame, tsb_encode_refused(frame.data(), command.token, command.type, reason)), now);
    }
    auto& stream = streams_[command.stream];
    stream.configuration = wanted;
    stream.divisor = *divisorOf(wanted.rate_mhz);
    queue(firstOf(frame, tsb_encode_configuration(frame.data(), command.token, &stream.configuration)), now);
}

void EmulatedBoard::sendStatus(std::uint8_t token, Instant now) {
    tsb_status status{};
    status.flags = running_ ? TSB_STATUS_RUNNING : 0;
    status.time_us = time_us(now);
    status.samples_lost = samplesLost_;
    status.blocks_dropped = blocksDropped_;
    status.frames_refused = receiver_.refused;
    FrameBuffer frame;
    queue(firstOf(frame, tsb_encode_status(frame.data(), token, &status)), now);
}

}  // namespace tacto::sensorboard
