/* stm32f405.c - a whole board on an STM32F405 by its registers (ST RM0090), built as mps2.c says, with stm32f405.ld.
 * The project compiles it and has not run it on one: try it without a stimulator first (resources/help/guide/board.md).
 *
 *     PA0 PA1 PA2            acceleration x, y, z: an analog accelerometer, filtered below 2 kHz
 *     PA3                    force
 *     PA5 PA6 PA7 PB0 PB1 PC0 PC1 PC2   taxels
 *     PA9 PA10               host: UART 1, 921 600 bit/s
 *     PA4, PB12, PB13        stimulator: size (0 to 3.3 V for 0 to FULL_SCALE), negative, on
 *     PC13                   stop: pressed is low
 *     8 MHz crystal
 *
 * A timer has all twelve voltages converted 4000 times a second; of force and taxels a sample is the mean of twenty.
 * Each analog line has a resistor to ground: a pulled sensor reads 0, no contact or a signal that stands still.
 *
 * The DAC's buffer gives 0.2 to 3.1 V. A train with a phase outside that (0.061 to 0.939 of FULL_SCALE), be it the weak
 * second one of an asymmetric pulse, is refused: output stays off, and the board stops unless that train was waiting.
 *
 * PB13 is driven by the boot ROM (CAN 2) while BOOT0 is high: disconnect the stimulator while firmware is written.
 * After a reset that is no power-on (watchdog, NRST, debugger) it plays nothing by itself: switch the power off and on.
 */
#include "tactile_board.h"
#include "tactile_profile.h"
#include "tactile_pulses.h"

#define FULL_SCALE 60.0F /* V or mA of the stimulator at 3.3 V */
#define LEAST (FULL_SCALE * 0.2F / 3.3F)
#define MOST (FULL_SCALE * 3.1F / 3.3F)
#define ALONE 0U /* 1: it stimulates without a host */

#define REGISTER(address) (*(volatile uint32_t*)(address))
#define COPROCESSORS REGISTER(0xE000ED88U)
#define INTERRUPTS_ON_32 REGISTER(0xE000E104U) /* 32 to 63 */
#define PRIORITY(interrupt) (*(volatile uint8_t*)(0xE000E400U + (interrupt)))
#define RCC(offset) REGISTER(0x40023800U + (offset))
#define FLASH_ACR REGISTER(0x40023C00U)
#define GPIOA(offset) REGISTER(0x40020000U + (offset))
#define GPIOB(offset) REGISTER(0x40020400U + (offset))
#define GPIOC(offset) REGISTER(0x40020800U + (offset))
#define MODER 0x00U
#define PULLS 0x0CU
#define IDR 0x10U
#define BSRR 0x18U
#define AFRH 0x24U
#define TIM2(offset) REGISTER(0x40000000U + (offset)) /* the clock, 1 MHz, 32 bits */
#define TIM3(offset) REGISTER(0x40000400U + (offset)) /* 4 kHz */
#define TIM5(offset) REGISTER(0x40000C00U + (offset)) /* pulses, 84 MHz, 32 bits */
#define TIM_CR1 0x00U
#define TIM_CR2 0x04U
#define TIM_DIER 0x0CU
#define TIM_SR 0x10U
#define TIM_EGR 0x14U
#define TIM_CNT 0x24U
#define TIM_PSC 0x28U
#define TIM_ARR 0x2CU
#define DAC(offset) REGISTER(0x40007400U + (offset))
#define ADC(offset) REGISTER(0x40012000U + (offset))
#define DMA2(offset) REGISTER(0x40026400U + (offset))
#define USART(offset) REGISTER(0x40011000U + (offset))
#define SYSCFG_EXTICR4 REGISTER(0x40013814U)
#define EXTI(offset) REGISTER(0x40013C00U + (offset))
#define IWDG(offset) REGISTER(0x40003000U + (offset))
#define IRQ_USART1 37U
#define IRQ_EXTI15_10 40U
#define IRQ_TIM5 50U
#define IRQ_DMA2_0 56U
#define PULSE_TICKS_PER_US 84U

