#include "tactile_pulses.h"

#define MOST_TICKS 4e9F
#define MOST_AHEAD_US 1000000 /* of an onset; a train is handed out at most 5 ms ahead */

/* MOST_TICKS and above, or what is no number: 0. */
static uint32_t ticks_of(float us, float ticks_per_us) {
    const float ticks = us * ticks_per_us;
    return ticks >= 0.0F && ticks < MOST_TICKS ? (uint32_t)(ticks + 0.5F) : 0U;
}

int tp_begin(struct tp_pulses* pulses, const struct te_train* train, float ticks_per_us) {
    const float leading = train->negative ? -train->amplitude : train->amplitude;
    const uint32_t period = ticks_of(1e6F / train->pulse_hz, ticks_per_us);
    const int asymmetric = train->shape == TE_ASYMMETRIC;
    const int two = train->shape != TE_MONOPHASIC;
    uint32_t pulse;
    pulses->left = 0U;
    pulses->step = 0U;
    pulses->level[0] = leading;
    pulses->level[1] = 0.0F;
    pulses->level[2] = asymmetric ? -leading / train->recharge_ratio : -leading;
    pulses->level[3] = 0.0F;
    pulses->ticks[0] = ticks_of(train->width_us, ticks_per_us);
    pulses->ticks[1] = two ? ticks_of(train->gap_us, ticks_per_us) : 0U;
    pulses->ticks[2] =
        two ? ticks_of(asymmetric ? train->width_us * train->recharge_ratio : train->width_us, ticks_per_us) : 0U;
    pulse = pulses->ticks[0] + pulses->ticks[1] + pulses->ticks[2];
    if (pulses->ticks[0] == 0U || (two && pulses->ticks[2] == 0U) || pulse > period) return 0;
    pulses->ticks[3] = period - pulse;
    pulses->left = train->pulses;
    return 1;
}

int tp_next(struct tp_pulses* pulses, float* level, uint32_t* ticks) {
    *level = 0.0F;
    *ticks = 0U;
    while (pulses->left > 0U) {
        const uint32_t step = pulses->step;
        pulses->step = (step + 1U) % TP_STEPS;
        if (pulses->step == 0U) --pulses->left;
        if (step + 1U == TP_STEPS && pulses->left == 0U) break; /* after the last pulse there is no period to fill */
        if (pulses->ticks[step] == 0U) continue;
        *level = pulses->level[step];
        *ticks = pulses->ticks[step];
        return 1;
    }
    return 0;
}

/* From now to the onset. */
static int begin(struct tp_player* player, const struct te_train* train, uint64_t now_us) {
    const int64_t ahead_us = train->onset_ns / 1000 - (int64_t)now_us;
    uint32_t ticks = 0U;
    if (!tp_begin(&player->pulses, train, player->ticks_per_us)) return 0;
    if (ahead_us > 0 && ahead_us < MOST_AHEAD_US) ticks = ticks_of((float)ahead_us, player->ticks_per_us);
    player->plays = 1U;
    player->timer_after(ticks > 0U ? ticks : 1U);
    return 1;
}

static void end(struct tp_player* player) {
    player->set_output(0.0F);
    player->plays = 0U;
}

int tp_play(struct tp_player* player, const struct te_train* train, uint64_t now_us) {
    struct tp_pulses judged;
    if (!train) {
        player->timer_after(0U);
        end(player);
        player->waits = 0U;
        return 1;
    }
    if (!player->plays) return begin(player, train, now_us);
    if (player->waits || !tp_begin(&judged, train, player->ticks_per_us)) return 0;
    player->waiting = *train;
    player->waits = 1U;
    return 1;
}

void tp_go_on(struct tp_player* player, uint64_t now_us) {
    float level;
    uint32_t ticks;
    if (!player->plays) return;
    if (tp_next(&player->pulses, &level, &ticks)) {
        player->timer_after(ticks);
        player->set_output(level);
        return;
    }
    end(player);
    if (!player->waits) return;
    player->waits = 0U;
    (void)begin(player, &player->waiting, now_us); /* which was judged when it came */
}
