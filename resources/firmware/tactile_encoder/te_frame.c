/* Frames: windows become powers, powers and taxels become R, force becomes P (science.md sections 2.4 to 3). */
#include "te_parts.h"

#define FRAME_NS 16000000
#define REST_NS INT64_C(250000000)
#define HOLD_NS INT64_C(250000000)
#define DECAY_S 0.25F
#define LOG2_E 1.44269504F
#define SLIDING_FACTOR 3.0F
#define STEADY_FORCE 2.0F
#define SMALLEST_DIVISOR_N 0.1F
#define WAITING_LIMIT_NS INT64_C(350000000) /* beyond the reach of a taxel sample */

static int has_acceleration(const struct te_state* state) { return state->profile.acceleration_hz > 0.0F; }
static int has_force(const struct te_state* state) { return state->profile.force_hz > 0.0F; }
static int has_taxels(const struct te_state* state) { return state->profile.taxels_hz > 0.0F; }

void te_frames_init(struct te_state* state) {
    const struct te_profile* const profile = &state->profile;
    struct te_pacer* const pacer = &state->pacer;
    float period_s;
    if (has_acceleration(state)) {
        period_s = te_seconds(state->acceleration.hop_ns);
    } else {
        const float rate = has_taxels(state) ? profile->taxels_hz : profile->force_hz;
        pacer->step_ns = (int32_t)(1e9F / rate + 0.5F);
        pacer->every_sample = pacer->step_ns > FRAME_NS;
        pacer->frame_ns = pacer->every_sample ? pacer->step_ns : FRAME_NS;
        period_s = te_seconds(pacer->frame_ns);
    }
    pacer->last_ns = TE_ALWAYS;
    state->index.alpha = 1.0F - te_exp2(-period_s / profile->smoothing_s * LOG2_E);
    state->latest.t_ns = TE_ALWAYS;
    state->latest.R = te_nan();
    state->latest.P = te_nan();
}

/* Waiting frames ------------------------------------------------------------------------------------------------ */

static struct te_pending* add_pending(struct te_state* state) {
    struct te_pending* const added = &state->pending[(state->pending_front + state->pending_count) % TE_FRAMES];
    ++state->pending_count;
    return added;
}

static void add_due(struct te_state* state, int64_t t_ns) {
    struct te_pending* added;
    if (state->pending_count == TE_FRAMES) {
        ++state->windows_lost;
        return;
    }
    added = add_pending(state);
    added->begin_ns = t_ns;
    added->h = te_nan();
    added->mean_square = 0.0F;
}

void te_pace(struct te_state* state, int64_t t_ns) {
    struct te_pacer* const pacer = &state->pacer;
    const int64_t late = t_ns - pacer->expected_ns;
    if (has_acceleration(state) || t_ns <= pacer->last_ns) return;
    if (pacer->last_ns != TE_ALWAYS && late < pacer->step_ns / 2 && -late < pacer->step_ns / 2) {
        pacer->expected_ns += pacer->step_ns + (int32_t)late / 20;
    } else {
        if (pacer->last_ns == TE_ALWAYS || late > 0) {
            pacer->next_ns = t_ns;
        }
        pacer->expected_ns = t_ns + pacer->step_ns;
    }
    pacer->last_ns = t_ns;
    if (pacer->every_sample) {
        add_due(state, t_ns);
        return;
    }
    for (; pacer->next_ns <= t_ns; pacer->next_ns += FRAME_NS) add_due(state, pacer->next_ns);
}

static int64_t centre_of(const struct te_state* state, const struct te_pending* pending) {
    return pending->begin_ns + state->acceleration.half_ns;
}

static int64_t end_of(const struct te_state* state, int64_t begin_ns) {
    return begin_ns + state->acceleration.length_ns;
}

/* Vibration ----------------------------------------------------------------------------------------------------- */

/* Whether force more than doubles within the window: one force for all of it would turn noise into vibration. */
static int unsteady(const struct te_acceleration* a, uint32_t first) {
    float least = a->slot[first % TE_RING].divisor;
    float most = least;
    uint32_t i;
    for (i = 1; i < a->length; ++i) {
        const float divisor = a->slot[(first + i) % TE_RING].divisor;
        if (divisor < least) least = divisor;
        if (divisor > most) most = divisor;
    }
    return most > STEADY_FORCE * least;
}

