/* Standard input through tacto_replay() to standard output, where there is a C library. */
#include <stdio.h>

#include "tests/drivers/sensor_board/firmware/Replay.h"

int main(void) {
    static uint8_t in[65536], out[65536];
    const size_t size = fread(in, 1, sizeof in, stdin);
    const size_t used = tacto_replay(in, size, out, sizeof out);
    return used > 0 && fwrite(out, 1, used, stdout) == used ? 0 : 1;
}
