/* Replay.h - a tape of samples through the encoder: every frame and train that it makes, on any machine.
 *
 * A tape is a struct te_profile and then events, little-endian: kind (a stream, or TACTO_STEP), count, time in ns (of
 * the first sample, or now), step in ns; then count rows of floats. A step asks for frames and for a train. What is
 * made is written as it lies in memory: frames, trains, and at the end the faults seen.
 *
 * Thread-safety: none; one caller. */
#ifndef TACTO_TEST_REPLAY_H
#define TACTO_TEST_REPLAY_H

#include <stddef.h>
#include <stdint.h>

#define TACTO_STEP 3U

struct tacto_event {
    uint32_t kind, count;
    int64_t time_ns;
    int32_t step_ns;
    uint32_t columns;
};

enum tacto_stage {
    TACTO_ACCELERATION,
    TACTO_FORCE,
    TACTO_TAXELS,
    TACTO_FRAMES,
    TACTO_TRANSFORMS,
    TACTO_TRAINS,
    TACTO_STAGES
};

/* What each stage took, in the units of tacto_ticks(); transforms are part of frames. */
extern uint64_t tacto_taken[TACTO_STAGES];
/* Of the machine: counts up. */
uint32_t tacto_ticks(void);

/* Returns the bytes written to `out`, at most `most`; 0 for a tape that is none, or when they do not fit. */
size_t tacto_replay(const uint8_t* in, size_t size, uint8_t* out, size_t most);

#endif