static float undone(struct te_state* state, uint32_t first, const struct te_press* pressed, float mean_square) {
    const float divisor = pressed->force > SMALLEST_DIVISOR_N ? pressed->force : SMALLEST_DIVISOR_N;
    struct te_power power;
    mean_square *= divisor * divisor;
    if (!pressed->contact || !unsteady(&state->acceleration, first)) return mean_square;
    power = te_window_power(&state->spectrum, &state->acceleration, state->profile.axes, first, 1);
    return power.low + power.high < mean_square ? power.low + power.high : mean_square;
}

static void transform(struct te_state* state, const struct te_window* window) {
    const struct te_spectrum* const spectrum = &state->spectrum;
    const struct te_power power =
        te_window_power(&state->spectrum, &state->acceleration, state->profile.axes, window->first, 0);
    struct te_pending* const added = add_pending(state);
    const float all = power.low + power.high;
    const float feature = state->profile.spectral_absolute ? power.high : power.high / all;
    added->begin_ns = window->begin_ns;
    added->h = spectrum->rough <= spectrum->last && feature > 0.0F && te_is_number(feature) ? feature : te_nan();
    added->mean_square = all;
    if (has_force(state)) {
        const struct te_press pressed = te_force_at(&state->force, centre_of(state, added));
        added->mean_square = undone(state, window->first, &pressed, all);
        added->force = pressed.force;
        added->contact = pressed.contact;
        added->fresh = pressed.fresh;
    }
}

/* Transforms the windows whose force is known; where the ring or the list is nearly full, what is known is held. */
static void transform_windows(struct te_state* state) {
    struct te_acceleration* const a = &state->acceleration;
    te_normalise(state, 0, 0U);
    while (a->window_count > 0U && state->pending_count < TE_FRAMES) {
        const struct te_window window = a->windows[a->window_front];
        const uint32_t whole = window.first + a->length;
        const uint32_t held = a->end - window.first;
        const int divided = (int32_t)(a->normalised - whole) >= 0;
        if (held < a->length) return;
        if (!divided || te_known_ns(state) < end_of(state, window.begin_ns)) {
            if (held + a->hop < TE_RING && a->window_count + 1U < TE_WINDOWS) return;
            if (!divided) te_normalise(state, 1, whole);
        }
        transform(state, &window);
        a->window_front = (a->window_front + 1U) % TE_WINDOWS;
        --a->window_count;
    }
}

/* R ------------------------------------------------------------------------------------------------------------- */

enum motion { NO_CONTACT, UNKNOWN, RESTING, SLIDING };

static void decide_rest(struct te_state* state) {
    struct te_index* const index = &state->index;
    const int64_t begin_ns = te_stream_begin_ns(state);
    const int64_t contact_ns = te_first_contact_ns(state);
    index->rest_decided = 1U;
    if (contact_ns != TE_ALWAYS && contact_ns - begin_ns >= REST_NS && index->rest_count > 0U) {
        index->rest_level = index->rest_mean;
    } else if (state->profile.rest_mean_square > 0.0F) {
        index->rest_level = state->profile.rest_mean_square;
    } else {
        index->sliding_assumed = 1U;
    }
}

static enum motion motion_of(struct te_state* state, const struct te_pending* pending, int contact) {
    struct te_index* const index = &state->index;
    if (!has_acceleration(state)) {
        if (contact) index->sliding_assumed = 1U;
        return contact ? SLIDING : NO_CONTACT;
    }
    if (!index->rest_decided) {
        if (end_of(state, pending->begin_ns) < te_first_contact_ns(state)) {
            if (index->rest_count < UINT32_MAX) ++index->rest_count;
            index->rest_mean += (pending->mean_square - index->rest_mean) / (float)index->rest_count;
        }
        if (contact) decide_rest(state);
    }
    if (!contact) return NO_CONTACT;
    if (index->sliding_assumed) return SLIDING;
    if (!index->rest_decided) return UNKNOWN;
    return pending->mean_square < SLIDING_FACTOR * index->rest_level ? RESTING : SLIDING;
}

static float clamp_unit(float x) { return x < 0.0F ? 0.0F : x > 1.0F ? 1.0F : x; }

static float scaled(float x, float smooth, float rough) {
    const float from = te_log2(smooth);
    return clamp_unit((te_log2(x) - from) / (te_log2(rough) - from));
}

/* The weighed mean of the features that are there. */
static float combined(const struct te_profile* profile, float h, float v) {
    float sum = 0.0F;
    float weights = 0.0F;
    if (h > 0.0F) {
        sum += profile->spectral_weight * scaled(h, profile->spectral_smooth, profile->spectral_rough);
        weights += profile->spectral_weight;
    }
    if (v > 0.0F) {
        sum += profile->taxel_weight * scaled(v, profile->taxel_smooth, profile->taxel_rough);
        weights += profile->taxel_weight;
    }
    return weights > 0.0F ? sum / weights : te_nan();
}

