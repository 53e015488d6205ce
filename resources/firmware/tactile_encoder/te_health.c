/* Whether the sensors are alive: late, ahead of time, repeating themselves, or out of all proportion. */
#include "te_parts.h"

#define SEARCH_S 0.002F /* from search to search: what repeats itself is found by any */
#define ENOUGH 40U      /* repeats that no working sensor makes by chance, where more values change than repeat */
#define KNOWN 16U       /* changes after which that is known */
/* A frame shows the middle of its window: half of 64 ms late, a hop, and the wait for the next sample of force. */
#define FRAME_DELAY_NS INT64_C(78000000)
#define ARRAY 4U /* the least taxels that a filter does not make all equal */

void te_health_init(struct te_state* state) {
    uint32_t i;
    for (i = 0; i < (uint32_t)TE_STREAMS; ++i) state->newest_ns[i] = TE_ALWAYS;
    state->implausible_ns = TE_ALWAYS;
}

static uint16_t mixed(uint32_t bits) { return (uint16_t)((bits * 2654435761U) >> 16U); }

static void add(struct te_chance* chance, uint32_t repeated, uint32_t changed) {
    chance->repeated += repeated;
    chance->changed += changed;
    if (chance->changed >= UINT32_MAX / 4U || chance->repeated >= UINT32_MAX / 4U) {
        chance->changed /= 2U;
        chance->repeated /= 2U;
    }
}

static int moves(const struct te_chance* chance) { return chance->repeated <= chance->changed; }

static int same(const struct te_repeat* repeat, uint32_t lag, uint16_t value) {
    return repeat->sample[(repeat->seen - lag) % TE_PERIODS] == value;
}

/* Keeps the lags at which this value comes again; returns whether there is one. */
static int keep(struct te_repeat* repeat, uint16_t value) {
    uint32_t any = 0U;
    uint32_t word;
    for (word = 0; word < TE_PERIODS / 32U; ++word) {
        uint32_t left = repeat->lags[word];
        uint32_t kept = 0U;
        uint32_t bit = 1U;
        uint32_t lag;
        for (lag = 32U * word + 1U; left != 0U; ++lag) {
            if ((left & 1U) && same(repeat, lag, value)) kept |= bit;
            left >>= 1U;
            bit <<= 1U;
        }
        repeat->lags[word] = kept;
        any |= kept;
    }
    return any != 0U;
}

/* All lags are searched every `searched` samples, since that takes long; what was found is followed at each. */
static void follow(struct te_repeat* repeat, uint16_t value, int64_t before_ns, uint32_t searched) {
    uint32_t word;
    if (repeat->run == 0U) {
        if (repeat->seen % searched != 0U) return;
        for (word = 0; word < TE_PERIODS / 32U; ++word) repeat->lags[word] = UINT32_MAX;
        repeat->since_ns = before_ns;
    }
    if (!keep(repeat, value)) {
        repeat->run = 0U;
    } else if (repeat->run < UINT32_MAX) {
        ++repeat->run;
    }
}

/* What is found to repeat itself says nothing of how often a value does so by chance. */
static void watch(struct te_repeat* repeat, uint16_t value, int64_t before_ns, uint32_t searched) {
    if (same(repeat, 1U, value)) {
        if (repeat->held < UINT32_MAX) ++repeat->held;
    } else {
        add(&repeat->near, repeat->held < ENOUGH ? repeat->held : ENOUGH, 1U);
        repeat->held = 0U;
    }
    if (repeat->seen % searched == 0U && (repeat->run < ENOUGH || !moves(&repeat->near))) {
        const uint32_t again = same(repeat, TE_PERIODS, value) != 0;
        add(&repeat->far, again, 1U - again);
    }
    follow(repeat, value, before_ns, searched);
    repeat->sample[repeat->seen % TE_PERIODS] = value;
    ++repeat->seen;
}

static float rate_of(const struct te_profile* profile, enum te_stream stream) {
    if (stream == TE_ACCELERATION) return profile->acceleration_hz;
    return stream == TE_FORCE ? profile->force_hz : profile->taxels_hz;
}

void te_health_sample(struct te_state* state, enum te_stream stream, int64_t t_ns, const float* raw, uint32_t columns) {
    const uint32_t searched = 1U + (uint32_t)(rate_of(&state->profile, stream) * SEARCH_S);
    int64_t* const newest_ns = &state->newest_ns[stream];
    const int64_t before_ns = *newest_ns == TE_ALWAYS ? t_ns : *newest_ns;
    uint32_t all = 2166136261U;
    uint32_t i;
    if (stream == TE_ACCELERATION) {
        for (i = 0; i < columns; ++i) watch(&state->repeat[i], mixed(te_bits(raw[i])), before_ns, searched);
    } else {
        for (i = 0; i < columns; ++i) all = (all ^ te_bits(raw[i])) * 16777619U;
        watch(&state->repeat[TE_AXES + (uint32_t)stream - 1U], mixed(all), before_ns, searched);
    }
    if (t_ns > *newest_ns) *newest_ns = t_ns;
}

/* A value that often comes again anyway shows nothing; one that stands may be judged by either distance. */
static int stands(const struct te_repeat* repeat, int64_t newest_ns) {
    if (repeat->run < ENOUGH || newest_ns - repeat->since_ns <= TE_STALE_NS) return 0;
    if (!(repeat->lags[0] & 1U)) return moves(&repeat->far);
    return moves(&repeat->near) || (repeat->far.changed >= KNOWN && moves(&repeat->far));
}

static int repeats(const struct te_state* state, enum te_stream stream) {
    return stands(&state->repeat[TE_AXES + (uint32_t)stream - 1U], state->newest_ns[stream]);
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
        if (stands(&state->repeat[i], state->newest_ns[TE_ACCELERATION])) return 1;
    }
    return 0;
}

/* Bits for a stamp that should be of the last 100 ms, and `delay_ns` more. */
static uint32_t age_fault(int64_t stamp_ns, int64_t now_ns, int64_t delay_ns) {
    if (stamp_ns == TE_ALWAYS || stamp_ns < now_ns - TE_STALE_NS - delay_ns) return TE_FAULT_STALE;
    return stamp_ns > now_ns + TE_STALE_NS ? TE_FAULT_FUTURE : 0U;
}

uint32_t te_fault(const struct te_state* state, int64_t now_ns) {
    const struct te_profile* const profile = &state->profile;
    const float rates[TE_STREAMS] = {profile->acceleration_hz, profile->force_hz, profile->taxels_hz};
    uint32_t fault = 0U;
    uint32_t i;
    if (!state->accepted) return TE_FAULT_PROFILE;
    if (now_ns < 0 || now_ns > TE_LAST_NS) return TE_FAULT_FUTURE;
    if (te_is_stopped(state)) fault |= TE_FAULT_STOPPED;
    /* What a board delivered before it was reset still counts. */
    if (state->rested_ns < TE_REST_NS) fault |= TE_FAULT_RESTING;
    for (i = 0; i < (uint32_t)TE_STREAMS; ++i) {
        if (rates[i] > 0.0F) fault |= age_fault(state->newest_ns[i], now_ns, 0);
    }
    fault |= age_fault(state->latest.t_ns, now_ns, FRAME_DELAY_NS);
    if (age_fault(state->implausible_ns, now_ns, 0) == 0U) fault |= TE_FAULT_IMPLAUSIBLE;
    if (is_stuck(state)) fault |= TE_FAULT_STUCK;
    return fault;
}
