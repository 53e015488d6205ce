/* tactile_board.h - a whole board: what its sensors give goes to a host by the sensor board protocol, and through the
 * tactile encoder to a stimulator.
 *
 * The board's maker fills in the five functions of struct tb_hardware. A program, whole:
 *
 *     stimulator_off();
 *     if (!tb_init(&board, &setup, &hardware)) halt();
 *     for (;;) tb_step(&board);
 *
 * Either the host plays or the board does, never both. Once a host has said anything that is sound, the board plays
 * nothing until its power was off: it sends the trains, and the host judges and plays them. A board that is to stand
 * `alone` plays its own until then. What was heard and stopped lies in RAM, so `alone` and `rested` are for a power-on
 * only: after any other reset (watchdog, button, debugger) the program clears both in its setup before tb_init().
 *
 * C99, static memory, nothing called but the encoder, the protocol and the five functions; sizeof(struct tb_board) is
 * what it needs. Times are those of the board's clock, in us since power-up. Thread-safety: one owner; tb_stop() alone
 * may be called from an interrupt.
 */
#ifndef TACTILE_BOARD_H
#define TACTILE_BOARD_H

#include "../sensor_board/tsb_board.h"
#include "../tactile_encoder/tactile_encoder.h"

#ifdef __cplusplus
extern "C" {
#endif

#define TB_STREAMS 3U        /* one of each kind */
#define TB_VALUES 113U       /* in one block: what a frame carries as int16 */
#define TB_STEP_US 2000U     /* from one question for a train to the next, at least */
#define TB_SILENT_US 100000U /* a stream that says nothing for so long is called faulty */
#define TB_PULLED_US 50000U  /* a column that reads nothing sound for so long is pulled out */

/* Consecutive samples of one stream, as its converter gives them. They should span at most 10 ms. */
struct tb_samples {
    uint8_t stream;       /* its place in struct tb_setup */
    uint8_t count;        /* at least 1; count * columns at most TB_VALUES */
    uint32_t lost;        /* samples that the sensor made before these and that could not be fetched */
    uint64_t first_us;    /* when the first was taken */
    uint32_t interval_ns; /* between them, as measured; nominal where a timer of the board triggers them */
    int32_t raw[TB_VALUES];
};

/* What the board's maker writes. None of them waits; `context` is handed to each. */
struct tb_hardware {
    void* context;
    /* The time since power-up. Never goes back. */
    uint64_t (*now_us)(void* context);
    /* Fills in the oldest samples that were not read yet and returns 1; 0 where there are none. */
    int (*read)(void* context, struct tb_samples* samples);
    /* Moves up to `most` bytes from the host into `bytes`; returns how many. */
    size_t (*hear)(void* context, uint8_t* bytes, size_t most);
    /* Takes all of a frame for the host, or nothing: returns 1, or 0 where there is no room. */
    int (*say)(void* context, const uint8_t* frame, size_t size);
    /* Prepares a timer that plays `train` from train->onset_ns on, or at once where that has passed, and ends it while
     * the program's interrupts run, even if its loop hangs; where both hang, a watchdog ends it within 0.2 s. Returns
     * 1, or 0 where it cannot. With a null pointer: ends all output now. It is then also called from tb_stop(). Null
     * where the board has no stimulator. */
    int (*play)(void* context, const struct te_train* train);
};

/* What the columns of a stream read while their sensor is plugged in. Beyond it lie the ends of the converter, with
 * the noise of an input that is open or shorted: { 8, 4087 } of 12 bits. A sensor that reads 0 at rest has `low` 0.
 * Both 0: all but the ends of the stream's format. */
struct tb_range {
    int32_t low, high;
};

/* What a board is. Lies where it stays. */
struct tb_setup {
    const char *name, *serial, *firmware;
    uint8_t streams; /* 1 to TB_STREAMS */
    struct tsb_configuration configuration[TB_STREAMS];
    struct tsb_calibration calibration[TB_STREAMS];
    struct tb_range range[TB_STREAMS];
    const struct te_profile* profile; /* null: the board does not encode */
    uint8_t alone;                    /* 1: it plays until it hears a host. After a power-on only */
    uint8_t rested; /* 1: nothing came out in the 8 s before tb_init(), as te_rested(). After a power-on only */
};

/* Its fields are the board's own but for `unsaved`. */
struct tb_board {
    const struct tb_setup* setup;
    const struct tb_hardware* hardware;
    struct tsb_configuration configuration[TB_STREAMS];
    uint32_t unsaved; /* bit i: configuration[i] was changed by the host, and is to survive power-off */
    struct tsb_receiver receiver;
    struct te_state encoder;
    struct tb_samples samples;
    float values[TB_VALUES];
    uint8_t frame[TSB_FRAME_MOST];
    uint32_t sequence[TB_STREAMS], index[TB_STREAMS];
    uint64_t heard_us[TB_STREAMS];                   /* when a stream gave its newest block */
    uint64_t sound_us[TB_STREAMS][TSB_COLUMNS_MOST]; /* and each column its newest reading within its range */
    uint32_t readings, trains, silences;
    uint32_t faults, refusal, refused; /* that the host was told */
    uint32_t samples_lost, blocks_dropped;
    uint64_t asked_us, status_us, quiet_us;
    uint8_t running, alone, mode, told, rested;
    uint8_t profile_refusal, uncalibrated; /* bit i: the scale of stream i is not that of its calibration */
    uint32_t stopped;
};

/* Begins: output off, nothing known of the finger. Returns 0 for a setup that no board can be: no stream or too many,
 * two of a kind, a range without a reading, or columns, rates or scales that the protocol does not have. A profile that
 * the encoder refuses only keeps the board from encoding. `setup` and `hardware` outlive the board. */
int tb_init(struct tb_board* board, const struct tb_setup* setup, const struct tb_hardware* hardware);

/* Once round the main loop: hears, reads, encodes, says and plays. A block in which a column is pulled out is neither
 * encoded nor said: its samples are lost, to the host as to the encoder. To be called every 2 ms or more often; a
 * frame's transforms take some 80 000 instructions. */
void tb_step(struct tb_board* board);

/* Ends all output: until the next START of a host, and of a board that stands alone until power-off. */
void tb_stop(struct tb_board* board);

#ifdef __cplusplus
}
#endif
#endif
