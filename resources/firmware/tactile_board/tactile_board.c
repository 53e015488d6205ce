#include "tactile_board.h"

#define US_NS 1000U
#define HEARD_AT_ONCE 64U
#define BLOCKS_AT_ONCE 8U
#define STATUS_US 1000000U
#define REST_US 8000000U      /* after which the encoder need not rest */
#define RATE_TOLERANCE 0.01F  /* between a stream and the profile's */
#define LOWEST_RATE_MHZ 1000U /* of the protocol */
#define HIGHEST_RATE_MHZ 1000000000U

static uint64_t now_of(const struct tb_board* board) { return board->hardware->now_us(board->hardware->context); }

static int64_t ns_of(uint64_t us) { return (int64_t)(us * US_NS); }

static void cancel(const struct tb_board* board) {
    if (board->hardware->play) (void)board->hardware->play(board->hardware->context, (const struct te_train*)0);
}

static int say(struct tb_board* board, size_t size) {
    return size > 0U && board->hardware->say(board->hardware->context, board->frame, size);
}

static int is_stopped(const struct tb_board* board) { return *(const volatile uint32_t*)&board->stopped != 0U; }

/* Streams ------------------------------------------------------------------------------------------------------- */

static int is_number(float x) { return x - x == 0.0F; }

static int unit_fits(const struct tsb_configuration* c) {
    return c->unit == TSB_UNIT_COUNT || c->unit == c->kind + (uint8_t)TSB_UNIT_METRE_PER_SECOND_SQUARED;
}

static int columns_fit(const struct tsb_configuration* c) {
    if (c->kind == TSB_KIND_ACCELERATION) return c->columns >= 1U && c->columns <= 3U;
    if (c->kind == TSB_KIND_FORCE) return c->columns == 1U;
    return c->columns >= 2U && c->columns <= TSB_COLUMNS_MOST;
}

static int is_sound(const struct tsb_configuration* c) {
    uint8_t i;
    if (c->kind > TSB_KIND_TAXELS || !unit_fits(c) || c->flags > TSB_STREAM_ENABLED) return 0;
    if (c->rate_mhz < LOWEST_RATE_MHZ || c->rate_mhz > HIGHEST_RATE_MHZ) return 0;
    if (!columns_fit(c) || tsb_block_most(c->columns, c->format) == 0U) return 0;
    for (i = 0; i < c->columns; ++i) {
        if (!is_number(c->scale[i]) || c->scale[i] == 0.0F || !is_number(c->offset[i])) return 0;
        if (c->unit == TSB_UNIT_COUNT && (c->scale[i] != 1.0F || c->offset[i] != 0.0F)) return 0;
    }
    return 1;
}

static const struct tsb_configuration* stream_of(const struct tb_board* board, uint8_t kind) {
    uint8_t i;
    for (i = 0; i < board->setup->streams; ++i) {
        const struct tsb_configuration* const c = &board->configuration[i];
        if (c->kind == kind && (c->flags & TSB_STREAM_ENABLED)) return c;
    }
    return (const struct tsb_configuration*)0;
}

static int gives(const struct tb_board* board, uint8_t kind, float rate_hz, uint32_t columns) {
    const struct tsb_configuration* const c = stream_of(board, kind);
    float off_hz;
    if (!(rate_hz > 0.0F)) return 1;
    if (!c || c->columns != columns) return 0;
    off_hz = (float)c->rate_mhz * 1e-3F - rate_hz;
    return off_hz <= RATE_TOLERANCE * rate_hz && off_hz >= -RATE_TOLERANCE * rate_hz;
}

/* Why this profile cannot be encoded with these streams. */
static uint8_t begin_encoder(struct tb_board* board) {
    const struct te_profile* const p = board->setup->profile;
    const enum te_refusal refusal = te_init(&board->encoder, p);
    if (refusal != TE_ACCEPTED) return (uint8_t)refusal;
    if (!gives(board, TSB_KIND_ACCELERATION, p->acceleration_hz, p->axes) ||
        !gives(board, TSB_KIND_FORCE, p->force_hz, 1U) || !gives(board, TSB_KIND_TAXELS, p->taxels_hz, p->taxels)) {
        te_stop(&board->encoder);
        return (uint8_t)TE_BAD_STREAM;
    }
    return (uint8_t)TE_ACCEPTED;
}

/* Output --------------------------------------------------------------------------------------------------------- */

