/* tactile_encoder.h - Tactoscope's chain on a microcontroller: samples of a fingertip in, pulse trains out.
 *
 * Roughness R, pressure P and trains as resources/design/science.md sections 2 to 4 define them, in single precision.
 * C99, static memory; README.md says what it costs and needs. A main loop, whole:
 *
 *     if (te_init(&state, &profile) != TE_ACCEPTED) halt();
 *     if (switched_on_by_hand) te_rested(&state);
 *     for (;;) {
 *         if (block_ready) te_samples(&state, TE_ACCELERATION, first_ns, step_ns, values, count);
 *         while (te_frame(&state, &frame)) report(&frame);
 *         if (te_next_train(&state, now_ns(), &train)) {
 *             mask_interrupts();
 *             if (te_fault(&state, now_ns()) == 0) start_timer(&train);
 *             unmask_interrupts();
 *         }
 *     }
 *
 * A train is complete and finite: what plays it needs nothing more from here, so it ends by itself. No train is made
 * while a sensor is late, stands still or reads what no fingertip can, and none above the ceilings below, whatever the
 * profile says. Values are refused, never reduced; NaN is refused.
 *
 * Differences from the bench, which has more memory: there are no declared intervals of rest or contact; force that is
 * late by more than what the ring holds (64 ms at 4 kHz) is held; the load is a resistance; |Z| is the profile's. For a
 * load on a bench, not for a person: this code knows no discomfort limit, and no impedance that changes.
 *
 * Times are int64_t nanoseconds of one clock that never steps back, from 0 to 73 years. Thread-safety: a state has one
 * owner at a time; te_stop() alone may also be called from an interrupt, which then cancels the timer itself. One that
 * comes during te_init() is lost.
 */
#ifndef TACTILE_ENCODER_H
#define TACTILE_ENCODER_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define TE_LAYOUT 1U /* of struct te_profile */

/* What the memory is for. More taxels, or a history (a power of two) for a faster array, may be set when compiling, to
 * the same in every file: the profile and the state have another size then. */
#define TE_AXES 3U
#define TE_WINDOW 256U /* samples of 64 ms, so up to 4 kHz */
#define TE_RING 512U   /* filtered samples: a window, and those that wait for force */
#define TE_WINDOWS 16U /* begun and waiting */
#define TE_FRAMES 32U  /* transformed, and waiting for taxels */
#define TE_FORCES 64U
#define TE_BOOKED 128U
#define TE_BLOCK 160U  /* samples in one te_samples(): 40 ms at 4 kHz, beyond which windows are lost */
#define TE_PERIODS 64U /* samples in the longest block whose repetition is found */
#ifndef TE_TAXELS
#define TE_TAXELS 8U
#endif
#ifndef TE_TAXEL_HISTORY
#define TE_TAXEL_HISTORY 128U /* samples, 0.6 s at 200 Hz */
#endif

/* Ceilings of this program; those of a profile may be lower. Of the worst that may come out (the profile's errors), but
 * for the first, which is of the command, as the bench's gate judges it. */
#define TE_MAX_COMMAND_V 40.0F
#define TE_MAX_PEAK_MA 100.0F
#define TE_MAX_PEAK_V 500.0F /* at the largest load */
#define TE_MAX_WIDTH_US 1000.0F
#define TE_MAX_CHARGE_UC 20.0F       /* per phase */
#define TE_MAX_PULSE_HZ 1000.0F      /* within a train */
#define TE_MAX_TRAIN_S 0.5F          /* from the first edge to the last */
#define TE_MIN_INTERVAL_S 0.05F      /* from train to train */
#define TE_MAX_RMS_MA 10.0F          /* over 5 s, at the smallest load; less than this */
#define TE_MAX_RMS_500_MA 50.0F      /* over 5 s, into 500 ohm */
#define TE_AHEAD_NS INT64_C(5000000) /* a train is handed out at most this long before its onset */