extern uint32_t stack_high[], bss_low[], bss_high[], data_low[], data_high[], data_stored[];
void reset(void);
void halt(void);
void on_host(void);
void on_stop(void);
void on_pulse(void);
void on_samples(void);

struct vectors {
    const uint32_t* stack;
    void (*handler[15 + 82])(void);
};
__attribute__((section(".vectors"), used)) static const struct vectors vectors = {stack_high,
                                                                                  {[0] = reset,
                                                                                   [1] = halt,
                                                                                   [2] = halt,
                                                                                   [3] = halt,
                                                                                   [4] = halt,
                                                                                   [5] = halt,
                                                                                   [15 + IRQ_USART1] = on_host,
                                                                                   [15 + IRQ_EXTI15_10] = on_stop,
                                                                                   [15 + IRQ_TIM5] = on_pulse,
                                                                                   [15 + IRQ_DMA2_0] = on_samples}};

static uint32_t mask(void) {
    uint32_t masked;
    __asm__ volatile("mrs %0, primask\n\tcpsid i" : "=r"(masked)::"memory");
    return masked;
}

static void unmask(uint32_t masked) { __asm__ volatile("msr primask, %0" ::"r"(masked) : "memory"); }

/* The clock ------------------------------------------------------------------------------------------------------ */

static uint32_t last;
static uint64_t now;

/* Asked for more often than the counter wraps, every 71 minutes; in interrupts too. */
static uint64_t now_us(void* context) {
    const uint32_t masked = mask();
    const uint32_t value = TIM2(TIM_CNT);
    uint64_t read;
    (void)context;
    now += value - last;
    last = value;
    read = now;
    unmask(masked);
    return read;
}

/* The host ------------------------------------------------------------------------------------------------------- */

#define LINE 4096U
static uint8_t out[LINE], in[LINE];
static volatile uint32_t out_end, out_sent, in_end, in_heard;

void on_host(void) {
    const uint32_t state = USART(0x00U);
    if (state & 0x28U) { /* received, or overrun */
        const uint8_t byte = (uint8_t)USART(0x04U);
        if (in_end - in_heard < LINE) in[in_end++ % LINE] = byte;
    }
    if (!(state & 0x80U)) return;
    if (out_sent == out_end) {
        USART(0x0CU) &= ~0x80U;
    } else {
        USART(0x04U) = out[out_sent++ % LINE];
    }
}

static size_t hear(void* context, uint8_t* bytes, size_t most) {
    size_t count = 0;
    (void)context;
    while (count < most && in_heard != in_end) bytes[count++] = in[in_heard++ % LINE];
    return count;
}

static int say(void* context, const uint8_t* frame, size_t size) {
    uint32_t masked;
    size_t i;
    (void)context;
    if (size > LINE - (out_end - out_sent)) return 0;
    for (i = 0; i < size; ++i) out[(out_end + i) % LINE] = frame[i];
    masked = mask();
    out_end += (uint32_t)size;
    USART(0x0CU) |= 0x80U;
    unmask(masked);
    return 1;
}

/* Sensors -------------------------------------------------------------------------------------------------------- */

#define CHANNELS 12U /* three of acceleration, force, eight taxels */
#define ROWS 20U     /* 5 ms */
#define HALVES 8U

/* Volts at 3.3 V and 12 bits, times what the sensor's data sheet says, until `sensor-calibration` knows better. */
static struct tb_setup setup = {
    .name = "Tactile board",
    .serial = "F405-0001",
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
          {0.05F, 0.05F, 0.05F},
          {-102.4F, -102.4F, -102.4F}},
         {1,
          TSB_STREAM_ENABLED,
          TSB_KIND_TAXELS,
          TSB_UNIT_PASCAL,
          TSB_FORMAT_INT16,
          8,
          200000U,
          {20.0F, 20.0F, 20.0F, 20.0F, 20.0F, 20.0F, 20.0F, 20.0F},
          {0}},
         {2, TSB_STREAM_ENABLED, TSB_KIND_FORCE, TSB_UNIT_NEWTON, TSB_FORMAT_INT16, 1, 200000U, {0.005F}, {0}}},
    .calibration = {{.date = "", .reference = ""}, {.date = "", .reference = ""}, {.date = "", .reference = ""}},
    .range = {{8, 4087}, {0, 4087}, {0, 4087}}, /* untouched, taxels and force may read 0 */
    .profile = &tactile_profile,
    .alone = ALONE,
};

