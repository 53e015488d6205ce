/* tactile_pulses.h - the edges of a train one after another, for the timer of a board that plays it.
 *
 *     on tb_hardware.play: tp_begin(&pulses, train, TICKS_PER_US), and the timer to the onset
 *     on the timer:        if (tp_next(&pulses, &level, &ticks)) timer_after(ticks); set(level);
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

#ifdef __cplusplus
}
#endif
#endif
