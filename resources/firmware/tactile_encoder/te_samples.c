/* The streams: acceleration band-passed and divided by force, force with its contact, taxels handed on. */
#include <stddef.h>

#include "te_parts.h"

#define PI 3.14159265F
#define CONTACT_BEGINS_N 0.1F
#define CONTACT_ENDS_N 0.05F
#define SMALLEST_DIVISOR_N 0.1F

/* Butterworth, order 2 per edge: a pole pair near each edge. The lower one is found from the product of both, because
 * their difference would lose its digits. */
static void design(float* filter, float rate_hz, float top_hz) {
    const float twice = 2.0F * rate_hz;
    const float low_angle = PI * 5.0F / rate_hz;
    const float high_angle = PI * top_hz / rate_hz;
    const float low = twice * te_sin(low_angle) / te_sin(0.5F * PI - low_angle);
    const float high = twice * te_sin(high_angle) / te_sin(0.5F * PI - high_angle);
    const float band = high - low;
    const float product = low * high;
    /* half +- root: half = band/2 e^(i 3 pi/4), root^2 = half^2 - product */
    const float half = 0.353553391F * band;
    const float square_im = -2.0F * half * half;
    const float size = sqrtf(product * product + square_im * square_im);
    const float root_im = sqrtf(0.5F * (size + product));
    const float root_re = 0.5F * square_im / root_im;
    const float far_re = -half + root_re;
    const float far_im = half + root_im;
    const float far2 = far_re * far_re + far_im * far_im;
    const float poles[2][2] = {{product * far_re / far2, -product * far_im / far2}, {far_re, far_im}};
    float gain = band * band * twice * twice;
    uint32_t i;
    for (i = 0; i < 2U; ++i) {
        const float re = poles[i][0];
        const float im = poles[i][1];
        const float size2 = (twice - re) * (twice - re) + im * im;
        /* (twice + p) / (twice - p) */
        const float pole_re = (twice * twice - re * re - im * im) / size2;
        const float pole_im = 2.0F * twice * im / size2;
        filter[3U * (size_t)i] = -2.0F * pole_re;
        filter[3U * i + 1U] = pole_re * pole_re + pole_im * pole_im;
        gain /= size2;
    }
    filter[2] = gain;
}

void te_streams_init(struct te_state* state) {
    struct te_acceleration* const a = &state->acceleration;
    const float rate = state->profile.acceleration_hz;
    state->force.first_contact_ns = state->profile.force_hz > 0.0F ? TE_NEVER : TE_ALWAYS;
    a->first_ns = TE_NEVER;
    a->last_ns = TE_ALWAYS;
    if (!(rate > 0.0F)) return;
    a->length = (uint32_t)(0.064F * rate + 0.5F);
    a->hop = (uint32_t)(0.016F * rate + 0.5F);
    a->step_ns = (int32_t)(1e9F / rate + 0.5F);
    a->hop_ns = (int32_t)((float)a->hop * 1e9F / rate + 0.5F);
    a->half_ns = (int32_t)(0.5F * (float)a->length * 1e9F / rate + 0.5F);
    a->length_ns = (int32_t)((float)(a->length - 1U) * 1e9F / rate + 0.5F);
    {
        const float top = rate < 2000.0F / 0.9F ? 0.45F * rate : 1000.0F;
        design(a->filter, rate, top);
        te_spectrum_init(&state->spectrum, rate, a->length, state->profile.band_low_hz, top);
    }
}

int64_t te_stream_begin_ns(const struct te_state* state) { return state->acceleration.first_ns; }

int64_t te_first_contact_ns(const struct te_state* state) { return state->force.first_contact_ns; }

int64_t te_known_ns(const struct te_state* state) {
    const struct te_force* const force = &state->force;
    if (!(state->profile.force_hz > 0.0F)) return TE_NEVER;
    return force->end == 0U ? TE_ALWAYS : force->t_ns[(force->end - 1U) % TE_FORCES];
}

/* Force --------------------------------------------------------------------------------------------------------- */

static uint32_t oldest_force(const struct te_force* force) {
    return force->end > TE_FORCES ? force->end - TE_FORCES : 0U;
}

