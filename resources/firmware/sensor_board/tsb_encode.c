#include "tsb_board.h"

#define TSB_BLOCK_OVERHEAD 24U /* version, type and the block's own fields */

static int columns_fit(uint8_t columns) { return columns >= 1U && columns <= TSB_COLUMNS_MOST; }

size_t tsb_encode_identity(uint8_t* frame, uint8_t token, const struct tsb_identity* identity) {
    struct tsb_writer writer;
    if (identity->streams < 1U || identity->streams > TSB_STREAMS_MOST) return 0;
    tsb_begin(&writer, frame, TSB_VERSION, TSB_IDENTITY);
    tsb_put_u8(&writer, token);
    tsb_put_u8(&writer, identity->lowest_version);
    tsb_put_u8(&writer, identity->highest_version);
    tsb_put_u8(&writer, identity->streams);
    tsb_put_text(&writer, identity->name, TSB_NAME_BYTES);
    tsb_put_text(&writer, identity->serial, TSB_SERIAL_BYTES);
    tsb_put_text(&writer, identity->firmware, TSB_FIRMWARE_BYTES);
    return tsb_seal(&writer);
}

size_t tsb_encode_configuration(uint8_t* frame, uint8_t token, const struct tsb_configuration* configuration) {
    struct tsb_writer writer;
    uint8_t i;
    if (!columns_fit(configuration->columns)) return 0;
    tsb_begin(&writer, frame, TSB_VERSION, TSB_CONFIGURATION);
    tsb_put_u8(&writer, token);
    tsb_put_u8(&writer, configuration->stream);
    tsb_put_u8(&writer, configuration->flags);
    tsb_put_u8(&writer, configuration->kind);
    tsb_put_u8(&writer, configuration->unit);
    tsb_put_u8(&writer, configuration->format);
    tsb_put_u8(&writer, configuration->columns);
    tsb_put_u32(&writer, configuration->rate_mhz);
    for (i = 0; i < configuration->columns; ++i) {
        tsb_put_f32(&writer, configuration->scale[i]);
        tsb_put_f32(&writer, configuration->offset[i]);
    }
    return tsb_seal(&writer);
}

size_t tsb_encode_calibration(uint8_t* frame, uint8_t token, const struct tsb_calibration* calibration) {
    struct tsb_writer writer;
    uint8_t i;
    if (!columns_fit(calibration->columns)) return 0;
    tsb_begin(&writer, frame, TSB_VERSION, TSB_CALIBRATION);
    tsb_put_u8(&writer, token);
    tsb_put_u8(&writer, calibration->stream);
    tsb_put_u8(&writer, calibration->flags);
    tsb_put_u8(&writer, calibration->columns);
    tsb_put_text(&writer, calibration->date, TSB_DATE_BYTES);
    tsb_put_text(&writer, calibration->reference, TSB_REFERENCE_BYTES);
    for (i = 0; i < calibration->columns; ++i) tsb_put_f32(&writer, calibration->uncertainty[i]);
    return tsb_seal(&writer);
}

size_t tsb_encode_done(uint8_t* frame, uint8_t token, uint8_t command, uint64_t time_us) {
    struct tsb_writer writer;
    tsb_begin(&writer, frame, TSB_VERSION, TSB_DONE);
    tsb_put_u8(&writer, token);
    tsb_put_u8(&writer, command);
    tsb_put_u64(&writer, time_us);
    return tsb_seal(&writer);
}

size_t tsb_encode_status(uint8_t* frame, uint8_t token, const struct tsb_status* status) {
    struct tsb_writer writer;
    tsb_begin(&writer, frame, TSB_VERSION, TSB_STATUS);
    tsb_put_u8(&writer, token);
    tsb_put_u8(&writer, status->flags);
    tsb_put_u8(&writer, status->faulty_streams);
    tsb_put_u64(&writer, status->time_us);
    tsb_put_u32(&writer, status->samples_lost);
    tsb_put_u32(&writer, status->blocks_dropped);
    tsb_put_u32(&writer, status->frames_refused);
    return tsb_seal(&writer);
}

size_t tsb_encode_refused(uint8_t* frame, uint8_t token, uint8_t command, uint8_t reason) {
    struct tsb_writer writer;
    tsb_begin(&writer, frame, TSB_VERSION, TSB_REFUSED);
    tsb_put_u8(&writer, token);
    tsb_put_u8(&writer, command);
    tsb_put_u8(&writer, reason);
    return tsb_seal(&writer);
}

