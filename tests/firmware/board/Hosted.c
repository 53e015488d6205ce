/* The file "tape" through tacto_replay() to the file "made", where there is a C library. */
#include <stdio.h>

#include "tests/firmware/board/Replay.h"

uint32_t tacto_ticks(void) { return 0; }

int main(void) {
    static uint8_t in[3U << 20U], out[1U << 20U];
    FILE* tape = fopen("tape", "rb");
    FILE* made = fopen("made", "wb");
    size_t used;
    if (tape == NULL || made == NULL) return 1;
    used = tacto_replay(in, fread(in, 1, sizeof in, tape), out, sizeof out);
    return used > 0 && fwrite(out, 1, used, made) == used && fclose(made) == 0 ? 0 : 1;
}