/* The number of the last sample at or before t; of the first where all are later. There is one. */
static uint32_t force_before(const struct te_force* force, int64_t t_ns) {
    uint32_t i = force->end - 1U;
    while (i > oldest_force(force) && force->t_ns[i % TE_FORCES] > t_ns) --i;
    return i;
}

static void push_force(struct te_state* state, int64_t t_ns, float newton) {
    struct te_force* const force = &state->force;
    const uint32_t at = force->end % TE_FORCES;
    if (!(fabsf(newton) <= state->profile.force_most)) return;
    if (force->end > 0U) {
        const int64_t before = te_known_ns(state);
        if (t_ns <= before) return;
        if (t_ns - before > TE_STALE_NS + TE_ROUNDING_NS) force->in_contact = 0U;
    }
    force->in_contact = force->in_contact ? !(newton < CONTACT_ENDS_N) : newton >= CONTACT_BEGINS_N;
    if (force->in_contact && force->first_contact_ns == TE_NEVER) force->first_contact_ns = t_ns;
    force->t_ns[at] = t_ns;
    force->value[at] = newton;
    force->contact[at] = force->in_contact;
    ++force->end;
    if (force->end == 0U) force->end = TE_FORCES; /* numbers begin anew, in the same places */
}

/* Force as a straight line from a sample to the next; `slope` per second. */
struct line {
    int64_t from_ns, until_ns;
    float force, slope;
};

static struct line line_at(const struct te_force* force, int64_t t_ns, int64_t start_ns) {
    struct line line = {0, TE_NEVER, 0.0F, 0.0F};
    uint32_t i;
    if (force->end == 0U) return line;
    i = force_before(force, t_ns);
    line.from_ns = force->t_ns[i % TE_FORCES];
    line.force = force->value[i % TE_FORCES];
    if (t_ns < line.from_ns) {
        if (line.from_ns - start_ns > TE_SECOND_NS) line.force = 0.0F;
        line.until_ns = line.from_ns;
    } else if (i + 1U != force->end) {
        const uint32_t next = (i + 1U) % TE_FORCES;
        line.until_ns = force->t_ns[next];
        if (line.until_ns - line.from_ns <= TE_SECOND_NS) {
            line.slope = (force->value[next] - line.force) / te_seconds(line.until_ns - line.from_ns);
        }
    }
    return line;
}

static float force_on(const struct line* line, int64_t t_ns) {
    return line->slope == 0.0F ? line->force : line->slope * te_seconds(t_ns - line->from_ns) + line->force;
}

struct te_press te_force_at(const struct te_force* force, int64_t t_ns) {
    struct te_press reading = {0.0F, 0U, 0U};
    struct line line;
    reading.force = te_nan();
    if (force->end == 0U) return reading;
    line = line_at(force, t_ns, TE_ALWAYS / 2);
    if (t_ns < line.from_ns) {
        reading.force = force->value[oldest_force(force) % TE_FORCES];
        return reading;
    }
    reading.force = force_on(&line, t_ns);
    reading.fresh = t_ns - line.from_ns <= TE_STALE_NS + TE_ROUNDING_NS;
    reading.contact = reading.fresh && force->contact[force_before(force, t_ns) % TE_FORCES];
    return reading;
}

/* Acceleration -------------------------------------------------------------------------------------------------- */

static void divide(struct te_state* state, uint32_t number, const struct line* line, int64_t t_ns) {
    struct te_acceleration* const a = &state->acceleration;
    const uint32_t at = number % TE_RING;
    float divisor = force_on(line, t_ns);
    float factor;
    uint32_t axis;
    if (!(divisor > SMALLEST_DIVISOR_N)) divisor = SMALLEST_DIVISOR_N;
    factor = 1.0F / divisor;
    for (axis = 0; axis < state->profile.axes; ++axis) a->x[axis][at] *= factor;
    a->slot[at].divisor = divisor;
}