void tb_stop(struct tb_board* board) {
    *(volatile uint32_t*)&board->stopped = 1U;
    te_stop(&board->encoder);
    cancel(board);
}

static void leave_to_host(struct tb_board* board) {
    if (!board->alone) return;
    board->alone = 0U;
    te_stop(&board->encoder);
    cancel(board);
}

static int encodes(const struct tb_board* board) {
    return board->profile_refusal == (uint8_t)TE_ACCEPTED && board->setup->profile &&
           (board->alone || (board->running && board->mode == TSB_MODE_ENCODE));
}

/* A stop may come from an interrupt at any moment, so that it is asked for after the timer was prepared as well. */
static void play(struct tb_board* board, const struct te_train* train) {
    if (is_stopped(board)) return;
    if (!board->hardware->play(board->hardware->context, train) || is_stopped(board)) tb_stop(board);
}

static void say_train(struct tb_board* board, const struct te_train* train, uint64_t now_us) {
    struct tsb_train said;
    said.sequence = board->trains++;
    said.onset_us = (uint64_t)train->onset_ns / US_NS;
    said.interval_s = train->interval_s;
    said.command_v = train->command_v;
    said.amplitude = train->amplitude;
    said.shape = (uint8_t)train->shape;
    said.negative = (uint8_t)train->negative;
    said.width_us = train->width_us;
    said.gap_us = train->gap_us;
    said.recharge_ratio = train->recharge_ratio;
    said.pulses = train->pulses;
    said.pulse_hz = train->pulse_hz;
    said.ahead_us = (uint16_t)(said.onset_us - now_us);
    (void)say(board, tsb_encode_train(board->frame, &said));
}

/* Said again until there is room for it. */
static void say_silence(struct tb_board* board, uint64_t now_us) {
    struct tsb_silence said;
    said.faults = te_fault(&board->encoder, ns_of(now_us));
    said.refusal = (uint8_t)te_refused(&board->encoder);
    if (board->told && said.faults == board->faults && said.refusal == board->refusal &&
        board->refused == board->encoder.trains_refused)
        return;
    said.sequence = board->silences++;
    said.time_us = now_us;
    if (!say(board, tsb_encode_silence(board->frame, &said))) return;
    board->told = 1U;
    board->faults = said.faults;
    board->refusal = said.refusal;
    board->refused = board->encoder.trains_refused;
}

static void ask_for_train(struct tb_board* board, uint64_t now_us) {
    struct te_train train;
    if (te_next_train(&board->encoder, ns_of(now_us), &train)) {
        board->quiet_us = (uint64_t)train.onset_ns / US_NS + (uint64_t)(train.interval_s * 1e6F);
        board->rested = 0U;
        if (board->alone) {
            play(board, &train);
        } else {
            say_train(board, &train, now_us);
        }
    }
    if (board->running) say_silence(board, now_us);
}

/* Samples --------------------------------------------------------------------------------------------------------- */

static void say_readings(struct tb_board* board) {
    struct te_reading frame;
    while (te_frame(&board->encoder, &frame)) {
        struct tsb_reading said;
        if (!board->running) continue;
        said.sequence = board->readings++;
        said.time_us = (uint64_t)frame.t_ns / US_NS;
        said.flags =
            (uint16_t)((frame.contact ? TSB_READING_CONTACT : 0U) | (frame.sliding ? TSB_READING_SLIDING : 0U) |
                       (frame.sliding_assumed ? TSB_READING_SLIDING_ASSUMED : 0U));
        said.faults = te_fault(&board->encoder, ns_of(now_of(board)));
        said.roughness = frame.R;
        said.pressure = frame.P;
        said.pressure_pa = frame.pressure_pa;
        said.h = frame.h;
        said.v = frame.v;
        (void)say(board, tsb_encode_reading(board->frame, &said));
    }
}

/* Whether these samples can be what they say. */
static int fits(const struct tb_samples* samples, const struct tsb_configuration* c) {
    const uint32_t values = (uint32_t)samples->count * c->columns;
    uint32_t i;
    if (values == 0U || samples->count > tsb_block_most(c->columns, c->format) || values > TB_VALUES) return 0;
    if (c->format != TSB_FORMAT_INT16) return 1;
    for (i = 0; i < values; ++i) {
        if (samples->raw[i] < INT16_MIN || samples->raw[i] > INT16_MAX) return 0;
    }
    return 1;
}

