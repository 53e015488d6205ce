/* te_parts.h - what the parts of the encoder use of each other. Not for a board's own code. */
#ifndef TE_PARTS_H
#define TE_PARTS_H

#include <math.h>

#include "tactile_encoder.h"

#ifdef __cplusplus
extern "C" {
#endif

#define TE_NEVER INT64_MAX
#define TE_ALWAYS INT64_MIN
#define TE_LAST_NS (INT64_MAX / 4)
#define TE_STALE_NS INT64_C(100000000)
#define TE_ROUNDING_NS 1
#define TE_SECOND_NS INT64_C(1000000000)
#define TE_REST_NS INT64_C(8000000000) /* longer than the longest window of exposure */

/* Every comparison here is one that NaN fails. */
#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__ > 0)
#error "the encoder refuses NaN, which -ffast-math and -ffinite-math-only take away"
#endif

/* Mathematics that gives the same bits on every machine with IEEE 754 floats and no contraction, which the C library's
 * functions do not. `x` of log2 above 0; of sin 0 to pi/2. */
float te_log2(float x);
float te_exp2(float x);
float te_sin(float x);
float te_nan(void);
int te_is_number(float x); /* finite */
uint32_t te_bits(float x);
float te_seconds(int64_t ns); /* up to 2 s exactly, beyond to a millionth */
int64_t te_ns(float seconds); /* up, to a whole microsecond */

/* Spectrum (te_spectrum.c) */
void te_spectrum_init(struct te_spectrum* spectrum, float rate_hz, uint32_t length, float low_hz, float top_hz);
/* The real transform of 256 values in place: X0, X128, then real and imaginary part of X1 to X127, as CMSIS-DSP's
 * arm_rfft_fast_f32 packs them, which stands here with TE_CMSIS_DSP. `cosine`, `sine`: of 2 pi i / 256. */
void te_rfft256(float* x, const float* cosine, const float* sine);
/* Power below and in the band of roughness, both axes' sums, of the window from sample `first`. `undone`: multiplied by
 * the divisors again. */
struct te_power {
    float low, high;
};
struct te_power te_window_power(struct te_spectrum* spectrum, const struct te_acceleration* from, uint32_t axes,
                                uint32_t first, int undone);

/* Streams (te_samples.c) */
void te_streams_init(struct te_state* state);
int64_t te_known_ns(const struct te_state* state);
int64_t te_first_contact_ns(const struct te_state* state);
int64_t te_stream_begin_ns(const struct te_state* state);
struct te_press {
    float force;
    uint32_t contact, fresh;
};
struct te_press te_force_at(const struct te_force* force, int64_t t_ns);
/* Divides samples by their force up to what is known of it; with `limit`, up to that sample whatever is known. */
void te_normalise(struct te_state* state, int forced, uint32_t limit);

/* Taxels (te_taxels.c) */
void te_taxels_init(struct te_state* state);
void te_taxels_push(struct te_state* state, int64_t t_ns, const float* values);
void te_taxels_settle(struct te_state* state);
int te_taxels_ready(const struct te_state* state, int64_t t_ns);
struct te_touch {
    float v, mean;
};
struct te_touch te_taxels_at(const struct te_state* state, int64_t t_ns);

/* Frames (te_frame.c) */
void te_frames_init(struct te_state* state);
void te_pace(struct te_state* state, int64_t t_ns);

/* Whether te_stop() was called, as it is now: it may come from an interrupt. */
int te_is_stopped(const struct te_state* state);

/* Health (te_health.c) */
void te_health_init(struct te_state* state);
void te_health_sample(struct te_state* state, enum te_stream stream, int64_t t_ns, const float* raw, uint32_t columns);

/* Gate (te_gate.c) */
enum te_refusal te_profile_judge(const struct te_profile* profile);
enum te_refusal te_train_judge(const struct te_profile* profile, const struct te_gate* gate,
                               const struct te_train* train, int64_t now_ns);
void te_train_book(const struct te_profile* profile, struct te_gate* gate, const struct te_train* train,
                   int64_t now_ns);

#ifdef __cplusplus
}
#endif
#endif
