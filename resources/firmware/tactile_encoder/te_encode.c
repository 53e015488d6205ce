/* R and P become trains: curves, assignment and transitions of science.md section 4, then the gate. */
#include <stddef.h>

#include "te_parts.h"

#define SILENCE 2.0F /* longest intervals, after which a series has ended */
#define ROUNDING_LIMIT 0.1F

static uint32_t crc_of(uint32_t crc, const void* from, size_t size) {
    const uint8_t* const bytes = (const uint8_t*)from;
    size_t i;
    uint32_t bit;
    for (i = 0; i < size; ++i) {
        crc ^= bytes[i];
        for (bit = 0; bit < 8U; ++bit) crc = (crc >> 1U) ^ (crc & 1U ? 0xEDB88320U : 0U);
    }
    return crc;
}

uint32_t te_hash(const struct te_profile* profile) {
    const size_t taxels = (profile->taxels < TE_TAXELS ? profile->taxels : TE_TAXELS) * sizeof(float);
    const size_t begin = offsetof(struct te_profile, acceleration_hz);
    uint32_t crc = 0xFFFFFFFFU;
    crc = crc_of(crc, &profile->acceleration_hz, offsetof(struct te_profile, taxel_scale) - begin);
    crc = crc_of(crc, profile->taxel_scale, taxels);
    crc = crc_of(crc, profile->taxel_offset, taxels);
    return crc ^ 0xFFFFFFFFU;
}

static void clear(void* to, size_t size) {
    size_t i;
    for (i = 0; i < size; ++i) ((uint8_t*)to)[i] = 0U;
}

static void copy(void* to, const uint8_t* from, size_t size) {
    size_t i;
    for (i = 0; i < size; ++i) ((uint8_t*)to)[i] = from[i];
}

enum te_refusal te_read_profile(struct te_profile* profile, const uint8_t* bytes, uint32_t size) {
    const size_t head = offsetof(struct te_profile, taxel_scale);
    size_t taxels;
    clear(profile, sizeof *profile);
    if (size < head) return TE_BAD_LAYOUT;
    copy(profile, bytes, head);
    if (profile->layout != TE_LAYOUT || profile->taxels > TE_TAXELS) return TE_BAD_LAYOUT;
    taxels = profile->taxels * sizeof(float);
    if (size != head + 2U * taxels) return TE_BAD_LAYOUT;
    copy(profile->taxel_scale, bytes + head, taxels);
    copy(profile->taxel_offset, bytes + head + taxels, taxels);
    return profile->hash == te_hash(profile) ? TE_ACCEPTED : TE_BAD_HASH;
}

enum te_refusal te_init(struct te_state* state, const struct te_profile* profile) {
    enum te_refusal refusal;
    clear(state, sizeof *state);
    state->profile = *profile;
    refusal = te_profile_judge(&state->profile);
    if (refusal != TE_ACCEPTED) return refusal;
    te_streams_init(state);
    te_taxels_init(state);
    te_health_init(state);
    te_frames_init(state);
    state->asked_ns = TE_ALWAYS;
    state->accepted = 1U;
    return TE_ACCEPTED;
}

void te_stop(struct te_state* state) { *(volatile uint32_t*)&state->stopped = 1U; }

int te_is_stopped(const struct te_state* state) { return *(const volatile uint32_t*)&state->stopped != 0U; }

void te_rested(struct te_state* state) { state->rested_ns = TE_REST_NS; }

/* The rest goes on by what passed since the last call, at most a second: a clock may be set only then. */
static void rest(struct te_state* state, int64_t now_ns) {
    if (now_ns < 0 || now_ns > TE_LAST_NS) return;
    if (state->asked_ns != TE_ALWAYS && now_ns > state->asked_ns && state->rested_ns < TE_REST_NS) {
        const int64_t passed_ns = now_ns - state->asked_ns;
        state->rested_ns += passed_ns < TE_SECOND_NS ? passed_ns : TE_SECOND_NS;
    }
    state->asked_ns = now_ns;
}

/* Encoding ------------------------------------------------------------------------------------------------------ */

static float curve(uint32_t kind, float beta, float x, float from, float to) {
    const float low = from < to ? from : to;
    const float high = from < to ? to : from;
    float y = from + x * (to - from);
    if (!(x > 0.0F)) return from;
    if (x >= 1.0F) return to;
    if (kind == TE_LOGARITHMIC) y = from * te_exp2(x * te_log2(to / from));
    if (kind == TE_POWER) y = from + (to - from) * te_exp2(te_log2(x) / beta);
    return y < low ? low : y > high ? high : y;
}

static struct te_command encoded(const struct te_profile* p, float roughness, float pressure) {
    const float for_amplitude = p->swapped ? pressure : roughness;
    const float for_interval = p->swapped ? roughness : pressure;
    struct te_command command;
    command.amplitude_v =
        curve(p->amplitude_curve, p->amplitude_beta, for_amplitude, p->amplitude_min_v, p->amplitude_max_v);
    command.interval_s = curve(p->interval_curve, p->interval_beta, for_interval, p->interval_max_s, p->interval_min_s);
    return command;
}

static float least(float a, float b) { return a < b ? a : b; }
static float most(float a, float b) { return a > b ? a : b; }
static float within(float value, float low, float high) { return most(least(value, high), low); }

/* Transitions --------------------------------------------------------------------------------------------------- */

static int goes_on(const struct te_state* state, int64_t onset_ns) {
    const struct te_series* const series = &state->series;
    return series->has_last && onset_ns - series->last_ns <= te_ns(SILENCE * state->profile.interval_max_s);
}

