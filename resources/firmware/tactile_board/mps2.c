/* mps2.c - a whole board on ARM's MPS2 as QEMU has it (mps2-an386, mps2-an500): the host on its first UART.
 *
 *     tactoscope-cli firmware-profile PROFILE --load 1000 --out tactile_profile.h
 *     arm-none-eabi-gcc -std=gnu99 -O2 -ffp-contract=off -mcpu=cortex-m4 -mthumb -mfloat-abi=hard -mfpu=fpv4-sp-d16 \
 *         -nostartfiles --specs=nano.specs -I. -I../tactile_encoder -T mps2.ld -o board.elf mps2.c tactile_*.c \
 *         ../tactile_encoder/te_*.c ../sensor_board/tsb_*.c -lm
 *     qemu-system-arm -M mps2-an386 -nographic -monitor none -serial pty -kernel board.elf
 *     tactoscope-cli sensor status 'sensor:?tty=/dev/pts/3&emulated=yes'
 *
 * The machine has no sensors, so read() makes up a finger: untouched for a second, then rubbed for three. It has no
 * converter, so set_output() lights a lamp. On a real board these two, the clock and the UART are what is different:
 * stm32f405.c is one.
 */
#include "tactile_board.h"
#include "tactile_profile.h"
#include "tactile_pulses.h"

#define REGISTER(address) (*(volatile uint32_t*)(address))
#define COPROCESSORS REGISTER(0xE000ED88U)
#define INTERRUPTS_ON REGISTER(0xE000E100U)
#define BEAT_CONTROL REGISTER(0xE000E010U)
#define BEAT_RELOAD REGISTER(0xE000E014U)
/* Arm DDI 0479 (CMSDK) sections 4.1 (timer) and 4.3 (UART); AN386 section 3.8 (lamps). */
#define CLOCK_CONTROL REGISTER(0x40000000U)
#define CLOCK_VALUE REGISTER(0x40000004U)
#define CLOCK_RELOAD REGISTER(0x40000008U)
#define PULSES_CONTROL REGISTER(0x40001000U)
#define PULSES_VALUE REGISTER(0x40001004U)
#define PULSES_RELOAD REGISTER(0x40001008U)
#define PULSES_CLEAR REGISTER(0x4000100CU)
#define PULSES_INTERRUPT 9U
#define UART_DATA REGISTER(0x40004000U)
#define UART_STATE REGISTER(0x40004004U)
#define UART_CONTROL REGISTER(0x40004008U)
#define UART_DIVIDER REGISTER(0x40004010U)
#define UART_SENDING 1U
#define UART_RECEIVED 2U
#define LAMPS REGISTER(0x40028000U)
#define TICKS_PER_US 25U
#define BEAT_US 500U

extern uint32_t stack_high[], bss_low[], bss_high[];
void reset(void);
void beat(void);
void play_on(void);
/* Weak, so that tests may have their own. */
void nothing(void);
void set_output(float level);
void clock_begin(void);

__attribute__((weak)) void nothing(void) {
    set_output(0.0F);
    for (;;) {
    }
}

struct vectors {
    const uint32_t* stack;
    void (*handler[15 + 32])(void);
};
__attribute__((section(".vectors"), used)) static const struct vectors vectors = {stack_high,
                                                                                  {[0] = reset,
                                                                                   [1] = nothing,
                                                                                   [2] = nothing,
                                                                                   [3] = nothing,
                                                                                   [4] = nothing,
                                                                                   [5] = nothing,
                                                                                   [14] = beat,
                                                                                   [15 + PULSES_INTERRUPT] = play_on}};

/* The clock ------------------------------------------------------------------------------------------------------ */

static uint32_t last, ticks;
static uint64_t now;

static uint32_t mask(void) {
    uint32_t masked;
    __asm__ volatile("mrs %0, primask\n\tcpsid i" : "=r"(masked)::"memory");
    return masked;
}

static void unmask(uint32_t masked) { __asm__ volatile("msr primask, %0" ::"r"(masked) : "memory"); }

void clock_begin(void) {
    CLOCK_RELOAD = 0xFFFFFFFFU;
    CLOCK_CONTROL = 1U;
    last = CLOCK_VALUE;
}

/* Asked for more often than the counter wraps, every 171 s; in interrupts too. */
static uint64_t now_us(void* context) {
    const uint32_t masked = mask();
    const uint32_t value = CLOCK_VALUE;
    uint64_t read;
    (void)context;
    ticks += last - value;
    last = value;
    now += ticks / TICKS_PER_US;
    ticks %= TICKS_PER_US;
    read = now;
    unmask(masked);
    return read;
}

/* The host ------------------------------------------------------------------------------------------------------- */

#define LINE 4096U
static uint8_t line[LINE];
static uint32_t line_end, line_sent;

static void send_on(void) {
    while (line_sent != line_end && !(UART_STATE & UART_SENDING)) UART_DATA = line[line_sent++ % LINE];
}

static size_t hear(void* context, uint8_t* bytes, size_t most) {
    size_t count = 0;
    (void)context;
    send_on();
    while (count < most && (UART_STATE & UART_RECEIVED)) bytes[count++] = (uint8_t)UART_DATA;
    return count;
}

