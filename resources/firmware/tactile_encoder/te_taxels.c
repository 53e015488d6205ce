/* The array: its baseline, its spatial feature and its mean (science.md sections 2.5 and 3). */
#include "te_parts.h"

#define SHORTEST_REST_NS INT64_C(250000000)
#define TRAILING_NS INT64_C(250000000)
#define FLOOR_DEVIATIONS 3.0F

void te_taxels_init(struct te_state* state) {
    struct te_taxels* const taxels = &state->taxels;
    const float rate = state->profile.taxels_hz;
    taxels->first_ns = TE_NEVER;
    taxels->valid_ns = TE_NEVER;
    taxels->reach_ns = TE_STALE_NS;
    if (rate > 0.0F && te_ns(1.5F / rate) > TE_STALE_NS) taxels->reach_ns = te_ns(1.5F / rate);
}

static uint32_t oldest(const struct te_taxels* taxels) {
    return taxels->end > TE_TAXEL_HISTORY ? taxels->end - TE_TAXEL_HISTORY : 0U;
}

static int64_t stamp(const struct te_taxels* taxels, uint32_t number) {
    return taxels->t_ns[number % TE_TAXEL_HISTORY];
}

static int64_t newest_ns(const struct te_taxels* taxels) {
    return taxels->end == 0U ? TE_ALWAYS : stamp(taxels, taxels->end - 1U);
}

void te_taxels_push(struct te_state* state, int64_t t_ns, const float* values) {
    struct te_taxels* const taxels = &state->taxels;
    const uint32_t at = taxels->end % TE_TAXEL_HISTORY;
    uint32_t i;
    if (t_ns <= newest_ns(taxels)) return;
    if (taxels->end == 0U) taxels->first_ns = t_ns;
    taxels->t_ns[at] = t_ns;
    for (i = 0; i < state->profile.taxels; ++i) taxels->value[at][i] = values[i];
    ++taxels->end;
    if (taxels->end == 0U) taxels->end = taxels->settled = TE_TAXEL_HISTORY; /* numbers begin anew */
}

/* Running means, because sums would lose their digits in an hour of rest. */
static void add(struct te_rest* rest, const float* values, uint32_t count) {
    float total = 0.0F;
    float share;
    float step;
    uint32_t i;
    if (rest->count < UINT32_MAX) ++rest->count;
    share = 1.0F / (float)rest->count;
    for (i = 0; i < count; ++i) {
        rest->level[i] += (values[i] - rest->level[i]) * share;
        total += values[i];
    }
    total /= (float)count;
    step = total - rest->mean;
    rest->mean += step * share;
    /* The mean of squares, for the same reason. */
    rest->squares += (step * (total - rest->mean) - rest->squares) * share;
}

static void adopt(struct te_state* state, const struct te_rest* rest, int64_t valid_ns) {
    struct te_taxels* const taxels = &state->taxels;
    uint32_t i;
    for (i = 0; i < state->profile.taxels; ++i) taxels->baseline[i] = rest->level[i];
    taxels->floor = rest->squares > 0.0F ? FLOOR_DEVIATIONS * sqrtf(rest->squares) : 0.0F;
    taxels->valid_ns = valid_ns;
    taxels->known = 1U;
}

/* Until when force and taxels are known. */
static int64_t known_ns(const struct te_state* state) {
    const int64_t force = te_known_ns(state);
    const int64_t newest = newest_ns(&state->taxels);
    return force < newest ? force : newest;
}