static volatile uint16_t converted[2U * ROWS * CHANNELS];
/* Halves of the buffer that are waiting, with the time of their last row; what is not read in time is lost. */
static volatile uint64_t half_us[HALVES];
static volatile uint32_t half_end;
static uint32_t half_read, part;
static uint16_t rows[ROWS * CHANNELS];

void on_samples(void) {
    const uint32_t flags = DMA2(0x00U) & 0x3DU; /* of stream 0: 0x10 first half, 0x20 second half */
    const uint64_t us = now_us((void*)0);
    DMA2(0x08U) = flags;
    if ((flags & 0x30U) == 0x30U) {
        half_us[half_end % HALVES] = us - (uint64_t)250U * ROWS;
        ++half_end;
    }
    if ((flags & 0x30U) == 0U) return;
    half_us[half_end % HALVES] = us;
    ++half_end;
}

static int32_t mean_of(uint32_t channel) {
    uint32_t sum = 0U;
    uint32_t i;
    for (i = 0; i < ROWS; ++i) sum += rows[i * CHANNELS + channel];
    return (int32_t)((sum + ROWS / 2U) / ROWS);
}

/* Copies the half that was converted last; not one that the converter writes again meanwhile. */
static int take_half(uint32_t* lost) {
    const uint32_t end = half_end;
    const volatile uint16_t* const from = converted + ((end & 1U) ? 0U : ROWS * CHANNELS);
    uint32_t i;
    if (half_read == end) return 0;
    for (i = 0; i < ROWS * CHANNELS; ++i) rows[i] = from[i];
    if (half_end != end) return 0;
    *lost = end - half_read - 1U;
    half_read = end;
    return 1;
}

static int read(void* context, struct tb_samples* samples) {
    static uint32_t lost;
    uint32_t i;
    (void)context;
    if (part == 0U && !take_half(&lost)) return 0;
    samples->stream = (uint8_t)part;
    samples->first_us = half_us[(half_read - 1U) % HALVES];
    if (part == 0U) {
        samples->count = ROWS;
        samples->lost = lost * ROWS;
        samples->first_us -= (uint64_t)250U * (ROWS - 1U);
        samples->interval_ns = 250000U;
        for (i = 0; i < ROWS * 3U; ++i) samples->raw[i] = rows[i / 3U * CHANNELS + i % 3U];
    } else {
        samples->count = 1U;
        samples->lost = lost;
        samples->first_us -= (uint64_t)125U * (ROWS - 1U); /* the middle of the twenty */
        samples->interval_ns = 5000000U;
        if (part == 2U) samples->raw[0] = mean_of(3U);
        for (i = 0; part == 1U && i < 8U; ++i) samples->raw[i] = mean_of(4U + i);
    }
    part = (part + 1U) % TB_STREAMS;
    return 1;
}

/* The stimulator -------------------------------------------------------------------------------------------------- */

static void set_output(float level) {
    float size = (level < 0.0F ? -level : level) * (4095.0F / FULL_SCALE);
    if (size > 4095.0F) size = 4095.0F; /* by rounding only: can_give() has judged it */
    if (!(size > 0.0F)) {
        GPIOB(BSRR) = 0x30000000U; /* off, not negative */
        DAC(0x08U) = 0U;
        return;
    }
    DAC(0x08U) = (uint32_t)size;
    GPIOB(BSRR) = level < 0.0F ? 0x3000U : 0x10002000U;
}