/* Whether a column has read nothing within its range for too long. */
static int is_pulled(struct tb_board* board, const struct tsb_configuration* c) {
    const struct tb_samples* const samples = &board->samples;
    const struct tb_range* const range = &board->setup->range[samples->stream];
    const int named = range->low != 0 || range->high != 0;
    const int narrow = c->format == TSB_FORMAT_INT16;
    const int32_t low = named ? range->low : (narrow ? INT16_MIN : INT32_MIN) + 1;
    const int32_t high = named ? range->high : (narrow ? INT16_MAX : INT32_MAX) - 1;
    const uint32_t values = (uint32_t)samples->count * c->columns;
    const uint64_t now_us = now_of(board);
    uint64_t* const sound_us = board->sound_us[samples->stream];
    uint32_t i;
    for (i = 0; i < values; ++i) {
        if (samples->raw[i] >= low && samples->raw[i] <= high) sound_us[i % c->columns] = now_us;
    }
    for (i = 0; i < c->columns; ++i) {
        if (now_us > sound_us[i] + TB_PULLED_US) return 1;
    }
    return 0;
}

/* The kinds of the protocol are the streams of the encoder. */
static void encode_samples(struct tb_board* board, const struct tsb_configuration* c) {
    const struct tb_samples* const samples = &board->samples;
    const uint32_t values = (uint32_t)samples->count * c->columns;
    uint32_t i;
    for (i = 0; i < values; ++i) {
        const uint32_t column = i % c->columns;
        board->values[i] = c->scale[column] * (float)samples->raw[i] + c->offset[column];
    }
    (void)te_samples(&board->encoder, (enum te_stream)c->kind, ns_of(samples->first_us), (int32_t)samples->interval_ns,
                     board->values, samples->count);
    say_readings(board);
}

static void say_samples(struct tb_board* board, const struct tsb_configuration* c) {
    const struct tb_samples* const samples = &board->samples;
    const uint32_t values = (uint32_t)samples->count * c->columns;
    int16_t narrow[TB_VALUES];
    struct tsb_block block;
    size_t size;
    uint32_t i;
    block.stream = samples->stream;
    block.count = samples->count;
    block.columns = c->columns;
    block.sequence = board->sequence[samples->stream]++;
    block.index = board->index[samples->stream];
    block.time_us = samples->first_us;
    block.interval_ns = samples->interval_ns;
    if (c->format == TSB_FORMAT_INT16) {
        for (i = 0; i < values; ++i) narrow[i] = (int16_t)samples->raw[i];
        size = tsb_encode_int16(board->frame, &block, narrow);
    } else {
        size = tsb_encode_int32(board->frame, &block, samples->raw);
    }
    if (!say(board, size)) ++board->blocks_dropped;
}

static void take_samples(struct tb_board* board) {
    const struct tb_samples* const samples = &board->samples;
    const struct tsb_configuration* c;
    if (samples->stream >= board->setup->streams) return;
    c = &board->configuration[samples->stream];
    if (!(c->flags & TSB_STREAM_ENABLED) || !(board->running || board->alone)) return;
    board->index[samples->stream] += samples->lost;
    board->samples_lost += samples->lost;
    if (fits(samples, c) && !is_pulled(board, c)) {
        board->heard_us[samples->stream] = now_of(board);
        if (board->running) say_samples(board, c);
        if (encodes(board)) encode_samples(board, c);
    } else {
        board->samples_lost += samples->count;
    }
    board->index[samples->stream] += samples->count;
}

/* Commands -------------------------------------------------------------------------------------------------------- */

static void refuse(struct tb_board* board, const struct tsb_command* command, enum tsb_reason reason) {
    (void)say(board, tsb_encode_refused(board->frame, command->token, command->type, (uint8_t)reason));
}

static void done(struct tb_board* board, const struct tsb_command* command) {
    (void)say(board, tsb_encode_done(board->frame, command->token, command->type, now_of(board)));
}