void te_taxels_settle(struct te_state* state) {
    struct te_taxels* const taxels = &state->taxels;
    const int64_t contact_ns = te_first_contact_ns(state);
    const int64_t known = known_ns(state);
    if (taxels->end == 0U) return;
    if (taxels->settled < oldest(taxels)) taxels->settled = oldest(taxels);
    for (; !taxels->known && taxels->settled != taxels->end; ++taxels->settled) {
        const int64_t t_ns = stamp(taxels, taxels->settled);
        const float* const values = taxels->value[taxels->settled % TE_TAXEL_HISTORY];
        if (t_ns > known) break;
        if (t_ns < contact_ns) add(&taxels->before, values, state->profile.taxels);
        if (t_ns < taxels->first_ns + SHORTEST_REST_NS) add(&taxels->start, values, state->profile.taxels);
    }
    if (taxels->known || known < taxels->first_ns + SHORTEST_REST_NS || known < contact_ns) return;
    if (contact_ns >= taxels->first_ns + SHORTEST_REST_NS && taxels->before.count > 0U) {
        adopt(state, &taxels->before, contact_ns);
    } else {
        adopt(state, &taxels->start, TE_ALWAYS);
    }
}

int te_taxels_ready(const struct te_state* state, int64_t t_ns) {
    const struct te_taxels* const taxels = &state->taxels;
    if (newest_ns(taxels) < t_ns) return 0;
    return taxels->known || known_ns(state) >= taxels->first_ns + SHORTEST_REST_NS;
}

/* What a taxel reads above its baseline. */
static float above(const struct te_taxels* taxels, uint32_t number, uint32_t taxel) {
    const float u = taxels->value[number % TE_TAXEL_HISTORY][taxel] - taxels->baseline[taxel];
    return u > 0.0F ? u : 0.0F;
}

/* Less its own mean over the last 250 ms. */
static void take_trailing_off(const struct te_taxels* taxels, uint32_t number, uint32_t count, float* u) {
    const int64_t since = stamp(taxels, number) - TRAILING_NS;
    uint32_t first = number;
    uint32_t taxel;
    while (first > oldest(taxels) && stamp(taxels, first - 1U) > since) --first;
    for (taxel = 0; taxel < count; ++taxel) {
        float sum = 0.0F;
        uint32_t i;
        for (i = first; i != number + 1U; ++i) sum += above(taxels, i, taxel);
        u[taxel] -= sum / (float)(number - first + 1U);
    }
}

static float mean_of(const float* values, uint32_t count) {
    float sum = 0.0F;
    uint32_t i;
    for (i = 0; i < count; ++i) sum += values[i];
    return sum / (float)count;
}

static float feature(const struct te_state* state, uint32_t number) {
    const struct te_taxels* const taxels = &state->taxels;
    const uint32_t count = state->profile.taxels;
    float u[TE_TAXELS];
    float squares = 0.0F;
    float level;
    float mean;
    uint32_t i;
    for (i = 0; i < count; ++i) u[i] = above(taxels, number, i);
    level = mean_of(u, count);
    if (!(level > 0.0F && level >= taxels->floor)) return te_nan();
    if (state->profile.taxel_dynamic) take_trailing_off(taxels, number, count, u);
    mean = mean_of(u, count);
    for (i = 0; i < count; ++i) squares += (u[i] - mean) * (u[i] - mean);
    return squares > 0.0F ? squares / (float)count / (level * level) : te_nan();
}

static int64_t distance(int64_t a, int64_t b) { return a < b ? b - a : a - b; }

struct te_touch te_taxels_at(const struct te_state* state, int64_t t_ns) {
    const struct te_taxels* const taxels = &state->taxels;
    struct te_touch touch;
    uint32_t nearest;
    touch.v = touch.mean = te_nan();
    if (taxels->end == 0U) return touch;
    nearest = taxels->end - 1U;
    while (nearest > oldest(taxels) && stamp(taxels, nearest) > t_ns) --nearest;
    /* Of two at the same distance the earlier one, whatever the rounding of their stamps. */
    if (nearest + 1U != taxels->end &&
        distance(stamp(taxels, nearest + 1U), t_ns) + TE_ROUNDING_NS < distance(stamp(taxels, nearest), t_ns)) {
        ++nearest;
    }
    if (distance(stamp(taxels, nearest), t_ns) > taxels->reach_ns) return touch;
    touch.mean = mean_of(taxels->value[nearest % TE_TAXEL_HISTORY], state->profile.taxels);
    if (taxels->known && t_ns >= taxels->valid_ns) touch.v = feature(state, nearest);
    return touch;
}
