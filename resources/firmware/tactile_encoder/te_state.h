/* te_state.h - the memory of the encoder. Included by tactile_encoder.h; its fields are the encoder's own.
 *
 * Numbers of samples count up and wrap; positions in a ring are numbers modulo its length, which is a power of two or
 * of a count that never wraps within a year.
 */
#ifndef TE_STATE_H
#define TE_STATE_H

#include <stdint.h>

#if (TE_TAXEL_HISTORY & (TE_TAXEL_HISTORY - 1U)) != 0
#error "TE_TAXEL_HISTORY is not a power of two"
#endif

struct te_window {
    uint32_t first; /* number of its first sample */
    int64_t begin_ns;
};

/* A sample's stamp while it waits for force, then the force that it was divided by. */
union te_slot {
    uint32_t stamp;
    float divisor;
};

struct te_acceleration {
    float filter[5];       /* a1, a2, gain, c1, c2 of two biquads */
    float origin[TE_AXES]; /* the sample in whose steady state the filter began */
    float z[TE_AXES][4];
    float x[TE_AXES][TE_RING];
    union te_slot slot[TE_RING];
    struct te_window windows[TE_WINDOWS];
    uint32_t window_front, window_count;
    uint32_t end, normalised; /* numbers: of the next sample, of the next to be divided */
    uint32_t next_window;
    int64_t anchor_ns, first_ns, expected_ns, last_ns;
    int32_t step_ns, hop_ns, half_ns, length_ns;
    uint32_t length, hop, hops;
    uint32_t running;
};

struct te_force {
    int64_t t_ns[TE_FORCES];
    float value[TE_FORCES];
    uint32_t contact[TE_FORCES];
    uint32_t end;
    uint32_t in_contact;
    int64_t first_contact_ns;
};

/* Means over a stretch of rest. */
struct te_rest {
    uint32_t count;
    float level[TE_TAXELS];
    float mean, squares;
};

struct te_taxels {
    int64_t t_ns[TE_TAXEL_HISTORY];
    float value[TE_TAXEL_HISTORY][TE_TAXELS];
    uint32_t end, settled;
    int64_t first_ns, valid_ns, reach_ns;
    struct te_rest before, start;
    float baseline[TE_TAXELS];
    float floor;
    uint32_t known;
};

/* Frames without acceleration: when they are due. */
struct te_pacer {
    int64_t next_ns, expected_ns, last_ns;
    int32_t step_ns, frame_ns;
    uint32_t every_sample;
};

struct te_spectrum {
    float cosine[TE_WINDOW], sine[TE_WINDOW], work[TE_WINDOW];
    uint32_t length;
    uint32_t first, rough, last; /* bins; rough > last: no feature */
    float scale;
};

/* A frame that waits for the taxels. */
struct te_pending {
    int64_t begin_ns;
    float h, mean_square, force;
    uint32_t contact, fresh;
};

struct te_index {
    float alpha;
    uint32_t started;
    float held, current;
    int64_t last_sliding_ns;
    uint32_t rest_count, rest_decided, sliding_assumed;
    float rest_mean, rest_level;
};

/* How often a value comes again, and how often another one does. */
struct te_chance {
    uint32_t repeated, changed;
};

/* Whether a value, or a block of up to TE_PERIODS, comes again and again. */
struct te_repeat {
    uint16_t sample[TE_PERIODS];     /* of each value 16 mixed bits */
    uint32_t lags[TE_PERIODS / 32U]; /* bit i: each value of this run is the one i + 1 before it */
    uint32_t seen, run;
    int64_t since_ns;
    uint32_t held;              /* how long the value stands */
    struct te_chance near, far; /* of values one and TE_PERIODS apart */
};
#define TE_WATCHED (TE_AXES + 2U) /* each axis, force, all taxels together */

struct te_command {
    float amplitude_v, interval_s;
};

struct te_series {
    struct te_command wanted, command, last, begun;
    uint32_t has_wanted, has_last, starts_again, running, has_onset;
    int64_t last_ns, begun_ns, onset_ns, due_ns, interval_ns;
};

struct te_gate {
    int64_t t_ns[TE_BOOKED]; /* by when each train has ended */
    float square[TE_BOOKED]; /* A2 s at the smallest load */
    uint32_t first, count;
    uint32_t used;
};

struct te_state {
    struct te_profile profile;
    struct te_acceleration acceleration;
    struct te_spectrum spectrum;
    struct te_force force;
    struct te_taxels taxels;
    struct te_pacer pacer;
    struct te_pending pending[TE_FRAMES];
    uint32_t pending_front, pending_count;
    struct te_index index;
    struct te_reading latest;
    int64_t newest_ns[TE_STREAMS];
    struct te_repeat repeat[TE_WATCHED];
    int64_t implausible_ns;
    struct te_series series;
    struct te_gate gate;
    uint32_t accepted, stopped;
    int64_t asked_ns, rested_ns;                   /* last te_next_train(), and the rest so far */
    uint32_t windows_lost, trains, trains_refused; /* counts, for a status */
    uint32_t refusal;                              /* te_refused() */
};

#endif
