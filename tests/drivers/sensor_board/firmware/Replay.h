/* Replay.h - the firmware's code run over the golden frames: every frame that a board sends, in the order of
 * PROTOCOL.md, then an answer to each sound command among the bytes given. C99 without a library, so that it runs on
 * any machine.
 *
 * Thread-safety: none; one caller. */
#ifndef TACTO_TEST_REPLAY_H
#define TACTO_TEST_REPLAY_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Returns the bytes written to `out`, at most `most`; 0 when they do not fit. A command is answered with DONE, its
 * token, type and stream in the time; SET_CONFIGURATION with the configuration as it was understood. */
size_t tacto_replay(const uint8_t* in, size_t size, uint8_t* out, size_t most);

#ifdef __cplusplus
}
#endif
#endif
