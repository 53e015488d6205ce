/* What may come out: a profile and each train, in the worst case of the profile's errors and of its load. Every
 * comparison is one that NaN fails. */
#include "te_parts.h"

#define ROUNDING 1.00001F  /* what single precision may hide */
#define MOST_READING 1e15F /* whose square is finite */
#define WINDOW_S 5.0F
/* A clock that is 5 % fast, and the 0.1 s in which a train may begin: as the bench's gate counts. */
#define MORE_S 0.4F

static int between(float x, float low, float high) { return x >= low && x <= high; }
static int flag(uint32_t x) { return x <= 1U; }

static float second_width_us(const struct te_train* train, float width_us) {
    if (train->shape == TE_SYMMETRIC) return width_us;
    return train->shape == TE_ASYMMETRIC ? width_us * train->recharge_ratio : 0.0F;
}

static float pulse_us(const struct te_train* train, float width_us) {
    const float gap_us = train->shape == TE_MONOPHASIC ? 0.0F : train->gap_us * (width_us / train->width_us);
    return width_us + gap_us + second_width_us(train, width_us);
}

/* From the first edge to the last, at the slowest rate and the widest pulse. */
static float duration_s(const struct te_profile* p, const struct te_train* train) {
    const float width_us = train->width_us * (1.0F + p->width_error);
    const float period_s = 1.0F / (train->pulse_hz * (1.0F - p->rate_error));
    return (float)(train->pulses - 1U) * period_s + pulse_us(train, width_us) * 1e-6F;
}

/* The largest current, A, at `load_ohm`. */
static float peak_a(const struct te_profile* p, const struct te_train* train, float load_ohm) {
    const float amplitude = train->amplitude * (1.0F + p->amplitude_error);
    return p->current_source ? amplitude * 1e-3F : amplitude / load_ohm;
}

/* The integral of the squared current over a train, A2 s. */
static float square_of(const struct te_profile* p, const struct te_train* train, float load_ohm) {
    const float peak = peak_a(p, train, load_ohm);
    const float width_s = train->width_us * (1.0F + p->width_error) * 1e-6F;
    float widths = width_s;
    if (train->shape == TE_SYMMETRIC) widths = 2.0F * width_s;
    if (train->shape == TE_ASYMMETRIC) widths = width_s + width_s / train->recharge_ratio;
    return (float)train->pulses * peak * peak * widths;
}

/* The command is what the amplitude makes of it, whatever was said. One product in double precision: 40 V is allowed,
 * and what single precision would round to it is not. */
static int keeps_command(const struct te_profile* p, const struct te_train* train) {
    if (!p->current_source) return train->amplitude <= TE_MAX_COMMAND_V;
    return (double)train->amplitude * (double)p->load_ohm <= 1000.0 * (double)TE_MAX_COMMAND_V;
}

static float rms_ma(float square) { return sqrtf(square / WINDOW_S) * 1000.0F; }

/* What was booked in the last seconds. */
static float booked(const struct te_gate* gate, int64_t since_ns) {
    float sum = 0.0F;
    uint32_t i;
    for (i = 0; i < gate->count; ++i) {
        const uint32_t at = (gate->first + i) % TE_BOOKED;
        if (gate->t_ns[at] > since_ns) sum += gate->square[at];
    }
    return sum;
}

/* A train that ended before this shares no window with one at `now_ns`. */
static int64_t window_begin(const struct te_profile* p, int64_t now_ns) {
    return now_ns - te_ns(WINDOW_S / (1.0F - p->interval_error) + MORE_S);
}

/* The 5 s RMS at `load_ohm`: of this train alone again and again, or with what was booked. */
static float worst_rms_ma(const struct te_profile* p, const struct te_gate* gate, const struct te_train* train,
                          int64_t now_ns) {
    const float one = square_of(p, train, p->load_low_ohm);
    const float shortest_s = train->interval_s * (1.0F - p->interval_error);
    const float trains = (float)(uint32_t)(WINDOW_S / shortest_s) + 1.0F;
    const float together = one + booked(gate, window_begin(p, now_ns));
    return rms_ma(trains * one > together ? trains * one : together) * ROUNDING;
}