static void timer_after(uint32_t ticks) {
    TIM5(TIM_CR1) = 0U;
    if (ticks == 0U) return;
    TIM5(TIM_CNT) = 0U;
    TIM5(TIM_ARR) = ticks > 1U ? ticks - 1U : 1U;
    TIM5(TIM_SR) = 0U;
    TIM5(TIM_CR1) = 9U; /* once */
}

static struct tp_player player = {
    .timer_after = timer_after, .set_output = set_output, .ticks_per_us = PULSE_TICKS_PER_US};

void on_pulse(void) {
    TIM5(TIM_SR) = 0U;
    tp_go_on(&player, now_us((void*)0));
}

static int is_given(float level) {
    const float size = level < 0.0F ? -level : level;
    return size >= LEAST && size <= MOST;
}

static int can_give(const struct te_train* train) {
    struct tp_pulses pulses;
    return tp_begin(&pulses, train, PULSE_TICKS_PER_US) && is_given(pulses.level[0]) && is_given(pulses.level[2]);
}

static int play(void* context, const struct te_train* train) {
    const uint32_t masked = mask();
    const int good = (!train || can_give(train)) && tp_play(&player, train, now_us(context));
    unmask(masked);
    return good;
}

/* The program ------------------------------------------------------------------------------------------------------ */

static const struct tb_hardware hardware = {(void*)0, now_us, read, hear, say, play};
static struct tb_board board;

void on_stop(void) {
    EXTI(0x14U) = 1U << 13U;
    tb_stop(&board);
}

/* What nothing else expects, and a crystal that stops: output off, and the watchdog makes a new start of it. */
void halt(void) {
    GPIOB(BSRR) = 0x30000000U;
    for (;;) {
    }
}

/* 168 MHz from 8 MHz; 42 and 84 MHz for the two buses, 84 and 168 MHz for their timers. */
static void begin_clocks(void) {
    RCC(0x00U) |= 1U << 16U;
    while (!(RCC(0x00U) & (1U << 17U))) {
    }
    RCC(0x00U) |= 1U << 19U; /* where the crystal stops, NMI: halt() */
    FLASH_ACR = 0x705U;
    RCC(0x04U) = 8U | (336U << 6U) | (1U << 22U) | (7U << 24U);
    RCC(0x00U) |= 1U << 24U;
    while (!(RCC(0x00U) & (1U << 25U))) {
    }
    RCC(0x08U) = (5U << 10U) | (4U << 13U) | 2U;
    while ((RCC(0x08U) & 0xCU) != 8U) {
    }
    RCC(0x30U) |= (1U << 22U) | 7U;                      /* DMA2, ports A to C */
    RCC(0x40U) |= (1U << 29U) | (1U << 3U) | 3U;         /* DAC, timers 5, 3, 2 */
    RCC(0x44U) |= (1U << 14U) | (1U << 8U) | (1U << 4U); /* SYSCFG, ADC1, UART 1 */
}

static void begin_pins(void) {
    GPIOB(BSRR) = 0x30000000U;
    GPIOB(MODER) = (GPIOB(MODER) & ~0x0F00000FU) | 0x0500000FU; /* 12 and 13 out; 0 and 1 analog */
    GPIOA(MODER) = (GPIOA(MODER) & ~0x003CFFFFU) | 0x0028FFFFU; /* 0 to 7 analog; 9 and 10 UART */
    GPIOA(AFRH) = (GPIOA(AFRH) & ~0x00000FF0U) | 0x00000770U;
    GPIOC(MODER) |= 0x0000003FU; /* 0 to 2 analog; 13 in */
    GPIOC(PULLS) |= 1U << 26U;
}

static void begin_timers(void) {
    TIM2(TIM_PSC) = 83U;
    TIM2(TIM_ARR) = 0xFFFFFFFFU;
    TIM2(TIM_EGR) = 1U;
    TIM2(TIM_CR1) = 1U;
    TIM5(TIM_PSC) = 0U;
    TIM5(TIM_EGR) = 1U;
    TIM5(TIM_SR) = 0U;
    TIM5(TIM_DIER) = 1U;
    TIM3(TIM_PSC) = 83U;
    TIM3(TIM_ARR) = 249U;
    TIM3(TIM_CR2) = 0x20U; /* each update starts a conversion */
}

