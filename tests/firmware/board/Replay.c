#include "tests/firmware/board/Replay.h"

#include "resources/firmware/tactile_encoder/te_parts.h"

uint64_t tacto_taken[TACTO_STAGES];
static struct te_state state;

struct output {
    uint8_t* bytes;
    size_t used, most;
    int overflow;
};

static void copy(void* to, const void* from, size_t size) {
    size_t i;
    for (i = 0; i < size; ++i) ((uint8_t*)to)[i] = ((const uint8_t*)from)[i];
}

static void put(struct output* out, const void* from, size_t size) {
    if (size > out->most - out->used) {
        out->overflow = 1;
        return;
    }
    copy(out->bytes + out->used, from, size);
    out->used += size;
}

static void step(struct output* out, int64_t now_ns) {
    struct te_reading frame;
    struct te_train train;
    uint32_t fault;
    uint32_t begun = tacto_ticks();
    int made;
    while ((made = te_frame(&state, &frame)) != 0) {
        tacto_taken[TACTO_FRAMES] += tacto_ticks() - begun;
        put(out, &frame, offsetof(struct te_reading, P) + sizeof frame.P); /* not what lies behind it */
        begun = tacto_ticks();
    }
    tacto_taken[TACTO_FRAMES] += tacto_ticks() - begun;
    begun = tacto_ticks();
    made = te_next_train(&state, now_ns, &train);
    tacto_taken[TACTO_TRAINS] += tacto_ticks() - begun;
    if (made) put(out, &train, sizeof train);
    fault = te_fault(&state, now_ns);
    put(out, &fault, sizeof fault);
}

static void feed(const struct tacto_event* event, const uint8_t* rows) {
    static float values[1024];
    uint32_t begun;
    copy(values, rows, (size_t)event->count * event->columns * sizeof values[0]);
    begun = tacto_ticks();
    te_samples(&state, (enum te_stream)event->kind, event->time_ns, event->step_ns, values, event->count);
    tacto_taken[event->kind] += tacto_ticks() - begun;
}

size_t tacto_replay(const uint8_t* in, size_t size, uint8_t* out, size_t most) {
    struct output output = {out, 0, most, 0};
    struct te_profile profile;
    struct tacto_event event;
    size_t at = sizeof profile;
    if (size < at) return 0;
    copy(&profile, in, sizeof profile);
    if (te_init(&state, &profile) != TE_ACCEPTED) return 0;
    te_rested(&state);
    while (size - at >= sizeof event) {
        size_t rows;
        copy(&event, in + at, sizeof event);
        at += sizeof event;
        if (event.kind == TACTO_STEP) {
            step(&output, event.time_ns);
            continue;
        }
        rows = (size_t)event.count * event.columns;
        if (event.kind > TACTO_STEP || rows > 1024U || rows * 4U > size - at) return 0;
        feed(&event, in + at);
        at += rows * 4U;
    }
    return output.overflow ? 0 : output.used;
}