static enum te_refusal judge_form(const struct te_profile* p, const struct te_train* train) {
    if (train->shape > TE_MONOPHASIC || !flag(train->negative) || train->pulses < 1U) return TE_BAD_TRAIN;
    if (train->pulses > 1000U || !between(train->gap_us, 0.0F, 1e5F)) return TE_BAD_TRAIN;
    if (train->shape == TE_ASYMMETRIC && !between(train->recharge_ratio, 1.001F, 1000.0F)) return TE_BAD_TRAIN;
    if (!between(train->width_us, 1.0F, TE_MAX_WIDTH_US)) return TE_ABOVE_WIDTH;
    if (!(train->width_us * (1.0F + p->width_error) <= TE_MAX_WIDTH_US)) return TE_ABOVE_WIDTH;
    if (!between(train->pulse_hz, 0.1F, TE_MAX_PULSE_HZ)) return TE_ABOVE_RATE;
    if (!between(train->interval_s, TE_MIN_INTERVAL_S, 60.0F)) return TE_ABOVE_RATE;
    if (!(pulse_us(train, train->width_us * (1.0F + p->width_error)) * ROUNDING <=
          1e6F / (train->pulse_hz * (1.0F + p->rate_error)))) {
        return TE_BAD_TRAIN;
    }
    if (!(duration_s(p, train) <= TE_MAX_TRAIN_S)) return TE_ABOVE_DURATION;
    if (!((float)train->pulses / (train->pulse_hz * (1.0F - p->rate_error)) * ROUNDING <=
          train->interval_s * (1.0F - p->interval_error))) {
        return TE_ABOVE_RATE;
    }
    return TE_ACCEPTED;
}

enum te_refusal te_train_judge(const struct te_profile* p, const struct te_gate* gate, const struct te_train* train,
                               int64_t now_ns) {
    const enum te_refusal form = judge_form(p, train);
    const float peak = peak_a(p, train, p->load_low_ohm);
    float rms;
    if (form != TE_ACCEPTED) return form;
    if (!between(train->command_v, 0.0F, TE_MAX_COMMAND_V)) return TE_ABOVE_COMMAND;
    if (!between(train->amplitude, 0.0F, p->output_max)) return TE_ABOVE_OUTPUT;
    if (!keeps_command(p, train)) return TE_ABOVE_COMMAND;
    if (!(peak * 1000.0F * ROUNDING <= p->ceiling_peak_ma)) return TE_ABOVE_PEAK;
    if (!(peak_a(p, train, p->load_high_ohm) * p->load_high_ohm * ROUNDING <= TE_MAX_PEAK_V)) return TE_ABOVE_PEAK;
    if (!(peak * train->width_us * (1.0F + p->width_error) * ROUNDING <= p->ceiling_charge_uc)) return TE_ABOVE_CHARGE;
    rms = worst_rms_ma(p, gate, train, now_ns);
    if (!(rms < p->ceiling_rms_ma)) return TE_ABOVE_RMS;
    if (!(p->current_source || rms * p->load_low_ohm / 500.0F <= TE_MAX_RMS_500_MA)) return TE_ABOVE_RMS;
    if (gate->used && !(now_ns >= gate->t_ns[(gate->first + gate->count - 1U) % TE_BOOKED])) return TE_METER;
    return gate->count < TE_BOOKED || gate->t_ns[gate->first] <= window_begin(p, now_ns) ? TE_ACCEPTED : TE_METER;
}

