/* The same on a bare Cortex-M with semihosting (ARM's "Semihosting for AArch32 and AArch64"): the file "tape" through
 * tacto_replay() to the file "made", and to "counts" what it took: instructions of each stage, bytes of stack and of
 * state. Under `qemu-system-arm -icount shift=6` an instruction is 64 ns of the 25 MHz SysTick: 1.6 ticks. */
#include "resources/firmware/tactile_encoder/te_parts.h"
#include "tests/firmware/board/Replay.h"

#define SYSTICK_CONTROL (*(volatile uint32_t*)0xE000E010U)
#define SYSTICK_RELOAD (*(volatile uint32_t*)0xE000E014U)
#define SYSTICK_CURRENT (*(volatile uint32_t*)0xE000E018U)
#define COPROCESSORS (*(volatile uint32_t*)0xE000ED88U)
#define PAINT 0x5AFE5AFEU

extern uint32_t stack_low[], stack_high[];
void reset(void);

/* What the core loads first: the stack's end and where to begin. */
struct vectors {
    const uint32_t* stack;
    void (*begin)(void);
};
__attribute__((section(".vectors"), used)) static const struct vectors vectors = {stack_high, reset};

static int call(int operation, const void* argument) {
    register int result __asm__("r0") = operation;
    register const void* given __asm__("r1") = argument;
    __asm__ volatile("bkpt 0xAB" : "+r"(result) : "r"(given) : "memory");
    return result;
}

static int open_file(const char* name, uint32_t length, uint32_t mode) {
    const uint32_t arguments[3] = {(uint32_t)name, mode, length};
    return call(0x01, arguments);
}

/* Returns how many bytes were not read or written. */
static uint32_t move(int operation, int file, const void* bytes, uint32_t size) {
    const uint32_t arguments[3] = {(uint32_t)file, (uint32_t)bytes, size};
    return (uint32_t)call(operation, arguments);
}

static void end(int good) { call(0x18, (const void*)(good ? 0x20026U : 0x20023U)); }

static uint32_t last, passed;

/* The counter has 24 bits and counts down; it is asked more often than it wraps, every 10 million instructions. */
uint32_t tacto_ticks(void) {
    const uint32_t now = SYSTICK_CURRENT;
    passed += (last - now) & 0xFFFFFFU;
    last = now;
    return passed;
}

struct te_power __real_te_window_power(struct te_spectrum* spectrum, const struct te_acceleration* from, uint32_t axes,
                                       uint32_t first, int undone);
struct te_power __wrap_te_window_power(struct te_spectrum* spectrum, const struct te_acceleration* from, uint32_t axes,
                                       uint32_t first, int undone);

struct te_power __wrap_te_window_power(struct te_spectrum* spectrum, const struct te_acceleration* from, uint32_t axes,
                                       uint32_t first, int undone) {
    const uint32_t begun = tacto_ticks();
    const struct te_power power = __real_te_window_power(spectrum, from, axes, first, undone);
    tacto_taken[TACTO_TRANSFORMS] += tacto_ticks() - begun;
    return power;
}

static uint32_t stack_used(void) {
    const uint32_t* at = stack_low;
    while (*at == PAINT) ++at;
    return (uint32_t)((const uint8_t*)stack_high - (const uint8_t*)at);
}

static void run(void) {
    static uint8_t in[3U << 20U], out[900U << 10U];
    uint64_t counts[TACTO_STAGES + 2U];
    const int tape = open_file("tape", 4, 1);
    const int made = open_file("made", 4, 5);
    const int taken = open_file("counts", 6, 5);
    size_t used;
    uint32_t i;
    if (tape < 0 || made < 0 || taken < 0) end(0);
    used = tacto_replay(in, sizeof in - move(0x06, tape, in, sizeof in), out, sizeof out);
    for (i = 0; i < TACTO_STAGES; ++i) counts[i] = tacto_taken[i] * 5U / 8U;
    counts[TACTO_STAGES] = stack_used();
    counts[TACTO_STAGES + 1U] = sizeof(struct te_state);
    end(used > 0 && move(0x05, made, out, (uint32_t)used) == 0 && move(0x05, taken, counts, sizeof counts) == 0);
}

__attribute__((noreturn)) void reset(void) {
    uint32_t* at;
    COPROCESSORS |= 0xFU << 20U;
    __asm__ volatile("dsb\n\tisb");
    for (at = stack_low; at < (uint32_t*)__builtin_frame_address(0) - 16; ++at) *at = PAINT;
    SYSTICK_RELOAD = 0xFFFFFFU;
    SYSTICK_CURRENT = 0;
    SYSTICK_CONTROL = 5U;
    run();
    for (;;) {
    }
}