enum te_stream { TE_ACCELERATION = 0, TE_FORCE = 1, TE_TAXEL_ARRAY = 2, TE_STREAMS = 3 };
enum te_curve { TE_LINEAR = 0, TE_LOGARITHMIC = 1, TE_POWER = 2 };
enum te_shape { TE_SYMMETRIC = 0, TE_ASYMMETRIC = 1, TE_MONOPHASIC = 2 };

/* Everything that a laboratory chooses, in words of 32 bits, so that its bytes are the same on every little-endian
 * machine. `tactoscope-cli firmware-profile` writes one. A rate of 0: that stream is not there. */
struct te_profile {
    uint32_t layout; /* TE_LAYOUT */
    uint32_t hash;   /* te_hash() */

    float acceleration_hz;   /* 99 to 4007 */
    uint32_t axes;           /* 1 to TE_AXES */
    float acceleration_most; /* a reading beyond it is a fault: 5000 m/s2 (science.md section 1) */
    float force_hz;          /* 20 to 300; without acceleration 1 to 300 */
    float force_scale;       /* N per unit of a reading, above 0 or below */
    float force_offset;      /* N */
    float force_most;        /* N, after scaling */
    uint32_t force_newton;   /* 1: the scaled force is in N and gives a pressure; 0: it is in counts */
    float taxels_hz;         /* 1 to TE_TAXEL_HISTORY / 0.5 s */
    uint32_t taxels;         /* 2 to TE_TAXELS */
    float taxels_most;       /* Pa, after scaling */
    uint32_t taxels_pascal;  /* 1: their mean is a pressure where there is no force; 0: they are in counts */

    uint32_t spectral_absolute; /* 0: h, 1: h_abs */
    uint32_t taxel_dynamic;     /* 0: static, 1: dynamic */
    float band_low_hz;
    float spectral_weight, taxel_weight;
    float spectral_smooth, spectral_rough; /* the chosen feature's references */
    float taxel_smooth, taxel_rough;
    float smoothing_s;
    float rest_mean_square; /* 0: not known */
    float contact_area_cm2;
    float pressure_min_pa, pressure_max_pa;

    float amplitude_min_v, amplitude_max_v;
    float interval_min_s, interval_max_s;
    uint32_t amplitude_curve, interval_curve; /* enum te_curve */
    float amplitude_beta, interval_beta;
    uint32_t swapped;         /* 1: P gives the amplitude, R the interval */
    float amplitude_ratio;    /* largest step from train to train; 0: no limit */
    float interval_ratio;     /* 0: no limit */
    float amplitude_slew_v_s; /* 0: no limit */

    uint32_t shape;    /* enum te_shape */
    uint32_t negative; /* 1: the leading phase is negative */
    float width_us, gap_us;
    float recharge_ratio; /* of TE_ASYMMETRIC, above 1 */
    uint32_t pulses;
    float pulse_hz;

    uint32_t current_source; /* 0: amplitudes in V; 1: in mA, A / load_ohm */
    float load_low_ohm, load_ohm, load_high_ohm;
    float output_step;                                              /* V or mA; 0: continuous */
    float output_max;                                               /* V or mA */
    float amplitude_error, width_error, interval_error, rate_error; /* relative, either way; width: the gap's too */

    float ceiling_peak_ma, ceiling_charge_uc, ceiling_rms_ma; /* at most those above */

    float taxel_scale[TE_TAXELS]; /* Pa per unit of a reading */
    float taxel_offset[TE_TAXELS];
};

/* One moment of the finger. NaN: absent. */
struct te_reading {
    int64_t t_ns; /* the middle of its window */
    uint32_t contact, sliding;
    uint32_t sliding_assumed; /* there is no rest to tell sliding from, as the bench's flag says */
    float h, v, R, pressure_pa, P;
};

struct te_train {
    int64_t onset_ns; /* now, or at most TE_AHEAD_NS later */
    float interval_s; /* to the next onset as commanded; the next may come sooner if pressure rises */
    float command_v;  /* A of science.md section 4 */
    float amplitude;  /* V, or mA of a current source, on the device's step */
    uint32_t shape, negative;
    float width_us, gap_us, recharge_ratio;
    uint32_t pulses;
    float pulse_hz;
};