void te_normalise(struct te_state* state, int forced, uint32_t limit) {
    struct te_acceleration* const a = &state->acceleration;
    const int64_t known = forced ? TE_NEVER : te_known_ns(state);
    struct line line = {0, TE_ALWAYS, 0.0F, 0.0F};
    if (!(state->profile.force_hz > 0.0F)) {
        a->normalised = a->end;
        return;
    }
    if (a->window_count > 0U && (int32_t)(a->windows[a->window_front].first - a->normalised) > 0) {
        a->normalised = a->windows[a->window_front].first;
    }
    while (a->normalised != a->end && (!forced || a->normalised != limit)) {
        const uint32_t stamp = a->slot[a->normalised % TE_RING].stamp;
        const int64_t t_ns = a->last_ns - (int64_t)(uint32_t)((uint32_t)a->last_ns - stamp);
        if (t_ns > known) return;
        if (t_ns >= line.until_ns) line = line_at(&state->force, t_ns, a->first_ns);
        divide(state, a->normalised, &line, t_ns);
        ++a->normalised;
    }
}

static void filter_sample(struct te_state* state, const float* sample) {
    struct te_acceleration* const a = &state->acceleration;
    const float* const f = a->filter;
    uint32_t axis;
    for (axis = 0; axis < state->profile.axes; ++axis) {
        float* const z = a->z[axis];
        const float x = sample[axis] - a->origin[axis]; /* NOLINT(clang-analyzer-core*): it has all axes */
        const float high = x + z[0];
        const float scaled = f[2] * high;
        const float low = scaled + z[2];
        z[0] = z[1] - (x + x) - f[0] * high;
        z[1] = x - f[1] * high;
        z[2] = z[3] + (scaled + scaled) - f[3] * low;
        z[3] = scaled - f[4] * low;
        a->x[axis][a->end % TE_RING] = low;
    }
}

/* A window begins at the sample that comes now, stamped `t_ns`. The nominal rate drifts from the real clock, so the
 * time is taken from the stamps again where both are a sample apart. */
static void begin_window(struct te_state* state, int64_t t_ns) {
    struct te_acceleration* const a = &state->acceleration;
    struct te_window* window;
    int64_t begin_ns = a->anchor_ns + (int64_t)a->hops * a->hop_ns;
    if (begin_ns - t_ns > a->step_ns || t_ns - begin_ns > a->step_ns) {
        begin_ns = a->anchor_ns = t_ns;
        a->hops = 0U;
    }
    if (a->window_count == TE_WINDOWS) {
        a->window_front = (a->window_front + 1U) % TE_WINDOWS;
        --a->window_count;
        ++state->windows_lost;
    }
    window = &a->windows[(a->window_front + a->window_count) % TE_WINDOWS];
    window->first = a->end;
    window->begin_ns = begin_ns;
    ++a->window_count;
    ++a->hops;
    a->next_window += a->hop;
}

/* Starts again, after a gap or a value that is not one: the windows begun so far will not be whole. */
static void restart(struct te_state* state, int64_t t_ns, const float* sample) {
    struct te_acceleration* const a = &state->acceleration;
    uint32_t axis;
    uint32_t i;
    for (axis = 0; axis < state->profile.axes; ++axis) {
        a->origin[axis] = sample[axis];
        for (i = 0; i < 4U; ++i) a->z[axis][i] = 0.0F;
    }
    while (a->window_count > 0U) {
        const struct te_window* const last = &a->windows[(a->window_front + a->window_count - 1U) % TE_WINDOWS];
        if (a->end - last->first >= a->length) break;
        --a->window_count;
    }
    if (a->first_ns == TE_NEVER) a->first_ns = t_ns;
    a->next_window = a->end;
    a->anchor_ns = t_ns;
    a->hops = 0U;
    a->running = 1U;
}

/* Where the ring is full, the oldest window goes: nobody took it in time. */
static void make_room(struct te_state* state) {
    struct te_acceleration* const a = &state->acceleration;
    if (a->window_count == 0U || a->end - a->windows[a->window_front].first < TE_RING) return;
    a->window_front = (a->window_front + 1U) % TE_WINDOWS;
    --a->window_count;
    ++state->windows_lost;
}

static int plausible(const float* sample, uint32_t columns, float most) {
    uint32_t i;
    for (i = 0; i < columns; ++i) {
        if (!(fabsf(sample[i]) <= most)) return 0; /* NOLINT(clang-analyzer-core*): scale() has set it */
    }
    return 1;
}

/* 1: the sample comes where the grid expects it; 0: somewhere else, but later than the one before; -1: not to be used.
 * The grid follows the stamps slowly. */