static float by_ratio(float value, float before, float ratio) {
    return ratio > 1.0F && before > 0.0F ? within(value, before / ratio, before * ratio) : value;
}

static struct te_command limited(const struct te_state* state, int64_t onset_ns) {
    const struct te_profile* const p = &state->profile;
    const struct te_series* const series = &state->series;
    const struct te_command wanted = series->wanted;
    const struct te_command last = series->last;
    struct te_command next = wanted;
    if (!goes_on(state, onset_ns)) return wanted;
    if (p->amplitude_slew_v_s > 0.0F) {
        const float change = p->amplitude_slew_v_s * most(0.0F, te_seconds(onset_ns - series->last_ns));
        next.amplitude_v = within(next.amplitude_v, last.amplitude_v - change, last.amplitude_v + change);
    }
    next.amplitude_v = by_ratio(next.amplitude_v, last.amplitude_v, p->amplitude_ratio);
    next.interval_s = by_ratio(wanted.interval_s, last.interval_s, p->interval_ratio);
    if (series->starts_again) {
        next.amplitude_v = least(next.amplitude_v, wanted.amplitude_v);
        next.interval_s = most(next.interval_s, wanted.interval_s);
    }
    return next;
}

/* The pending train moves to the new interval, but not before `not_before_ns`. */
static void reschedule(struct te_series* series, int64_t not_before_ns) {
    const int64_t due_ns = series->onset_ns + series->interval_ns;
    series->due_ns = series->has_onset && due_ns > not_before_ns ? due_ns : not_before_ns;
}

static void want(struct te_state* state, int64_t now_ns) {
    struct te_series* const series = &state->series;
    int64_t interval_ns;
    series->wanted = encoded(&state->profile, state->latest.R, te_is_number(state->latest.P) ? state->latest.P : 0.0F);
    series->command = limited(state, now_ns);
    interval_ns = te_ns(series->command.interval_s);
    if (series->has_wanted && interval_ns == series->interval_ns) return;
    series->interval_ns = interval_ns;
    series->has_wanted = 1U;
    reschedule(series, now_ns);
}

static void want_nothing(struct te_state* state) {
    state->series.has_wanted = 0U;
    state->series.starts_again = 1U;
    state->refusal = (uint32_t)TE_ACCEPTED;
}

/* The next train is due an interval after this one, whether or not this one is refused. */
static void begin(struct te_state* state, int64_t onset_ns) {
    struct te_series* const series = &state->series;
    series->command = limited(state, onset_ns);
    series->begun = series->command;
    series->begun_ns = onset_ns;
    if (goes_on(state, onset_ns)) {
        const float late_s = te_seconds(onset_ns - series->last_ns) - series->command.interval_s;
        const float longest_s = most(series->command.interval_s, state->profile.interval_max_s);
        series->begun.interval_s = within(series->command.interval_s + late_s, series->command.interval_s, longest_s);
    }
    series->onset_ns = onset_ns;
    series->has_onset = 1U;
    series->due_ns = onset_ns + series->interval_ns;
}

static void delivered(struct te_series* series) {
    series->last = series->begun;
    series->last_ns = series->begun_ns;
    series->has_last = 1U;
    series->starts_again = 0U;
}

/* Trains -------------------------------------------------------------------------------------------------------- */

/* Toward zero, so that rounding adds no exposure; what lies a ten-thousandth of a step below a step is that step. */
static float on_step(float value, float step) {
    float steps;
    if (!(step > 0.0F)) return value;
    steps = value / step + 1e-4F;
    return steps < 16777216.0F ? least((float)(int32_t)steps * step, value) : value;
}

static struct te_train train_of(const struct te_state* state, const struct te_command* command, int64_t onset_ns) {
    const struct te_profile* const p = &state->profile;
    const float exact = p->current_source ? command->amplitude_v / p->load_ohm * 1000.0F : command->amplitude_v;
    struct te_train train;
    train.onset_ns = onset_ns;
    train.interval_s = command->interval_s;
    train.command_v = command->amplitude_v;
    train.amplitude = on_step(exact, p->output_step);
    if (!(exact - train.amplitude <= ROUNDING_LIMIT * exact)) train.amplitude = te_nan(); /* refused by the gate */
    train.shape = p->shape;
    train.negative = p->negative;
    train.width_us = p->width_us;
    train.gap_us = p->gap_us;
    train.recharge_ratio = p->recharge_ratio;
    train.pulses = p->pulses;
    train.pulse_hz = p->pulse_hz;
    return train;
}

int te_next_train(struct te_state* state, int64_t now_ns, struct te_train* train) {
    struct te_series* const series = &state->series;
    enum te_refusal refusal;
    rest(state, now_ns);
    if (te_fault(state, now_ns) != 0U || !state->latest.contact || !(state->latest.R >= 0.0F)) {
        want_nothing(state);
        return 0;
    }
    want(state, now_ns);
    if (series->due_ns >= now_ns + TE_AHEAD_NS) return 0;
    begin(state, series->due_ns > now_ns ? series->due_ns : now_ns);
    *train = train_of(state, &series->command, series->begun_ns);
    refusal = te_train_judge(&state->profile, &state->gate, train, now_ns);
    state->refusal = (uint32_t)refusal;
    if (refusal != TE_ACCEPTED) {
        ++state->trains_refused;
        return 0;
    }
    te_train_book(&state->profile, &state->gate, train, now_ns);
    delivered(series);
    ++state->trains;
    return !te_is_stopped(state); /* which may have come meanwhile */
}

enum te_refusal te_refused(const struct te_state* state) { return (enum te_refusal)state->refusal; }