static int say(void* context, const uint8_t* frame, size_t size) {
    size_t i;
    (void)context;
    if (size > LINE - (line_end - line_sent)) return 0;
    for (i = 0; i < size; ++i) line[line_end++ % LINE] = frame[i];
    send_on();
    return 1;
}

/* The finger ----------------------------------------------------------------------------------------------------- */

static const struct tb_setup setup = {
    .name = "Tactile board on MPS2",
    .serial = "EMU-MPS2",
    .firmware = "1",
    .streams = 3,
    .configuration =
        {{0,
          TSB_STREAM_ENABLED,
          TSB_KIND_ACCELERATION,
          TSB_UNIT_METRE_PER_SECOND_SQUARED,
          TSB_FORMAT_INT16,
          3,
          4000000U,
          {0.005F, 0.005F, 0.005F},
          {0}},
         {1,
          TSB_STREAM_ENABLED,
          TSB_KIND_TAXELS,
          TSB_UNIT_PASCAL,
          TSB_FORMAT_INT16,
          8,
          200000U,
          {2.0F, 2.0F, 2.0F, 2.0F, 2.0F, 2.0F, 2.0F, 2.0F},
          {0}},
         {2, TSB_STREAM_ENABLED, TSB_KIND_FORCE, TSB_UNIT_NEWTON, TSB_FORMAT_INT16, 1, 200000U, {0.0005F}, {0}}},
    .calibration = {{.date = "", .reference = ""}, {.date = "", .reference = ""}, {.date = "", .reference = ""}},
    .profile = &tactile_profile,
    .rested = 1, /* this machine has no stimulator */
};

static const uint8_t counts[TB_STREAMS] = {32, 2, 2};
static const uint32_t intervals_us[TB_STREAMS] = {250, 5000, 5000};
static uint64_t next_us[TB_STREAMS]; /* the first sample of the next block */
static uint32_t chance;

/* Of no mean, at most `most` either way. */
static int32_t noise(int32_t most) {
    chance = chance * 1664525U + 1013904223U;
    return (int32_t)(chance >> 16U) % (2 * most + 1) - most;
}

static int32_t felt(uint8_t stream, uint32_t column, int touched) {
    if (stream == 0U) return noise(touched ? 400 : 6) + (column == 2U ? 1962 : 0); /* gravity on z */
    if (stream == 1U) return 250 + noise(5) + (touched ? 1500 + 150 * (int32_t)column : 0);
    return noise(4) + (touched ? 2000 : 0);
}

static int read(void* context, struct tb_samples* samples) {
    const uint64_t until = now_us(context);
    uint8_t s;
    for (s = 0; s < TB_STREAMS; ++s) {
        const uint32_t columns = setup.configuration[s].columns;
        const int touched = (uint32_t)(next_us[s] / 1000U) % 4000U >= 1000U;
        uint32_t i;
        if (next_us[s] + (uint64_t)(counts[s] - 1U) * intervals_us[s] > until) continue;
        samples->stream = s;
        samples->count = counts[s];
        samples->lost = 0U;
        samples->first_us = next_us[s];
        samples->interval_ns = intervals_us[s] * 1000U;
        for (i = 0; i < counts[s] * columns; ++i) samples->raw[i] = felt(s, i % columns, touched);
        next_us[s] += (uint64_t)counts[s] * intervals_us[s];
        return 1;
    }
    return 0;
}

/* The stimulator -------------------------------------------------------------------------------------------------- */

__attribute__((weak)) void set_output(float level) { LAMPS = level != 0.0F; }

static void timer_after(uint32_t after) {
    PULSES_CONTROL = 0U;
    if (after == 0U) return;
    PULSES_RELOAD = after;
    PULSES_VALUE = after;
    PULSES_CONTROL = 9U; /* runs, and interrupts */
}

static struct tp_player player = {.timer_after = timer_after, .set_output = set_output, .ticks_per_us = TICKS_PER_US};

/* The pulses' timer, which would go round. */
void play_on(void) {
    PULSES_CONTROL = 0U;
    PULSES_CLEAR = 1U;
    tp_go_on(&player, now_us((void*)0));
}

static int play(void* context, const struct te_train* train) {
    const uint32_t masked = mask();
    const int good = tp_play(&player, train, now_us(context));
    unmask(masked);
    return good;
}

/* The program ------------------------------------------------------------------------------------------------------ */

static const struct tb_hardware hardware = {(void*)0, now_us, read, hear, say, play};
static struct tb_board board;

/* Wakes the program, which sleeps between its rounds. */
void beat(void) {}

__attribute__((noreturn)) void reset(void) {
    uint32_t* at;
    COPROCESSORS |= 0xFU << 20U;
    __asm__ volatile("dsb\n\tisb");
    set_output(0.0F);
    for (at = bss_low; at < bss_high; ++at) *at = 0U;
    clock_begin();
    UART_DIVIDER = 16U;
    UART_CONTROL = 3U;
    BEAT_RELOAD = BEAT_US * TICKS_PER_US - 1U;
    BEAT_CONTROL = 7U;
    INTERRUPTS_ON = 1U << PULSES_INTERRUPT;
    if (!tb_init(&board, &setup, &hardware)) nothing();
    for (;;) {
        tb_step(&board);
        __asm__ volatile("wfi");
    }
}
