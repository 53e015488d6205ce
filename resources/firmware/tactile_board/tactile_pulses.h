/* tactile_pulses.h - plays trains edge by edge on a timer of the board.
 *
 *     static struct tp_player player = {timer_after, set_output, TICKS_PER_US};
 *     on tb_hardware.play:       tp_play(&player, train, now_us), with the timer's interrupt masked
 *     on the timer's interrupt:  tp_go_on(&player, now_us)
 *
 * Thread-safety: one owner at a time; usable in an interrupt.
 */
#ifndef TACTILE_PULSES_H
#define TACTILE_PULSES_H

#include "../tactile_encoder/tactile_encoder.h"

#ifdef __cplusplus
extern "C" {
#endif

#define TP_STEPS 4U /* leading phase, gap, second phase, and the rest of the period */

/* Zeroed: a train that has ended. */
struct tp_pulses {
    float level[TP_STEPS];    /* V or mA, as the train's amplitude, with its sign */
    uint32_t ticks[TP_STEPS]; /* 0: that step is not there */
    uint32_t step, left;      /* the next one, and how many pulses are not yet over */
};

/* Begins a train, for a timer of `ticks_per_us`; widths are rounded to the nearest tick. Returns 0, and a train that
 * has ended, for one that this timer cannot play: a phase without a tick, or pulses that overlap. */
int tp_begin(struct tp_pulses* pulses, const struct te_train* train, float ticks_per_us);

/* Gives the level from now on. Returns 1 and for how many ticks it lasts; 0 where the train has ended: the level is 0.
 */
int tp_next(struct tp_pulses* pulses, float* level, uint32_t* ticks);

/* The first three are the board's, the rest is zeroed. */
struct tp_player {
    void (*timer_after)(uint32_t ticks); /* its interrupt comes once, after so many; 0: it stops, and none comes */
    void (*set_output)(float level);     /* V or mA, as the train's amplitude; 0: off */
    float ticks_per_us;
    struct tp_pulses pulses;
    struct te_train waiting; /* begins after the one that is played */
    uint32_t plays, waits;
};

/* Plays the train from its onset on, or after the one that is played. Returns 0 where it cannot: two are there already,
 * or the timer cannot play it. Null: ends all, now. */
int tp_play(struct tp_player* player, const struct te_train* train, uint64_t now_us);

/* The next edge is due. */
void tp_go_on(struct tp_player* player, uint64_t now_us);

#ifdef __cplusplus
}
#endif
#endif
