// The emulated board's side of the host's commands.
#include <algorithm>

#include "tests/support/emulated/sensor_board/EmulatedBoard.h"

namespace tacto::sensorboard {

namespace {

using FrameBuffer = std::array<std::uint8_t, TSB_FRAME_MOST>;

std::span<const std::uint8_t> firstOf(const FrameBuffer& frame, std::size_t size) {
    return std::span(frame).first(size);
}

}  // namespace

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