/* Why a profile or a train is refused. */
enum te_refusal {
    TE_ACCEPTED = 0,
    TE_BAD_LAYOUT,
    TE_BAD_HASH,
    TE_BAD_STREAM,
    TE_BAD_ROUGHNESS,
    TE_BAD_ENCODING,
    TE_BAD_TRAIN,
    TE_BAD_OUTPUT,
    TE_BAD_CEILING,
    TE_ABOVE_COMMAND,
    TE_ABOVE_OUTPUT, /* the device's largest, or a step too coarse for this amplitude */
    TE_ABOVE_PEAK,
    TE_ABOVE_CHARGE,
    TE_ABOVE_WIDTH,
    TE_ABOVE_RATE,
    TE_ABOVE_DURATION,
    TE_ABOVE_RMS,
    TE_METER /* full, or the clock went back */
};

/* Why there is no train, as bits. */
#define TE_FAULT_STOPPED 1U /* te_stop() */
#define TE_FAULT_STALE 2U   /* a stream or the newest frame is older than 100 ms (a frame, by its own delay more) */
#define TE_FAULT_FUTURE 4U  /* a stamp lies more than 100 ms ahead */
/* An axis of acceleration repeats itself, or an array of four taxels or more that is touched does as a whole, or all of
 * force and taxels where there is no acceleration. Force that stands still, or some taxels of an array, is no fault. */
#define TE_FAULT_STUCK 8U
#define TE_FAULT_IMPLAUSIBLE 16U /* within 100 ms a reading was not a number, or no fingertip's */
#define TE_FAULT_RESTING 64U     /* what came out before te_init() is not known: 8 s of calls of te_next_train() */
#define TE_FAULT_PROFILE 32U     /* te_init() refused, or was not called: so for zeroed memory */

#include "te_state.h"

/* The CRC-32 (as zlib's) of the profile's bytes after `hash`, of its taxels' scales and offsets those in use. So it is
 * the same where memory for more taxels is set aside. */
uint32_t te_hash(const struct te_profile* profile);

/* Reads what `firmware-profile --out FILE.bin` wrote: the words of struct te_profile, of the taxels those in use. */
enum te_refusal te_read_profile(struct te_profile* profile, const uint8_t* bytes, uint32_t size);

/* Begins, with everything forgotten. After anything but TE_ACCEPTED the state makes no train. `profile` lies outside
 * `state`, whose own copy is cleared first. */
enum te_refusal te_init(struct te_state* state, const struct te_profile* profile);

/* Takes `count` samples, `step_ns` apart, one value per axis or taxel. Returns how many were taken: all, or none of a
 * stream that the profile does not have, of a time that is none, or of more than TE_BLOCK. */
uint32_t te_samples(struct te_state* state, enum te_stream stream, int64_t first_ns, int32_t step_ns,
                    const float* values, uint32_t count);

/* Gives the next frame that is complete; 0 when there is none. To be asked after each te_samples(): windows that nobody
 * takes are lost. */
int te_frame(struct te_state* state, struct te_reading* frame);

/* Gives a train that is due, once; 0 when there is none. */
int te_next_train(struct te_state* state, int64_t now_ns, struct te_train* train);

/* Says that nothing came out in the last 8 s, which only the board can know: after te_init() there is no rest then. Not
 * after a reset that it cannot explain. */
void te_rested(struct te_state* state);

/* Ends all output until the next te_init(). The board cancels a train that it has not begun. */
void te_stop(struct te_state* state);

/* The bits above; 0 while trains may come. */
uint32_t te_fault(const struct te_state* state, int64_t now_ns);

/* Why the train that was due last was refused; TE_ACCEPTED where it was handed out, and while none is due. */
enum te_refusal te_refused(const struct te_state* state);

#ifdef __cplusplus
}
#endif
#endif