void te_train_book(const struct te_profile* p, struct te_gate* gate, const struct te_train* train, int64_t now_ns) {
    uint32_t at;
    if (gate->count == TE_BOOKED) {
        gate->first = (gate->first + 1U) % TE_BOOKED;
        --gate->count;
    }
    at = (gate->first + gate->count) % TE_BOOKED;
    gate->t_ns[at] = now_ns + te_ns(duration_s(p, train));
    gate->square[at] = square_of(p, train, p->load_low_ohm);
    ++gate->count;
    gate->used = 1U;
}

/* Profiles ------------------------------------------------------------------------------------------------------ */

static enum te_refusal judge_streams(const struct te_profile* p) {
    const float slowest = p->acceleration_hz > 0.0F ? 20.0F : 1.0F;
    uint32_t i;
    if (p->acceleration_hz != 0.0F) {
        if (!between(p->acceleration_hz, 99.0F, 4007.0F) || p->axes < 1U || p->axes > TE_AXES) return TE_BAD_STREAM;
        if (!between(p->acceleration_most, 1e-6F, MOST_READING)) return TE_BAD_STREAM;
    }
    if (p->force_hz != 0.0F) {
        if (!between(p->force_hz, slowest, 300.0F) || !flag(p->force_newton)) return TE_BAD_STREAM;
        if (!te_is_number(p->force_scale) || p->force_scale == 0.0F || !te_is_number(p->force_offset))
            return TE_BAD_STREAM;
        if (!between(p->force_most, 1e-6F, MOST_READING)) return TE_BAD_STREAM;
    }
    if (p->taxels_hz != 0.0F) {
        if (!between(p->taxels_hz, 1.0F, (float)TE_TAXEL_HISTORY / 0.5F)) return TE_BAD_STREAM;
        if (p->taxels < 2U || p->taxels > TE_TAXELS || !flag(p->taxels_pascal)) return TE_BAD_STREAM;
        if (!between(p->taxels_most, 1e-6F, MOST_READING)) return TE_BAD_STREAM;
        for (i = 0; i < p->taxels; ++i) {
            if (!te_is_number(p->taxel_scale[i]) || p->taxel_scale[i] == 0.0F) return TE_BAD_STREAM;
            if (!te_is_number(p->taxel_offset[i])) return TE_BAD_STREAM;
        }
    }
    return p->acceleration_hz > 0.0F || p->force_hz > 0.0F || p->taxels_hz > 0.0F ? TE_ACCEPTED : TE_BAD_STREAM;
}

static int references(float smooth, float rough) {
    return between(smooth, 1e-30F, 1e30F) && between(rough, 1e-30F, 1e30F) && smooth != rough;
}

static enum te_refusal judge_roughness(const struct te_profile* p) {
    if (!flag(p->spectral_absolute) || !flag(p->taxel_dynamic)) return TE_BAD_ROUGHNESS;
    if (!between(p->band_low_hz, 5.0F, 999.0F)) return TE_BAD_ROUGHNESS;
    if (!between(p->spectral_weight, 0.0F, 1e6F) || !between(p->taxel_weight, 0.0F, 1e6F)) return TE_BAD_ROUGHNESS;
    if (!(p->spectral_weight + p->taxel_weight > 0.0F)) return TE_BAD_ROUGHNESS;
    if (!references(p->spectral_smooth, p->spectral_rough)) return TE_BAD_ROUGHNESS;
    if (!references(p->taxel_smooth, p->taxel_rough)) return TE_BAD_ROUGHNESS;
    if (!between(p->smoothing_s, 1e-6F, 60.0F) || !between(p->rest_mean_square, 0.0F, 1e30F)) return TE_BAD_ROUGHNESS;
    if (!between(p->contact_area_cm2, 1e-6F, 1e4F)) return TE_BAD_ROUGHNESS;
    if (!between(p->pressure_min_pa, 0.0F, 1e9F) || !between(p->pressure_max_pa, 0.0F, 1e9F)) return TE_BAD_ROUGHNESS;
    return p->pressure_max_pa > p->pressure_min_pa ? TE_ACCEPTED : TE_BAD_ROUGHNESS;
}