static void begin_converters(void) {
    DAC(0x08U) = 0U;
    DAC(0x00U) = 1U;
    DMA2(0x18U) = 0x4001204CU;
    DMA2(0x1CU) = (uint32_t)converted;
    DMA2(0x14U) = 2U * ROWS * CHANNELS;
    DMA2(0x10U) = 0x00002D18U | 1U;    /* 16 bits to 16 bits, memory counts on, circular; both halves interrupt */
    REGISTER(0x40012304U) = 1U << 16U; /* 21 MHz */
    ADC(0x0CU) = 0x00000049U;          /* 15 cycles: channels 10 to 12 */
    ADC(0x10U) = 0x09249249U;          /* channels 0 to 9 */
    ADC(0x2CU) = (CHANNELS - 1U) << 20U;
    ADC(0x34U) = 0U | (1U << 5U) | (2U << 10U) | (3U << 15U) | (5U << 20U) | (6U << 25U);
    ADC(0x30U) = 7U | (8U << 5U) | (9U << 10U) | (10U << 15U) | (11U << 20U) | (12U << 25U);
    ADC(0x04U) = 1U << 8U;
    ADC(0x08U) = (1U << 28U) | (8U << 24U) | (1U << 9U) | (1U << 8U) | 1U; /* by timer 3, to the DMA without end */
    TIM3(TIM_CR1) = 1U;
}

static void begin_lines(void) {
    static const uint8_t lower[] = {IRQ_USART1, IRQ_EXTI15_10, IRQ_DMA2_0}; /* than the pulses */
    uint32_t i;
    USART(0x08U) = 91U; /* 84 MHz / 921 600 */
    USART(0x0CU) = (1U << 13U) | (1U << 5U) | 0xCU;
    SYSCFG_EXTICR4 = (SYSCFG_EXTICR4 & ~0xF0U) | 0x20U;
    EXTI(0x0CU) |= 1U << 13U;
    EXTI(0x00U) |= 1U << 13U;
    for (i = 0; i < sizeof lower; ++i) PRIORITY(lower[i]) = 0x10U;
    INTERRUPTS_ON_32 = (1U << (IRQ_USART1 - 32U)) | (1U << (IRQ_EXTI15_10 - 32U)) | (1U << (IRQ_TIM5 - 32U)) |
                       (1U << (IRQ_DMA2_0 - 32U));
}

/* Whether a host was heard or the button pressed before another reset is not known: then it is not alone. */
static void ask_for_power_on(void) {
    if (!(RCC(0x74U) & (1U << 27U))) {
        setup.alone = 0U;
        setup.rested = 0U;
    }
    RCC(0x74U) |= 1U << 24U;
}

/* A program that hangs for 0.1 s, at most 0.2 s by the spread of its clock, begins anew: output off and a rest. */
static void begin_watchdog(void) {
    IWDG(0x00U) = 0x5555U;
    IWDG(0x04U) = 2U;
    IWDG(0x08U) = 200U;
    IWDG(0x00U) = 0xCCCCU;
}

__attribute__((noreturn)) void reset(void) {
    const uint32_t* from = data_stored;
    uint32_t* at;
    COPROCESSORS |= 0xFU << 20U;
    __asm__ volatile("dsb\n\tisb");
    for (at = data_low; at < data_high; ++at) *at = *from++;
    for (at = bss_low; at < bss_high; ++at) *at = 0U;
    ask_for_power_on();
    begin_clocks();
    begin_pins();
    begin_timers();
    if (!tb_init(&board, &setup, &hardware)) halt();
    begin_converters();
    begin_lines();
    begin_watchdog();
    for (;;) {
        if (!(GPIOC(IDR) & (1U << 13U))) tb_stop(&board); /* held, also since before the start */
        tb_step(&board);
        IWDG(0x00U) = 0xAAAAU;
    }
}
