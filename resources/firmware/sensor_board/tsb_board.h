/* tsb_board.h - what a board says and hears: encoders for its frames, a decoder for the host's commands.
 *
 * A firmware's main loop, whole:
 *
 *     while (uart_or_usb_has(&byte)) if (tsb_receive(&receiver, byte, &command)) answer(&command);
 *     if (samples_ready) send(frame, tsb_encode_int16(frame, &block, samples));
 *
 * Every encoder fills `frame` (TSB_FRAME_MOST bytes) and returns the bytes to send, or 0 for what the protocol cannot
 * carry (too many columns, an empty block, more than fits); nothing is ever cut off.
 *
 * Thread-safety: a struct has one owner at a time; the functions are pure otherwise.
 */
#ifndef TSB_BOARD_H
#define TSB_BOARD_H

#include "tsb_wire.h"

#ifdef __cplusplus
extern "C" {
#endif

#define TSB_NAME_BYTES 24U
#define TSB_SERIAL_BYTES 16U
#define TSB_FIRMWARE_BYTES 16U
#define TSB_DATE_BYTES 10U
#define TSB_REFERENCE_BYTES 24U

/* Texts are printable ASCII; longer ones are cut to the field. */
struct tsb_identity {
    uint8_t lowest_version; /* of the protocol, that this board speaks */
    uint8_t highest_version;
    uint8_t streams; /* 1 to TSB_STREAMS_MOST; they are numbered from 0 */
    const char* name;
    const char* serial;
    const char* firmware;
};

/* One stream. A sample's value in `unit` is scale[column] * raw + offset[column]. */
struct tsb_configuration {
    uint8_t stream;
    uint8_t flags;     /* TSB_STREAM_ENABLED */
    uint8_t kind;      /* enum tsb_kind */
    uint8_t unit;      /* enum tsb_unit */
    uint8_t format;    /* enum tsb_format */
    uint8_t columns;   /* 1 to TSB_COLUMNS_MOST */
    uint32_t rate_mhz; /* samples per second, in thousandths */
    float scale[TSB_COLUMNS_MOST];
    float offset[TSB_COLUMNS_MOST];
};

struct tsb_calibration {
    uint8_t stream;
    uint8_t flags; /* TSB_STREAM_CALIBRATED */
    uint8_t columns;
    const char* date;                    /* "2026-11-20", or "" */
    const char* reference;               /* certificate or procedure, or "" */
    float uncertainty[TSB_COLUMNS_MOST]; /* of the scale, relative, standard (k = 1) */
};

struct tsb_status {
    uint8_t flags;           /* TSB_STATUS_RUNNING */
    uint8_t faulty_streams;  /* bit i: the sensor of stream i does not answer */
    uint64_t time_us;        /* since power-up, when this was written */
    uint32_t samples_lost;   /* that a sensor made and the board could not fetch, since START */
    uint32_t blocks_dropped; /* made, and thrown away because the host did not read, since START */
    uint32_t frames_refused; /* from the host: bad CRC, length or stuffing, since power-up */
};

/* Consecutive samples of one stream. */
struct tsb_block {
    uint8_t stream;
    uint8_t count; /* samples in this block, at least 1 */
    uint8_t columns;
    uint32_t sequence;    /* blocks of this stream since START, from 0, also those thrown away */
    uint32_t index;       /* samples of this stream since START, from 0, also those lost: of the first in here */
    uint64_t time_us;     /* since power-up: of the first sample in here */
    uint32_t interval_ns; /* between samples in here, as measured; nominal where the board itself triggers them */
};

/* What encodes in this board; `layout`, `hash` and the refusals are those of tactile_encoder.h beside this folder. */
struct tsb_encoder {
    uint8_t mode;    /* enum tsb_mode, as it is from the next START on */
    uint8_t refusal; /* enum te_refusal: why te_init() refuses the profile in this board; 0: accepted */
    uint32_t layout; /* TE_LAYOUT */
    uint32_t hash;   /* of the profile in this board */
};

/* One frame of the encoder. NaN: absent. */
struct tsb_reading {
    uint32_t sequence; /* readings since START, from 0, also those thrown away */
    uint64_t time_us;  /* since power-up: the middle of its window */
    uint16_t flags;    /* TSB_READING_... */
    uint32_t faults;   /* te_fault() when this was written */
    float roughness;   /* R */
    float pressure;    /* P */
    float pressure_pa;
    float h, v; /* the spectral and the spatial feature */
};

/* One train that the encoder's gate let pass. */
struct tsb_train {
    uint32_t sequence; /* trains since START, from 0, also those thrown away */
    uint64_t onset_us; /* since power-up */
    float interval_s;
    float command_v;
    float amplitude;  /* V, or mA of a current source */
    uint8_t shape;    /* enum te_shape */
    uint8_t negative; /* 1: the leading phase is negative */
    float width_us, gap_us, recharge_ratio;
    uint32_t pulses;
    float pulse_hz;
    uint16_t ahead_us; /* from when the encoder made it to its onset */
};

/* Why no train comes, whenever that changes and for each train refused; faults 0 and refusal 0: nothing keeps them
 * back. */
struct tsb_silence {
    uint32_t sequence; /* of these since START, from 0, also those thrown away */
    uint64_t time_us;  /* since power-up, when the encoder was asked */
    uint32_t faults;   /* te_fault() */
    uint8_t refusal;   /* enum te_refusal of the train that was due and refused; 0: none */
};

size_t tsb_encode_identity(uint8_t* frame, uint8_t token, const struct tsb_identity* identity);
size_t tsb_encode_configuration(uint8_t* frame, uint8_t token, const struct tsb_configuration* configuration);
size_t tsb_encode_calibration(uint8_t* frame, uint8_t token, const struct tsb_calibration* calibration);
size_t tsb_encode_done(uint8_t* frame, uint8_t token, uint8_t command, uint64_t time_us);
/* `token` 0: not asked for. */
size_t tsb_encode_status(uint8_t* frame, uint8_t token, const struct tsb_status* status);
size_t tsb_encode_refused(uint8_t* frame, uint8_t token, uint8_t command, uint8_t reason);
/* `samples`: count * columns values, sample after sample. */
size_t tsb_encode_int16(uint8_t* frame, const struct tsb_block* block, const int16_t* samples);
size_t tsb_encode_int32(uint8_t* frame, const struct tsb_block* block, const int32_t* samples);
size_t tsb_encode_encoder(uint8_t* frame, uint8_t token, const struct tsb_encoder* encoder);
size_t tsb_encode_reading(uint8_t* frame, const struct tsb_reading* reading);
size_t tsb_encode_train(uint8_t* frame, const struct tsb_train* train);
size_t tsb_encode_silence(uint8_t* frame, const struct tsb_silence* silence);
/* How many samples fit into one block; 0 for what no block can carry. */
uint8_t tsb_block_most(uint8_t columns, uint8_t format);

/* A command. `stream` of those that name one; `mode` of TSB_SET_ENCODER; `configuration` of TSB_SET_CONFIGURATION. A
 * type that is not known here is handed over too, so that it can be refused; so is TSB_GET_ENCODER to a board without
 * an encoder, which answers TSB_REASON_UNKNOWN_COMMAND. */
struct tsb_command {
    uint8_t type;
    uint8_t token;
    uint8_t stream;
    uint8_t mode; /* enum tsb_mode, or a number that is none */
    struct tsb_configuration configuration;
};

/* Bytes from the host on their way to a command. Zero it before first use: struct tsb_receiver r = {0}; */
struct tsb_receiver {
    uint8_t bytes[TSB_FRAME_MOST];
    uint16_t used;
    uint8_t skipping; /* too long already: wait for the delimiter */
    uint32_t refused; /* for tsb_status */
};

/* Takes one byte. Returns 1 when it completed a sound command, which is then in `command`; else 0. */
int tsb_receive(struct tsb_receiver* receiver, uint8_t byte, struct tsb_command* command);

#ifdef __cplusplus
}
#endif
#endif