/* What stops from here on stands. */
static void start(struct tb_board* board) {
    uint64_t now_us;
    uint32_t i, k;
    *(volatile uint32_t*)&board->stopped = 0U;
    now_us = now_of(board);
    for (i = 0; i < TB_STREAMS; ++i) {
        board->sequence[i] = 0U;
        board->index[i] = 0U;
        board->heard_us[i] = now_us;
        for (k = 0; k < TSB_COLUMNS_MOST; ++k) board->sound_us[i][k] = now_us;
    }
    board->samples_lost = 0U;
    board->blocks_dropped = 0U;
    board->readings = 0U;
    board->trains = 0U;
    board->silences = 0U;
    board->told = 0U;
    board->status_us = now_us;
    board->asked_us = now_us;
    board->running = 1U;
    if (board->mode != TSB_MODE_ENCODE) return;
    board->profile_refusal = begin_encoder(board);
    if (board->rested || now_us >= board->quiet_us + REST_US) te_rested(&board->encoder);
    if (is_stopped(board)) te_stop(&board->encoder);
}

static void say_status(struct tb_board* board, uint8_t token) {
    const uint64_t now_us = now_of(board);
    struct tsb_status status;
    uint8_t i;
    status.flags = board->running ? TSB_STATUS_RUNNING : 0U;
    status.faulty_streams = 0U;
    for (i = 0; board->running && i < board->setup->streams; ++i) {
        if (!(board->configuration[i].flags & TSB_STREAM_ENABLED)) continue;
        if (now_us > board->heard_us[i] + TB_SILENT_US) status.faulty_streams |= (uint8_t)(1U << i);
    }
    status.time_us = now_us;
    status.samples_lost = board->samples_lost;
    status.blocks_dropped = board->blocks_dropped;
    status.frames_refused = board->receiver.refused;
    (void)say(board, tsb_encode_status(board->frame, token, &status));
}

static void say_encoder(struct tb_board* board, uint8_t token) {
    struct tsb_encoder said;
    said.mode = board->mode;
    said.refusal = board->profile_refusal;
    said.layout = TE_LAYOUT;
    said.hash = board->setup->profile->hash;
    (void)say(board, tsb_encode_encoder(board->frame, token, &said));
}

static void set_encoder(struct tb_board* board, const struct tsb_command* command) {
    if (board->running) {
        refuse(board, command, TSB_REASON_RUNNING);
    } else if (command->mode > (uint8_t)TSB_MODE_ENCODE) {
        refuse(board, command, TSB_REASON_NOT_SUPPORTED);
    } else {
        board->mode = board->profile_refusal == (uint8_t)TE_ACCEPTED ? command->mode : (uint8_t)TSB_MODE_OFF;
        say_encoder(board, command->token);
    }
}

static int same_line(const struct tsb_configuration* a, const struct tsb_configuration* b) {
    uint8_t i;
    for (i = 0; i < a->columns; ++i) {
        if (a->scale[i] != b->scale[i] || a->offset[i] != b->offset[i]) return 0;
    }
    return a->unit == b->unit;
}

static void configure(struct tb_board* board, const struct tsb_command* command) {
    const struct tsb_configuration* const wanted = &command->configuration;
    struct tsb_configuration* const c = &board->configuration[command->stream];
    if (board->running) {
        refuse(board, command, TSB_REASON_RUNNING);
    } else if (!is_sound(wanted) || wanted->kind != c->kind || wanted->format != c->format ||
               wanted->columns != c->columns || wanted->rate_mhz != c->rate_mhz) {
        refuse(board, command, TSB_REASON_NOT_SUPPORTED);
    } else {
        *c = *wanted;
        board->unsaved |= 1U << command->stream;
        if (same_line(c, &board->setup->configuration[command->stream])) {
            board->uncalibrated &= (uint8_t) ~(1U << command->stream);
        } else {
            board->uncalibrated |= (uint8_t)(1U << command->stream);
        }
        if (board->setup->profile) board->profile_refusal = begin_encoder(board);
        if (board->profile_refusal != (uint8_t)TE_ACCEPTED) board->mode = TSB_MODE_OFF;
        (void)say(board, tsb_encode_configuration(board->frame, command->token, c));
    }
}

static void say_calibration(struct tb_board* board, const struct tsb_command* command) {
    struct tsb_calibration said = board->setup->calibration[command->stream];
    said.stream = command->stream;
    said.columns = board->configuration[command->stream].columns;
    if (board->uncalibrated & (1U << command->stream)) said.flags = 0U;
    (void)say(board, tsb_encode_calibration(board->frame, command->token, &said));
}

static void say_identity(struct tb_board* board, uint8_t token) {
    struct tsb_identity said;
    said.lowest_version = TSB_VERSION;
    said.highest_version = board->setup->profile ? TSB_VERSION_2 : TSB_VERSION;
    said.streams = board->setup->streams;
    said.name = board->setup->name;
    said.serial = board->setup->serial;
    said.firmware = board->setup->firmware;
    (void)say(board, tsb_encode_identity(board->frame, token, &said));
}