size_t tsb_encode_encoder(uint8_t* frame, uint8_t token, const struct tsb_encoder* encoder) {
    struct tsb_writer writer;
    tsb_begin(&writer, frame, TSB_VERSION_2, TSB_ENCODER);
    tsb_put_u8(&writer, token);
    tsb_put_u8(&writer, encoder->mode);
    tsb_put_u8(&writer, encoder->refusal);
    tsb_put_u32(&writer, encoder->layout);
    tsb_put_u32(&writer, encoder->hash);
    return tsb_seal(&writer);
}

size_t tsb_encode_reading(uint8_t* frame, const struct tsb_reading* reading) {
    struct tsb_writer writer;
    tsb_begin(&writer, frame, TSB_VERSION_2, TSB_READING);
    tsb_put_u32(&writer, reading->sequence);
    tsb_put_u64(&writer, reading->time_us);
    tsb_put_u16(&writer, reading->flags);
    tsb_put_u32(&writer, reading->faults);
    tsb_put_f32(&writer, reading->roughness);
    tsb_put_f32(&writer, reading->pressure);
    tsb_put_f32(&writer, reading->pressure_pa);
    tsb_put_f32(&writer, reading->h);
    tsb_put_f32(&writer, reading->v);
    return tsb_seal(&writer);
}

size_t tsb_encode_train(uint8_t* frame, const struct tsb_train* train) {
    struct tsb_writer writer;
    tsb_begin(&writer, frame, TSB_VERSION_2, TSB_TRAIN);
    tsb_put_u32(&writer, train->sequence);
    tsb_put_u64(&writer, train->onset_us);
    tsb_put_f32(&writer, train->interval_s);
    tsb_put_f32(&writer, train->command_v);
    tsb_put_f32(&writer, train->amplitude);
    tsb_put_u8(&writer, train->shape);
    tsb_put_u8(&writer, train->negative);
    tsb_put_f32(&writer, train->width_us);
    tsb_put_f32(&writer, train->gap_us);
    tsb_put_f32(&writer, train->recharge_ratio);
    tsb_put_u32(&writer, train->pulses);
    tsb_put_f32(&writer, train->pulse_hz);
    tsb_put_u16(&writer, train->ahead_us);
    return tsb_seal(&writer);
}

size_t tsb_encode_silence(uint8_t* frame, const struct tsb_silence* silence) {
    struct tsb_writer writer;
    tsb_begin(&writer, frame, TSB_VERSION_2, TSB_SILENT);
    tsb_put_u32(&writer, silence->sequence);
    tsb_put_u64(&writer, silence->time_us);
    tsb_put_u32(&writer, silence->faults);
    tsb_put_u8(&writer, silence->refusal);
    return tsb_seal(&writer);
}

uint8_t tsb_block_most(uint8_t columns, uint8_t format) {
    const size_t bytes = tsb_format_bytes(format);
    if (bytes == 0 || !columns_fit(columns)) return 0;
    return (uint8_t)((TSB_RAW_MOST - TSB_CRC_BYTES - TSB_BLOCK_OVERHEAD) / (bytes * columns));
}

/* Writes the head of a block; 0 where the block cannot be carried. */
static int begin_block(struct tsb_writer* writer, uint8_t* frame, const struct tsb_block* block, uint8_t format) {
    if (block->count < 1U || block->count > tsb_block_most(block->columns, format)) return 0;
    tsb_begin(writer, frame, TSB_VERSION, TSB_DATA);
    tsb_put_u8(writer, block->stream);
    tsb_put_u8(writer, block->count);
    tsb_put_u32(writer, block->sequence);
    tsb_put_u32(writer, block->index);
    tsb_put_u64(writer, block->time_us);
    tsb_put_u32(writer, block->interval_ns);
    return 1;
}

size_t tsb_encode_int16(uint8_t* frame, const struct tsb_block* block, const int16_t* samples) {
    struct tsb_writer writer;
    size_t i;
    const size_t values = (size_t)block->count * block->columns;
    if (!begin_block(&writer, frame, block, TSB_FORMAT_INT16)) return 0;
    for (i = 0; i < values; ++i) tsb_put_u16(&writer, (uint16_t)samples[i]);
    return tsb_seal(&writer);
}

size_t tsb_encode_int32(uint8_t* frame, const struct tsb_block* block, const int32_t* samples) {
    struct tsb_writer writer;
    size_t i;
    const size_t values = (size_t)block->count * block->columns;
    if (!begin_block(&writer, frame, block, TSB_FORMAT_INT32)) return 0;
    for (i = 0; i < values; ++i) tsb_put_u32(&writer, (uint32_t)samples[i]);
    return tsb_seal(&writer);
}
