#include "tests/drivers/sensor_board/firmware/Replay.h"

#include "resources/firmware/sensor_board/tsb_board.h"

struct output {
    uint8_t* bytes;
    size_t used, most;
    int overflow;
};

static void put(struct output* out, const uint8_t* frame, size_t size) {
    size_t i;
    if (size == 0 || size > out->most - out->used) {
        out->overflow = 1;
        return;
    }
    for (i = 0; i < size; ++i) out->bytes[out->used + i] = frame[i];
    out->used += size;
}

static void put_descriptions(struct output* out) {
    uint8_t frame[TSB_FRAME_MOST];
    struct tsb_identity identity;
    struct tsb_configuration configuration;
    struct tsb_calibration calibration;
    uint8_t i;

    identity.lowest_version = 1;
    identity.highest_version = 1;
    identity.streams = 3;
    identity.name = "Golden board";
    identity.serial = "G-0001";
    identity.firmware = "1.2.3";
    put(out, frame, tsb_encode_identity(frame, 1, &identity));

    configuration.stream = 0;
    configuration.flags = TSB_STREAM_ENABLED;
    configuration.kind = TSB_KIND_ACCELERATION;
    configuration.unit = TSB_UNIT_METRE_PER_SECOND_SQUARED;
    configuration.format = TSB_FORMAT_INT16;
    configuration.columns = 3;
    configuration.rate_mhz = 4000000U;
    calibration.stream = 0;
    calibration.flags = TSB_STREAM_CALIBRATED;
    calibration.columns = 3;
    calibration.date = "2026-11-20";
    calibration.reference = "CERT 17";
    for (i = 0; i < 3; ++i) {
        configuration.scale[i] = 0.0048828125F;
        configuration.offset[i] = 0;
        calibration.uncertainty[i] = 0.005F;
    }
    put(out, frame, tsb_encode_configuration(frame, 2, &configuration));
    put(out, frame, tsb_encode_calibration(frame, 4, &calibration));
}

static void put_states(struct output* out) {
    uint8_t frame[TSB_FRAME_MOST];
    struct tsb_status status;
    put(out, frame, tsb_encode_done(frame, 5, TSB_START, 1000000U));
    status.flags = TSB_STATUS_RUNNING;
    status.faulty_streams = 0;
    status.time_us = 4294967296ULL;
    status.samples_lost = 3;
    status.blocks_dropped = 2;
    status.frames_refused = 1;
    put(out, frame, tsb_encode_status(frame, 0, &status));
    put(out, frame, tsb_encode_refused(frame, 3, TSB_SET_CONFIGURATION, TSB_REASON_RUNNING));
}

static void put_blocks(struct output* out) {
    static const int16_t narrow[6] = {1, -1, 0, 256, -32768, 32767};
    static const int32_t wide[1] = {-2147483647 - 1};
    uint8_t frame[TSB_FRAME_MOST];
    struct tsb_block block;
    block.stream = 0;
    block.count = 2;
    block.columns = 3;
    block.sequence = 258;
    block.index = 8256;
    block.time_us = 5000000U;
    block.interval_ns = 250000U;
    put(out, frame, tsb_encode_int16(frame, &block, narrow));
    block.stream = 2;
    block.count = 1;
    block.columns = 1;
    block.sequence = 0;
    block.index = 4294967295U;
    block.time_us = 1099511627776ULL;
    block.interval_ns = 5000000U;
    put(out, frame, tsb_encode_int32(frame, &block, wide));
}

static void put_encoder(struct output* out) {
    static const struct tsb_encoder encoder = {TSB_MODE_ENCODE, 0, 1U, 0x89ABCDEFU};
    static const struct tsb_train train = {258U,   5000000U, 0.5F,  13.5F, 6.75F,  1,    1,
                                           200.0F, 50.0F,    10.0F, 10U,   100.0F, 3500U};
    static const struct tsb_silence faulty = {3U, 6000000U, 2U | 8U, 0};
    static const struct tsb_silence refused = {4U, 7000000U, 0U, 16};
    static const uint8_t absent[4] = {0x00, 0x00, 0xC0, 0x7F}; /* a quiet NaN */
    uint8_t frame[TSB_FRAME_MOST];
    struct tsb_reading reading;
    put(out, frame, tsb_encode_encoder(frame, 9, &encoder));
    reading.sequence = 70000U;
    reading.time_us = 8589934592ULL;
    reading.flags = TSB_READING_CONTACT | TSB_READING_SLIDING_ASSUMED;
    reading.faults = 0U;
    reading.roughness = 0.625F;
    reading.pressure = 0.25F;
    reading.pressure_pa = 10000.0F;
    reading.h = 0.03125F;
    reading.v = tsb_get_f32(absent);
    put(out, frame, tsb_encode_reading(frame, &reading));
    put(out, frame, tsb_encode_train(frame, &train));
    put(out, frame, tsb_encode_silence(frame, &faulty));
    put(out, frame, tsb_encode_silence(frame, &refused));
}

size_t tacto_replay(const uint8_t* in, size_t size, uint8_t* out, size_t most) {
    struct output output;
    struct tsb_receiver receiver = {{0}, 0, 0, 0};
    struct tsb_command command;
    uint8_t frame[TSB_FRAME_MOST];
    size_t i;
    output.bytes = out;
    output.used = 0;
    output.most = most;
    output.overflow = 0;
    put_descriptions(&output);
    put_states(&output);
    put_blocks(&output);
    put_encoder(&output);
    for (i = 0; i < size; ++i) {
        if (!tsb_receive(&receiver, in[i], &command)) continue;
        if (command.type == TSB_SET_CONFIGURATION) {
            put(&output, frame, tsb_encode_configuration(frame, command.token, &command.configuration));
        } else {
            put(&output, frame,
                tsb_encode_done(frame, command.token, command.type, command.stream + 256U * command.mode));
        }
    }
    return output.overflow ? 0 : output.used;
}