static int place(struct te_acceleration* a, int64_t t_ns) {
    const int64_t late = t_ns - a->expected_ns;
    if (a->last_ns != TE_ALWAYS) {
        if (t_ns < a->last_ns) a->running = 0U;
        if (t_ns <= a->last_ns) return -1;
        if (late < a->step_ns / 2 && -late < a->step_ns / 2) {
            a->last_ns = t_ns;
            a->expected_ns += a->step_ns + (int32_t)late / 20;
            return 1;
        }
    }
    a->last_ns = t_ns;
    a->expected_ns = t_ns + a->step_ns;
    return 0;
}

static void push_acceleration(struct te_state* state, int64_t t_ns, const float* sample) {
    struct te_acceleration* const a = &state->acceleration;
    const int regular = place(a, t_ns);
    if (regular < 0) return;
    if (!plausible(sample, state->profile.axes, state->profile.acceleration_most)) {
        a->running = 0U;
        return;
    }
    if (!regular || !a->running) restart(state, t_ns, sample);
    make_room(state);
    if (a->end == a->next_window) begin_window(state, t_ns);
    filter_sample(state, sample);
    a->slot[a->end % TE_RING].stamp = (uint32_t)t_ns;
    ++a->end;
}

/* Any stream ---------------------------------------------------------------------------------------------------- */

static uint32_t columns_of(const struct te_profile* profile, enum te_stream stream) {
    switch (stream) {
        case TE_ACCELERATION:
            return profile->acceleration_hz > 0.0F ? profile->axes : 0U;
        case TE_FORCE:
            return profile->force_hz > 0.0F ? 1U : 0U;
        case TE_TAXEL_ARRAY:
            return profile->taxels_hz > 0.0F ? profile->taxels : 0U;
        case TE_STREAMS:
            break;
    }
    return 0U;
}

/* A reading in the unit in use; acceleration needs no scale. */
static void scale(const struct te_profile* profile, enum te_stream stream, const float* raw, uint32_t columns,
                  float* into) {
    uint32_t i;
    for (i = 0; i < columns; ++i) {
        into[i] = raw[i];
        if (stream == TE_FORCE) into[i] = profile->force_scale * raw[i] + profile->force_offset;
        if (stream == TE_TAXEL_ARRAY) into[i] = profile->taxel_scale[i] * raw[i] + profile->taxel_offset[i];
    }
}

static float most_of(const struct te_profile* profile, enum te_stream stream) {
    if (stream == TE_ACCELERATION) return profile->acceleration_most;
    return stream == TE_FORCE ? profile->force_most : profile->taxels_most;
}

static void push(struct te_state* state, enum te_stream stream, int64_t t_ns, const float* raw, uint32_t columns) {
    const struct te_profile* const profile = &state->profile;
    float sample[TE_AXES > TE_TAXELS ? TE_AXES : TE_TAXELS];
    scale(profile, stream, raw, columns, sample);
    te_health_sample(state, stream, t_ns, raw, columns);
    if (!plausible(sample, columns, most_of(profile, stream))) {
        if (t_ns > state->implausible_ns) state->implausible_ns = t_ns;
    }
    if (stream == TE_ACCELERATION) {
        push_acceleration(state, t_ns, sample);
    } else if (stream == TE_FORCE) {
        push_force(state, t_ns, sample[0]);
        if (!(profile->taxels_hz > 0.0F)) te_pace(state, t_ns);
    } else {
        if (plausible(sample, columns, profile->taxels_most)) te_taxels_push(state, t_ns, sample);
        te_pace(state, t_ns);
    }
}

uint32_t te_samples(struct te_state* state, enum te_stream stream, int64_t first_ns, int32_t step_ns,
                    const float* values, uint32_t count) {
    uint32_t columns;
    uint32_t i;
    if (!state->accepted || first_ns < 0 || first_ns > TE_LAST_NS || count > TE_BLOCK) return 0U;
    columns = columns_of(&state->profile, stream);
    if (columns == 0U) return 0U;
    for (i = 0; i < count; ++i)
        push(state, stream, first_ns + (int64_t)i * step_ns, values + (size_t)i * columns, columns);
    return count;
}
