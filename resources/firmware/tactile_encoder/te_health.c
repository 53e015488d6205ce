/* Whether the sensors are alive: late, ahead of time, repeating themselves, or out of all proportion. */
#include "te_parts.h"

#define SEARCHED 8U /* samples from search to search: what repeats itself is found by any */
#define ENOUGH 40U  /* repeats that no working sensor makes by chance, where more values change than repeat */
/* A frame shows the middle of its window: half of 64 ms late, a hop, and the wait for the next sample of force. */
#define FRAME_DELAY_NS INT64_C(78000000)
#define REST_NS INT64_C(8000000000) /* longer than the longest window of exposure */
#define ARRAY 4U                    /* the least taxels that a filter does not make all equal */

void te_health_init(struct te_state* state) {
    uint32_t i;
    for (i = 0; i < (uint32_t)TE_STREAMS; ++i) state->health[i].newest_ns = TE_ALWAYS;
    state->implausible_ns = TE_ALWAYS;
}

static void count(struct te_still* still, int same, int64_t before_ns) {
    if (same) {
        if (still->run == 0U) still->since_ns = before_ns;
        if (still->run < UINT32_MAX) ++still->run;
        return;
    }
    still->repeated += still->run < ENOUGH ? still->run : ENOUGH;
    still->run = 0U;
    ++still->changed;
    if (still->changed >= UINT32_MAX / 2U || still->repeated >= UINT32_MAX / 2U) {
        still->changed /= 2U;
        still->repeated /= 2U;
    }
}

static void watch_value(struct te_still* still, uint32_t value, int64_t before_ns) {
    count(still, value == still->last, before_ns);
    still->last = value;
}

/* The shortest period after which this sample comes again; 0: none. */
static uint32_t period_of(const struct te_repeat* repeat, uint32_t sample) {
    const uint32_t most = repeat->seen < TE_PERIODS ? repeat->seen : TE_PERIODS;
    uint32_t lag;
    for (lag = 1; lag <= most; ++lag) {
        if (repeat->sample[(repeat->seen - lag) % TE_PERIODS] == sample) return lag;
    }
    return 0U;
}

static void watch_sample(struct te_repeat* repeat, uint32_t sample, int64_t before_ns) {
    const int followed = repeat->lag > 0U;
    if (followed && repeat->sample[(repeat->seen - repeat->lag) % TE_PERIODS] == sample) {
        count(&repeat->still, 1, before_ns);
    } else if (followed || repeat->seen % SEARCHED == 0U) {
        if (followed) count(&repeat->still, 0, before_ns);
        repeat->lag = period_of(repeat, sample);
        count(&repeat->still, repeat->lag > 0U, before_ns);
    }
    repeat->sample[repeat->seen % TE_PERIODS] = sample;
    ++repeat->seen;
    if (repeat->seen == 0U) repeat->seen = TE_PERIODS; /* numbers begin anew, in the same places */
}

void te_health_sample(struct te_state* state, enum te_stream stream, int64_t t_ns, const float* raw, uint32_t columns) {
    struct te_health* const health = &state->health[stream];
    const int64_t before_ns = health->newest_ns == TE_ALWAYS ? t_ns : health->newest_ns;
    uint32_t mixed = 2166136261U;
    uint32_t i;
    for (i = 0; i < columns; ++i) {
        mixed = (mixed ^ te_bits(raw[i])) * 16777619U;
        if (stream == TE_ACCELERATION) watch_value(&state->axis[i], te_bits(raw[i]), before_ns);
    }
    watch_sample(&health->repeat, mixed, before_ns);
    if (t_ns > health->newest_ns) health->newest_ns = t_ns;
}

static int stands(const struct te_still* still, int64_t newest_ns) {
    return still->run >= ENOUGH && newest_ns - still->since_ns > TE_STALE_NS && still->repeated <= still->changed;
}

static int repeats(const struct te_state* state, enum te_stream stream) {
    const struct te_health* const health = &state->health[stream];
    return stands(&health->repeat.still, health->newest_ns);
}

/* A working accelerometer never repeats itself: its noise is larger than its steps. Force and taxels may stand still,
 * but not an array that is touched, nor all there is. */
static int is_stuck(const struct te_state* state) {
    const struct te_profile* const profile = &state->profile;
    const int force = profile->force_hz > 0.0F;
    const int taxels = profile->taxels_hz > 0.0F;
    uint32_t i;
    if (taxels && profile->taxels >= ARRAY && state->latest.contact && repeats(state, TE_TAXEL_ARRAY)) return 1;
    if (!(profile->acceleration_hz > 0.0F)) {
        return (!force || repeats(state, TE_FORCE)) && (!taxels || repeats(state, TE_TAXEL_ARRAY));
    }
    for (i = 0; i < profile->axes; ++i) {
        if (stands(&state->axis[i], state->health[TE_ACCELERATION].newest_ns)) return 1;
    }
    return repeats(state, TE_ACCELERATION);
}

/* Bits for a stamp that should be of the last 100 ms, and `delay_ns` more. */
static uint32_t age_fault(int64_t stamp_ns, int64_t now_ns, int64_t delay_ns) {
    if (stamp_ns == TE_ALWAYS || stamp_ns < now_ns - TE_STALE_NS - delay_ns) return TE_FAULT_STALE;
    return stamp_ns > now_ns + TE_STALE_NS ? TE_FAULT_FUTURE : 0U;
}

/* What a board delivered before it was reset still counts. */
static int is_resting(const struct te_state* state, int64_t now_ns) {
    if (state->rested) return 0;
    return !state->asked || now_ns < state->asked_ns + REST_NS;
}

uint32_t te_fault(const struct te_state* state, int64_t now_ns) {
    const struct te_profile* const profile = &state->profile;
    const float rates[TE_STREAMS] = {profile->acceleration_hz, profile->force_hz, profile->taxels_hz};
    uint32_t fault = 0U;
    uint32_t i;
    if (!state->accepted) return TE_FAULT_PROFILE;
    if (now_ns < 0 || now_ns > TE_LAST_NS) return TE_FAULT_FUTURE;
    if (state->stopped) fault |= TE_FAULT_STOPPED;
    if (is_resting(state, now_ns)) fault |= TE_FAULT_RESTING;
    for (i = 0; i < (uint32_t)TE_STREAMS; ++i) {
        if (rates[i] > 0.0F) fault |= age_fault(state->health[i].newest_ns, now_ns, 0);
    }
    fault |= age_fault(state->latest.t_ns, now_ns, FRAME_DELAY_NS);
    if (age_fault(state->implausible_ns, now_ns, 0) == 0U) fault |= TE_FAULT_IMPLAUSIBLE;
    if (is_stuck(state)) fault |= TE_FAULT_STUCK;
    return fault;
}
