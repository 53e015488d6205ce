#include "tsb_wire.h"

size_t tsb_format_bytes(uint8_t format) {
    if (format == TSB_FORMAT_INT16) return 2U;
    if (format == TSB_FORMAT_INT32) return 4U;
    return 0U;
}

uint32_t tsb_crc32(const uint8_t* bytes, size_t size) {
    /* Entry i: the reflected polynomial EDB88320 applied four times to i. */
    static const uint32_t table[16] = {0x00000000U, 0x1DB71064U, 0x3B6E20C8U, 0x26D930ACU, 0x76DC4190U, 0x6B6B51F4U,
                                       0x4DB26158U, 0x5005713CU, 0xEDB88320U, 0xF00F9344U, 0xD6D6A3E8U, 0xCB61B38CU,
                                       0x9B64C2B0U, 0x86D3D2D4U, 0xA00AE278U, 0xBDBDF21CU};
    uint32_t crc = 0xFFFFFFFFU;
    size_t i;
    for (i = 0; i < size; ++i) {
        crc ^= bytes[i];
        crc = (crc >> 4U) ^ table[crc & 15U];
        crc = (crc >> 4U) ^ table[crc & 15U];
    }
    return crc ^ 0xFFFFFFFFU;
}

void tsb_begin(struct tsb_writer* writer, uint8_t* frame, uint8_t version, uint8_t type) {
    writer->frame = frame;
    writer->used = 0;
    writer->overflow = 0;
    tsb_put_u8(writer, version);
    tsb_put_u8(writer, type);
}

void tsb_put_u8(struct tsb_writer* writer, uint8_t value) {
    if (writer->used >= TSB_RAW_MOST) {
        writer->overflow = 1;
        return;
    }
    ++writer->used;
    writer->frame[writer->used] = value;
}

void tsb_put_u16(struct tsb_writer* writer, uint16_t value) {
    tsb_put_u8(writer, (uint8_t)(value & 0xFFU));
    tsb_put_u8(writer, (uint8_t)((value >> 8U) & 0xFFU));
}

void tsb_put_u32(struct tsb_writer* writer, uint32_t value) {
    tsb_put_u16(writer, (uint16_t)(value & 0xFFFFU));
    tsb_put_u16(writer, (uint16_t)(value >> 16U));
}

void tsb_put_u64(struct tsb_writer* writer, uint64_t value) {
    tsb_put_u32(writer, (uint32_t)(value & 0xFFFFFFFFU));
    tsb_put_u32(writer, (uint32_t)(value >> 32U));
}

/* Reading another member than the one written gives its bytes anew (C99 with TC3, 6.5.2.3). */
union tsb_float_bits {
    float value;
    uint32_t bits;
};

void tsb_put_f32(struct tsb_writer* writer, float value) {
    union tsb_float_bits both;
    both.value = value;
    tsb_put_u32(writer, both.bits);
}

void tsb_put_text(struct tsb_writer* writer, const char* text, size_t size) {
    size_t i;
    int ended = 0;
    for (i = 0; i < size; ++i) {
        if (!ended && text[i] == '\0') ended = 1;
        tsb_put_u8(writer, ended ? (uint8_t)0 : (uint8_t)text[i]);
    }
}

size_t tsb_seal(struct tsb_writer* writer) {
    uint8_t* const frame = writer->frame;
    size_t code = 0; /* where the distance to the next zero goes */
    size_t i;
    tsb_put_u32(writer, tsb_crc32(frame + 1, writer->used));
    if (writer->overflow) return 0;
    for (i = 1; i <= writer->used; ++i) {
        if (frame[i] != 0) continue;
        frame[code] = (uint8_t)(i - code);
        code = i;
    }
    frame[code] = (uint8_t)(i - code); /* at most 255: content is at most 254 bytes */
    frame[i] = 0;
    return i + 1;
}

size_t tsb_unstuff(uint8_t* bytes, size_t size) {
    size_t from = 0;
    size_t to = 0;
    while (from < size) {
        const uint8_t code = bytes[from];
        size_t k;
        if (code == 0 || from + code > size) return 0;
        for (k = 1; k < code; ++k) {
            if (bytes[from + k] == 0) return 0;
            bytes[to++] = bytes[from + k];
        }
        from += code;
        /* A zero stood between this group and the next, unless the group was a full one. */
        if (from < size && code != 0xFFU) bytes[to++] = 0;
    }
    return to;
}

uint32_t tsb_get_u32(const uint8_t* bytes) {
    return (uint32_t)bytes[0] | ((uint32_t)bytes[1] << 8U) | ((uint32_t)bytes[2] << 16U) | ((uint32_t)bytes[3] << 24U);
}

float tsb_get_f32(const uint8_t* bytes) {
    union tsb_float_bits both;
    both.bits = tsb_get_u32(bytes);
    return both.value;
}
