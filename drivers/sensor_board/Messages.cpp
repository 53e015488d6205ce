#include "drivers/sensor_board/Messages.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "drivers/sensor_board/Fields.h"

namespace tacto::sensorboard {

namespace {

constexpr std::size_t kNameBytes = 24, kSerialBytes = 16, kFirmwareBytes = 16, kDateBytes = 10, kReferenceBytes = 24;
constexpr std::uint32_t kMaxRate_mhz = 1'000'000'000;  // 1 MHz in millihertz

// The index of each entry is its number in the protocol.
constexpr std::array kKinds{StreamKind::Acceleration, StreamKind::Force, StreamKind::Taxels};
constexpr std::array kUnits{StreamUnit::Count, StreamUnit::MetrePerSecondSquared, StreamUnit::Newton,
                            StreamUnit::Pascal};

template <class Values>
auto numbered(const Values& values, std::uint8_t wire) noexcept {
    return wire < values.size() ? std::optional(values[wire]) : std::nullopt;
}
template <class Values, class Value>
std::uint8_t wireOf(const Values& values, Value value) noexcept {
    return static_cast<std::uint8_t>(std::ranges::find(values, value) - values.begin());
}

/// Returns the fields after the token.
FieldReader fieldsOf(const Frame& frame) noexcept {
    return FieldReader(frame.payload.empty() ? frame.payload : frame.payload.subspan(1));
}

StreamUnit properUnit(StreamKind kind) noexcept {
    return kind == StreamKind::Acceleration ? StreamUnit::MetrePerSecondSquared
           : kind == StreamKind::Force      ? StreamUnit::Newton
                                            : StreamUnit::Pascal;
}

struct Range {
    std::size_t least, most;
};
Range columnsOf(StreamKind kind) noexcept {
    return kind == StreamKind::Acceleration ? Range{1, 3} : kind == StreamKind::Force ? Range{1, 1} : Range{2, 16};
}

template <class... Args>
tl::unexpected<Error> wrong(fmt::format_string<Args...> text, Args&&... args) {
    return fail(ErrorCode::ParseError, text, std::forward<Args>(args)...);
}

}  // namespace

std::string Refusal::text() const {
    constexpr std::array kReasons{"it does not know this command", "it has no such stream",
                                  "it does not support this value", "it does this only while stopped",
                                  "its hardware failed"};
    if (reason >= 1 && reason <= kReasons.size()) return kReasons[reason - 1U];
    return fmt::format("for reason {}, which this version of the protocol does not have", reason);
}

std::uint8_t tokenOf(const Frame& frame) noexcept { return frame.payload.empty() ? std::uint8_t{0} : frame.payload[0]; }

Result<BoardIdentity> readIdentity(const Frame& frame) {
    auto in = fieldsOf(frame);
    BoardIdentity identity;
    identity.lowestVersion = in.u8();
    identity.highestVersion = in.u8();
    identity.streams = in.u8();
    identity.name = in.text(kNameBytes);
    identity.serial = in.text(kSerialBytes);
    identity.firmware = in.text(kFirmwareBytes);
    if (!in.whole()) return wrong("its identity has {} bytes; 60 were expected", frame.payload.size());
    if (identity.streams < 1 || identity.streams > kMaxStreams) {
        return wrong("it says that it has {} streams; 1 to {} were expected", identity.streams, kMaxStreams);
    }
    if (identity.serial.empty())
        return wrong("it has no serial number; 1 to {} characters were expected", kSerialBytes);
    return identity;
}

Result<StreamConfiguration> readConfiguration(const Frame& frame) {
    auto in = fieldsOf(frame);
    StreamConfiguration made;
    made.stream = in.u8();
    const auto flags = in.u8();
    made.enabled = (flags & 1U) != 0;
    const auto kind = in.u8(), unit = in.u8(), format = in.u8(), columns = in.u8();
    made.rate_mhz = in.u32();
    if (columns > kMaxColumns) return wrong("stream {} has {} columns; 1 to 16 were expected", made.stream, columns);
    for (int i = 0; i < columns; ++i) {
        Column column;
        column.scale = in.f32();
        column.offset = in.f32();
        made.columns.push_back(column);
    }
    if (!in.whole()) {
        return wrong("the configuration of stream {} has {} bytes; {} were expected", made.stream, frame.payload.size(),
                     11 + 8 * columns);
    }
    if ((flags & ~1U) != 0) return wrong("stream {} has flags {:#x}; 0 or 1 was expected", made.stream, flags);
    const auto known = numbered(kKinds, kind);
    if (!known) return wrong("stream {} is of kind {}; 0, 1 or 2 was expected", made.stream, kind);
    made.kind = *known;
    const auto knownUnit = numbered(kUnits, unit);
    if (!knownUnit || (*knownUnit != StreamUnit::Count && *knownUnit != properUnit(made.kind))) {
        return wrong("its {} stream is in {}; {} or count was expected", nameOf(made.kind),
                     knownUnit ? std::string(symbolOf(*knownUnit)) : fmt::format("unit {}", unit),
                     symbolOf(properUnit(made.kind)));
    }
    made.unit = *knownUnit;
    if (format != 1 && format != 2) {
        return wrong("its {} stream has format {}; 1 (int16) or 2 (int32) was expected", nameOf(made.kind), format);
    }
    made.format = static_cast<SampleFormat>(format);
    const auto range = columnsOf(made.kind);
    if (columns < range.least || columns > range.most) {
        return wrong("its {} stream has {} columns; {} to {} were expected", nameOf(made.kind), columns, range.least,
                     range.most);
    }
    if (made.rate_mhz < 1000 || made.rate_mhz > kMaxRate_mhz) {
        return wrong("its {} stream has a rate of {} Hz; 1 Hz to 1 MHz was expected", nameOf(made.kind),
                     made.rate_hz());
    }
    for (const auto& column : made.columns) {
        if (!std::isfinite(column.scale) || column.scale == 0 || !std::isfinite(column.offset)) {
            return wrong("its {} stream has the scale {} and offset {}; a finite scale other than 0 was expected",
                         nameOf(made.kind), column.scale, column.offset);
        }
        if (made.unit == StreamUnit::Count && (column.scale != 1 || column.offset != 0)) {
            return wrong("its {} stream counts with the scale {} and offset {}; 1 and 0 were expected",
                         nameOf(made.kind), column.scale, column.offset);
        }
    }
    return made;
}

Result<StreamCalibration> readCalibration(const Frame& frame) {
    auto in = fieldsOf(frame);
    StreamCalibration made;
    made.stream = in.u8();
    made.calibrated = (in.u8() & 1U) != 0;
    const auto columns = in.u8();
    made.date = in.text(kDateBytes);
    made.reference = in.text(kReferenceBytes);
    if (columns < 1 || columns > kMaxColumns) {
        return wrong("the calibration of stream {} has {} columns; 1 to 16 were expected", made.stream, columns);
    }
    for (int i = 0; i < columns; ++i) made.uncertainty.push_back(in.f32());
    if (!in.whole()) {
        return wrong("the calibration of stream {} has {} bytes; {} were expected", made.stream, frame.payload.size(),
                     38 + 4 * columns);
    }
    for (const double u : made.uncertainty) {
        if (u >= 0 && std::isfinite(u)) continue;
        return wrong("the calibration of stream {} has an uncertainty of {}; 0 or more was expected", made.stream, u);
    }
    return made;
}

Result<BoardStatus> readStatus(const Frame& frame) {
    auto in = fieldsOf(frame);
    BoardStatus status;
    status.running = (in.u8() & 1U) != 0;
    status.faultyStreams = in.u8();
    status.time_us = in.u64();
    status.samplesLost = in.u32();
    status.blocksDropped = in.u32();
    status.framesRefused = in.u32();
    if (!in.whole()) return wrong("its status has {} bytes; 23 were expected", frame.payload.size());
    return status;
}

Result<Refusal> readRefusal(const Frame& frame) {
    auto in = fieldsOf(frame);
    Refusal refusal;
    refusal.command = in.u8();
    refusal.reason = in.u8();
    if (!in.whole()) return wrong("its refusal has {} bytes; 3 were expected", frame.payload.size());
    return refusal;
}

Result<std::uint64_t> readDone(const Frame& frame, Command command) {
    auto in = fieldsOf(frame);
    const auto done = in.u8();
    const auto time = in.u64();
    if (!in.whole()) return wrong("its DONE has {} bytes; 10 were expected", frame.payload.size());
    if (done != static_cast<std::uint8_t>(command)) {
        return wrong("it says that it has done command {}; {} was expected", done, static_cast<int>(command));
    }
    return time;
}

std::optional<DataBlock> readBlock(const Frame& frame) noexcept {
    FieldReader in(frame.payload);
    DataBlock block;
    block.stream = in.u8();
    block.count = in.u8();
    block.sequence = in.u32();
    block.index = in.u32();
    block.time_us = in.u64();
    block.interval_ns = in.u32();
    block.samples = in.rest();
    if (block.count == 0 || block.samples.empty()) return std::nullopt;
    return block;
}

Result<EncoderState> readEncoder(const Frame& frame) {
    auto in = fieldsOf(frame);
    EncoderState state;
    const auto mode = in.u8();
    state.encodes = mode == 1;
    state.refusal = in.u8();
    state.layout = in.u32();
    state.hash = in.u32();
    if (!in.whole()) return wrong("its ENCODER has {} bytes; 11 were expected", frame.payload.size());
    if (mode > 1) return wrong("its encoder is in mode {}; 0 or 1 was expected", mode);
    return state;
}

std::optional<BoardReading> readReading(const Frame& frame) noexcept {
    FieldReader in(frame.payload);
    BoardReading reading;
    reading.sequence = in.u32();
    reading.time_us = in.u64();
    const unsigned flags = in.u16();
    reading.contact = (flags & 1U) != 0;
    reading.sliding = (flags & 2U) != 0;
    reading.slidingAssumed = (flags & 4U) != 0;
    reading.faults = in.u32();
    reading.R = in.f32();
    reading.P = in.f32();
    reading.pressure_pa = in.f32();
    reading.h = in.f32();
    reading.v = in.f32();
    const auto share = [](double x) { return std::isnan(x) || (x >= 0 && x <= 1); };
    const bool finite = !std::isinf(reading.pressure_pa) && !std::isinf(reading.h) && !std::isinf(reading.v);
    if (!in.whole() || flags > 7 || !share(reading.R) || !share(reading.P) || !finite) return std::nullopt;
    return reading;
}

std::optional<BoardTrain> readTrain(const Frame& frame) noexcept {
    FieldReader in(frame.payload);
    BoardTrain train;
    train.sequence = in.u32();
    train.onset_us = in.u64();
    train.interval_s = in.f32();
    train.command_v = in.f32();
    train.amplitude = in.f32();
    train.shape = in.u8();
    const auto negative = in.u8();
    train.negative = negative != 0;
    train.width_us = in.f32();
    train.gap_us = in.f32();
    train.rechargeRatio = in.f32();
    train.pulses = in.u32();
    train.rate_hz = in.f32();
    train.ahead_us = in.u16();
    if (!in.whole() || train.shape > 2 || negative > 1 || train.pulses == 0) return std::nullopt;
    for (const double above : {train.interval_s, train.command_v, train.amplitude, train.width_us, train.rate_hz})
        if (!(above > 0 && std::isfinite(above))) return std::nullopt;
    for (const double value : {train.gap_us, train.rechargeRatio})
        if (!(value >= 0 && std::isfinite(value))) return std::nullopt;
    return train;
}

std::optional<BoardSilence> readSilence(const Frame& frame) noexcept {
    FieldReader in(frame.payload);
    BoardSilence silence;
    silence.sequence = in.u32();
    silence.time_us = in.u64();
    silence.faults = in.u32();
    silence.refusal = in.u8();
    if (!in.whole()) return std::nullopt;
    return silence;
}

std::vector<std::uint8_t> configurationPayload(const StreamConfiguration& configuration) {
    std::vector<std::uint8_t> bytes{configuration.stream,
                                    static_cast<std::uint8_t>(configuration.enabled ? 1 : 0),
                                    wireOf(kKinds, configuration.kind),
                                    wireOf(kUnits, configuration.unit),
                                    static_cast<std::uint8_t>(configuration.format),
                                    static_cast<std::uint8_t>(configuration.columns.size())};
    putU32(bytes, configuration.rate_mhz);
    for (const auto& column : configuration.columns) {
        putF32(bytes, static_cast<float>(column.scale));
        putF32(bytes, static_cast<float>(column.offset));
    }
    return bytes;
}

}  // namespace tacto::sensorboard
