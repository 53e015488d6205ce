#include "tsb_board.h"

#define HEAD 3U         /* version, type, token */
#define RECORD 10U      /* a configuration without its columns */
#define COLUMN_BYTES 8U /* scale and offset */

/* SET_CONFIGURATION after its token. Returns 0 when its length is not what its columns demand. */
static int read_configuration(const uint8_t* bytes, size_t size, struct tsb_configuration* into) {
    uint8_t i;
    if (size < RECORD) return 0;
    into->stream = bytes[0];
    into->flags = bytes[1];
    into->kind = bytes[2];
    into->unit = bytes[3];
    into->format = bytes[4];
    into->columns = bytes[5];
    into->rate_mhz = tsb_get_u32(bytes + 6);
    if (into->columns < 1U || into->columns > TSB_COLUMNS_MOST) return 0;
    if (size != RECORD + (size_t)COLUMN_BYTES * into->columns) return 0;
    for (i = 0; i < into->columns; ++i) {
        into->scale[i] = tsb_get_f32(bytes + RECORD + (size_t)COLUMN_BYTES * i);
        into->offset[i] = tsb_get_f32(bytes + RECORD + (size_t)COLUMN_BYTES * i + 4U);
    }
    return 1;
}

/* Each type of frame has the version that brought it; one that is not known here may have either. */
static int version_fits(uint8_t version, uint8_t type) {
    if (type == TSB_GET_ENCODER || type == TSB_SET_ENCODER) return version == TSB_VERSION_2;
    if (type >= TSB_HELLO && type <= TSB_GET_STATUS) return version == TSB_VERSION;
    return version == TSB_VERSION || version == TSB_VERSION_2;
}

static int read_command(const uint8_t* bytes, size_t size, struct tsb_command* command) {
    command->type = bytes[1];
    command->token = bytes[2];
    command->stream = 0;
    command->mode = TSB_MODE_OFF;
    switch (command->type) {
        case TSB_HELLO:
        case TSB_START:
        case TSB_STOP:
        case TSB_GET_STATUS:
        case TSB_GET_ENCODER:
            return size == HEAD;
        case TSB_SET_ENCODER:
            if (size != HEAD + 1U) return 0;
            command->mode = bytes[HEAD];
            return 1;
        case TSB_GET_CONFIGURATION:
        case TSB_GET_CALIBRATION:
            if (size != HEAD + 1U) return 0;
            command->stream = bytes[HEAD];
            return 1;
        case TSB_SET_CONFIGURATION:
            if (!read_configuration(bytes + HEAD, size - HEAD, &command->configuration)) return 0;
            command->stream = command->configuration.stream;
            return 1;
        default:
            return 1;
    }
}

/* The frame in `receiver`, its delimiter seen. */
static int read_frame(struct tsb_receiver* receiver, struct tsb_command* command) {
    uint8_t* const bytes = receiver->bytes;
    const size_t raw = tsb_unstuff(bytes, receiver->used);
    if (raw < HEAD + TSB_CRC_BYTES || raw > TSB_RAW_MOST) return 0;
    if (tsb_get_u32(bytes + raw - TSB_CRC_BYTES) != tsb_crc32(bytes, raw - TSB_CRC_BYTES)) return 0;
    if (!version_fits(bytes[0], bytes[1])) return 0;
    return read_command(bytes, raw - TSB_CRC_BYTES, command);
}

int tsb_receive(struct tsb_receiver* receiver, uint8_t byte, struct tsb_command* command) {
    int sound = 0;
    if (byte != 0) {
        if (receiver->used < TSB_FRAME_MOST - 1U) {
            receiver->bytes[receiver->used] = byte;
            ++receiver->used;
        } else {
            receiver->skipping = 1;
        }
        return 0;
    }
    if (receiver->skipping) {
        ++receiver->refused;
    } else if (receiver->used > 0) {
        sound = read_frame(receiver, command);
        if (!sound) ++receiver->refused;
    }
    receiver->used = 0;
    receiver->skipping = 0;
    return sound;
}
