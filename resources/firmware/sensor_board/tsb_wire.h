/* tsb_wire.h - frames of the Tactoscope sensor board protocol, versions 1 and 2: CRC, COBS, little-endian
 * fields.
 *
 * The specification is PROTOCOL.md beside this file. C99, no library, no allocation, no floating-point arithmetic, no
 * division of 64-bit numbers: it compiles as it is for any microcontroller with 8-bit bytes and IEEE 754 floats.
 *
 * A frame is built in a buffer of TSB_FRAME_MOST bytes and sealed in it: the frame's content grows from byte 1 on, and
 * since content is at most 254 bytes, COBS needs exactly the byte before it. Nothing is copied.
 *
 * Thread-safety: pure functions of their arguments; usable in an interrupt.
 */
#ifndef TSB_WIRE_H
#define TSB_WIRE_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define TSB_VERSION 1U      /* of every type of frame but those that version 2 added */
#define TSB_VERSION_2 2U    /* of the frames of a board that encodes */
#define TSB_RAW_MOST 254U   /* content with its CRC, before COBS */
#define TSB_FRAME_MOST 256U /* on the wire: code byte, content, delimiter; four full-speed packets */
#define TSB_CRC_BYTES 4U
#define TSB_COLUMNS_MOST 16U
#define TSB_STREAMS_MOST 8U

/* Host to board */
enum tsb_command_type {
    TSB_HELLO = 0x01,
    TSB_GET_CONFIGURATION = 0x02,
    TSB_SET_CONFIGURATION = 0x03,
    TSB_GET_CALIBRATION = 0x04,
    TSB_START = 0x05,
    TSB_STOP = 0x06,
    TSB_GET_STATUS = 0x07,
    TSB_GET_ENCODER = 0x08, /* version 2 */
    TSB_SET_ENCODER = 0x09  /* version 2 */
};

/* Board to host */
enum tsb_reply_type {
    TSB_IDENTITY = 0x41,
    TSB_CONFIGURATION = 0x42,
    TSB_CALIBRATION = 0x44,
    TSB_DONE = 0x45,
    TSB_STATUS = 0x46,
    TSB_ENCODER = 0x47, /* version 2 */
    TSB_REFUSED = 0x4F,
    TSB_DATA = 0x50,
    TSB_READING = 0x51, /* version 2 */
    TSB_TRAIN = 0x52,   /* version 2 */
    TSB_SILENT = 0x53   /* version 2 */
};

enum tsb_kind { TSB_KIND_ACCELERATION = 0, TSB_KIND_FORCE = 1, TSB_KIND_TAXELS = 2 };
enum tsb_unit { TSB_UNIT_COUNT = 0, TSB_UNIT_METRE_PER_SECOND_SQUARED = 1, TSB_UNIT_NEWTON = 2, TSB_UNIT_PASCAL = 3 };
enum tsb_format { TSB_FORMAT_INT16 = 1, TSB_FORMAT_INT32 = 2 };
enum tsb_reason {
    TSB_REASON_UNKNOWN_COMMAND = 1,
    TSB_REASON_NO_SUCH_STREAM = 2,
    TSB_REASON_NOT_SUPPORTED = 3, /* a value that this board does not have */
    TSB_REASON_RUNNING = 4,       /* only while stopped */
    TSB_REASON_HARDWARE = 5
};

enum tsb_mode { TSB_MODE_OFF = 0, TSB_MODE_ENCODE = 1 };

#define TSB_STREAM_ENABLED 0x01U    /* flag of a configuration */
#define TSB_STREAM_CALIBRATED 0x01U /* flag of a calibration */
#define TSB_STATUS_RUNNING 0x01U    /* flag of a status */
#define TSB_READING_CONTACT 0x0001U /* flags of a reading */
#define TSB_READING_SLIDING 0x0002U
#define TSB_READING_SLIDING_ASSUMED 0x0004U /* no rest is known to tell sliding from */

/* Bytes of one value in `format`; 0 for a format that does not exist. */
size_t tsb_format_bytes(uint8_t format);

/* CRC-32/ISO-HDLC: polynomial 04C11DB7, reflected, init FFFFFFFF, final xor FFFFFFFF; "123456789" gives CBF43926.
 * 64 bytes of table, two steps a byte. */
uint32_t tsb_crc32(const uint8_t* bytes, size_t size);

/* A frame under construction. `used` counts the bytes after the one for COBS; too much sets `overflow`. */
struct tsb_writer {
    uint8_t* frame;
    uint16_t used;
    uint8_t overflow;
};

/* Begins a frame of `type` in `frame`, which has TSB_FRAME_MOST bytes. */
void tsb_begin(struct tsb_writer* writer, uint8_t* frame, uint8_t version, uint8_t type);
void tsb_put_u8(struct tsb_writer* writer, uint8_t value);
void tsb_put_u16(struct tsb_writer* writer, uint16_t value);
void tsb_put_u32(struct tsb_writer* writer, uint32_t value);
void tsb_put_u64(struct tsb_writer* writer, uint64_t value);
void tsb_put_f32(struct tsb_writer* writer, float value);
/* `text` up to its end or `size` bytes, filled with zeros to `size`. */
void tsb_put_text(struct tsb_writer* writer, const char* text, size_t size);
/* Appends the CRC, stuffs and delimits. Returns the bytes to send, at most TSB_FRAME_MOST; 0 when it did not fit. */
size_t tsb_seal(struct tsb_writer* writer);

/* Unstuffs `size` bytes in place, without their delimiter. Returns the bytes that remain, or 0 for bytes that are not
 * COBS. */
size_t tsb_unstuff(uint8_t* bytes, size_t size);

uint32_t tsb_get_u32(const uint8_t* bytes);
float tsb_get_f32(const uint8_t* bytes);

#ifdef __cplusplus
}
#endif
#endif