static int ratio(float x) { return x == 0.0F || between(x, 1.000001F, 1000.0F); }

static enum te_refusal judge_encoding(const struct te_profile* p) {
    if (!between(p->amplitude_min_v, 0.01F, TE_MAX_COMMAND_V)) return TE_BAD_ENCODING;
    if (!between(p->amplitude_max_v, p->amplitude_min_v, TE_MAX_COMMAND_V)) return TE_BAD_ENCODING;
    if (!between(p->interval_min_s, TE_MIN_INTERVAL_S, 60.0F)) return TE_BAD_ENCODING;
    if (!between(p->interval_max_s, p->interval_min_s, 60.0F)) return TE_BAD_ENCODING;
    if (p->amplitude_curve > TE_POWER || p->interval_curve > TE_POWER || !flag(p->swapped)) return TE_BAD_ENCODING;
    if (!between(p->amplitude_beta, 0.1F, 10.0F) || !between(p->interval_beta, 0.1F, 10.0F)) return TE_BAD_ENCODING;
    if (!ratio(p->amplitude_ratio) || !ratio(p->interval_ratio)) return TE_BAD_ENCODING;
    return between(p->amplitude_slew_v_s, 0.0F, 1e6F) ? TE_ACCEPTED : TE_BAD_ENCODING;
}

static enum te_refusal judge_output(const struct te_profile* p) {
    if (!flag(p->current_source) || !between(p->load_low_ohm, 1.0F, 1e6F)) return TE_BAD_OUTPUT;
    if (!between(p->load_ohm, p->load_low_ohm, 1e6F) || !between(p->load_high_ohm, p->load_ohm, 1e6F))
        return TE_BAD_OUTPUT;
    if (!between(p->output_step, 0.0F, 1e3F) || !between(p->output_max, 0.001F, 1e3F)) return TE_BAD_OUTPUT;
    if (!between(p->amplitude_error, 0.0F, 0.2F) || !between(p->width_error, 0.0F, 0.2F)) return TE_BAD_OUTPUT;
    if (!between(p->interval_error, 0.0F, 0.2F) || !between(p->rate_error, 0.0F, 0.2F)) return TE_BAD_OUTPUT;
    return TE_ACCEPTED;
}

static enum te_refusal judge_ceilings(const struct te_profile* p) {
    if (!between(p->ceiling_peak_ma, 0.0F, TE_MAX_PEAK_MA)) return TE_BAD_CEILING;
    if (!between(p->ceiling_charge_uc, 0.0F, TE_MAX_CHARGE_UC)) return TE_BAD_CEILING;
    return between(p->ceiling_rms_ma, 0.0F, TE_MAX_RMS_MA) ? TE_ACCEPTED : TE_BAD_CEILING;
}

static enum te_refusal judge_train_form(const struct te_profile* p) {
    struct te_train train;
    train.shape = p->shape;
    train.negative = p->negative;
    train.width_us = p->width_us;
    train.gap_us = p->gap_us;
    train.recharge_ratio = p->recharge_ratio;
    train.pulses = p->pulses;
    train.pulse_hz = p->pulse_hz;
    train.interval_s = p->interval_min_s;
    return judge_form(p, &train);
}

enum te_refusal te_profile_judge(const struct te_profile* p) {
    enum te_refusal refusal = TE_ACCEPTED;
    if (p->layout != TE_LAYOUT) return TE_BAD_LAYOUT;
    if (p->hash != te_hash(p)) return TE_BAD_HASH;
    refusal = judge_streams(p);
    if (refusal == TE_ACCEPTED) refusal = judge_roughness(p);
    if (refusal == TE_ACCEPTED) refusal = judge_encoding(p);
    if (refusal == TE_ACCEPTED) refusal = judge_output(p);
    if (refusal == TE_ACCEPTED) refusal = judge_ceilings(p);
    if (refusal == TE_ACCEPTED) refusal = judge_train_form(p);
    return refusal;
}