static float next_sliding(struct te_index* index, int64_t t_ns, float raw) {
    index->last_sliding_ns = t_ns;
    if (!(raw >= 0.0F)) return te_nan();
    /* After a rest R goes on from the last value felt, decayed or not. */
    index->current = index->started ? index->current + index->alpha * (raw - index->current) : raw;
    index->held = index->current;
    index->started = 1U;
    return index->current;
}

static float next_roughness(struct te_state* state, int64_t t_ns, enum motion motion, float h, float v) {
    struct te_index* const index = &state->index;
    switch (motion) {
        case NO_CONTACT:
            index->started = 0U;
            return te_nan();
        case UNKNOWN:
            return te_nan();
        case SLIDING:
            return next_sliding(index, t_ns, combined(&state->profile, h, v));
        case RESTING:
            break;
    }
    if (!index->started) return te_nan();
    if (t_ns - index->last_sliding_ns > HOLD_NS) {
        const float beyond_s = te_seconds(t_ns - index->last_sliding_ns - HOLD_NS);
        index->current = index->held * te_exp2(-beyond_s / DECAY_S * LOG2_E);
    }
    return index->current;
}

/* P and the frame ----------------------------------------------------------------------------------------------- */

static float pressure_of(const struct te_state* state, const struct te_pending* pending, float taxel_mean) {
    const struct te_profile* const profile = &state->profile;
    if (has_force(state)) {
        if (!profile->force_newton || !pending->fresh) return te_nan();
        return pending->force / (profile->contact_area_cm2 * 1e-4F);
    }
    return has_taxels(state) && profile->taxels_pascal ? taxel_mean : te_nan();
}

/* Whether the taxels of a frame are known. A silent array holds nothing up for longer than a sample may be away. */
static int ready(const struct te_state* state, const struct te_pending* pending) {
    const int64_t centre = centre_of(state, pending);
    const int64_t horizon = has_acceleration(state) ? state->acceleration.last_ns : state->pacer.last_ns;
    if (!has_acceleration(state) && te_known_ns(state) < centre && horizon < centre + WAITING_LIMIT_NS) return 0;
    if (!has_taxels(state) || te_taxels_ready(state, centre)) return 1;
    return horizon > centre + state->taxels.reach_ns + WAITING_LIMIT_NS || state->pending_count == TE_FRAMES;
}

static void evaluate(struct te_state* state, struct te_pending* pending, struct te_reading* frame) {
    const struct te_profile* const profile = &state->profile;
    struct te_touch touch = {0.0F, 0.0F};
    enum motion motion;
    touch.v = touch.mean = te_nan();
    frame->t_ns = centre_of(state, pending);
    if (has_force(state) && !has_acceleration(state)) {
        const struct te_press pressed = te_force_at(&state->force, frame->t_ns);
        pending->force = pressed.force;
        pending->contact = pressed.contact;
        pending->fresh = pressed.fresh;
    }
    frame->contact = has_force(state) ? pending->contact : 1U;
    if (has_taxels(state)) touch = te_taxels_at(state, frame->t_ns);
    motion = motion_of(state, pending, frame->contact != 0U);
    frame->sliding = motion == SLIDING;
    frame->sliding_assumed = state->index.sliding_assumed;
    frame->h = pending->h;
    frame->v = touch.v;
    frame->R = next_roughness(state, frame->t_ns, motion, frame->h, frame->v);
    frame->pressure_pa = pressure_of(state, pending, touch.mean);
    frame->P = (frame->pressure_pa - profile->pressure_min_pa) / (profile->pressure_max_pa - profile->pressure_min_pa);
    if (te_is_number(frame->P)) frame->P = clamp_unit(frame->P);
}

int te_frame(struct te_state* state, struct te_reading* frame) {
    struct te_pending* pending;
    if (!state->accepted) return 0;
    if (has_acceleration(state)) transform_windows(state);
    if (has_taxels(state)) te_taxels_settle(state);
    if (state->pending_count == 0U) return 0;
    pending = &state->pending[state->pending_front];
    if (!ready(state, pending)) return 0;
    evaluate(state, pending, frame);
    state->pending_front = (state->pending_front + 1U) % TE_FRAMES;
    --state->pending_count;
    state->latest = *frame;
    return 1;
}