static void answer_stream(struct tb_board* board, const struct tsb_command* command) {
    if (command->stream >= board->setup->streams) {
        refuse(board, command, TSB_REASON_NO_SUCH_STREAM);
    } else if (command->type == TSB_GET_CONFIGURATION) {
        (void)say(board,
                  tsb_encode_configuration(board->frame, command->token, &board->configuration[command->stream]));
    } else if (command->type == TSB_SET_CONFIGURATION) {
        configure(board, command);
    } else {
        say_calibration(board, command);
    }
}

static void answer_encoder(struct tb_board* board, const struct tsb_command* command) {
    if (!board->setup->profile) {
        refuse(board, command, TSB_REASON_UNKNOWN_COMMAND);
    } else if (command->type == TSB_GET_ENCODER) {
        say_encoder(board, command->token);
    } else {
        set_encoder(board, command);
    }
}

static void answer(struct tb_board* board, const struct tsb_command* command) {
    switch (command->type) {
        case TSB_HELLO:
            say_identity(board, command->token);
            break;
        case TSB_GET_CONFIGURATION:
        case TSB_SET_CONFIGURATION:
        case TSB_GET_CALIBRATION:
            answer_stream(board, command);
            break;
        case TSB_START:
            start(board);
            done(board, command);
            break;
        case TSB_STOP:
            board->running = 0U;
            done(board, command);
            break;
        case TSB_GET_STATUS:
            say_status(board, command->token);
            break;
        case TSB_GET_ENCODER:
        case TSB_SET_ENCODER:
            answer_encoder(board, command);
            break;
        default:
            refuse(board, command, TSB_REASON_UNKNOWN_COMMAND);
            break;
    }
}

static void hear(struct tb_board* board) {
    uint8_t bytes[HEARD_AT_ONCE];
    const size_t count = board->hardware->hear(board->hardware->context, bytes, sizeof bytes);
    size_t i;
    for (i = 0; i < count && i < sizeof bytes; ++i) {
        struct tsb_command command;
        if (!tsb_receive(&board->receiver, bytes[i], &command)) continue;
        leave_to_host(board);
        answer(board, &command);
    }
}

/* The board ------------------------------------------------------------------------------------------------------- */

static void clear(struct tb_board* board) {
    size_t i;
    for (i = 0; i < sizeof *board; ++i) ((uint8_t*)board)[i] = 0U;
}

static int can_be(const struct tb_setup* setup) {
    uint8_t i, k;
    if (setup->streams < 1U || setup->streams > TB_STREAMS) return 0;
    for (i = 0; i < setup->streams; ++i) {
        const struct tsb_configuration* const c = &setup->configuration[i];
        if (!is_sound(c) || c->stream != i || setup->range[i].low > setup->range[i].high) return 0;
        for (k = 0; k < i; ++k) {
            if (setup->configuration[k].kind == c->kind) return 0;
        }
    }
    return 1;
}

int tb_init(struct tb_board* board, const struct tb_setup* setup, const struct tb_hardware* hardware) {
    uint32_t i;
    clear(board);
    board->setup = setup;
    board->hardware = hardware;
    cancel(board);
    if (!can_be(setup)) return 0;
    for (i = 0; i < setup->streams; ++i) board->configuration[i] = setup->configuration[i];
    board->rested = setup->rested;
    board->quiet_us = now_of(board);
    if (!setup->profile) return 1;
    board->profile_refusal = begin_encoder(board);
    board->alone = setup->alone && hardware->play;
    if (board->rested) te_rested(&board->encoder);
    return 1;
}

void tb_step(struct tb_board* board) {
    uint64_t now_us;
    uint32_t i;
    hear(board);
    for (i = 0; i < BLOCKS_AT_ONCE && board->hardware->read(board->hardware->context, &board->samples); ++i) {
        take_samples(board);
    }
    now_us = now_of(board);
    if (encodes(board) && now_us >= board->asked_us + TB_STEP_US) {
        board->asked_us = now_us;
        ask_for_train(board, now_us);
    }
    if (board->running && now_us >= board->status_us + STATUS_US) {
        board->status_us += STATUS_US;
        say_status(board, 0U);
    }
}
