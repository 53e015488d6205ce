#include "drivers/hid_massager/VibrationReports.h"

#include <algorithm>
#include <cmath>

namespace tacto::hid {

namespace {

/// Returns the position in the report of bit `i` of the value.
std::size_t placeOf(const ReportField& field, std::size_t i) noexcept {
    if (field.order == ByteOrder::Little) return field.bit + i;
    const std::size_t lastByte = field.bits / 8 - 1;
    return field.bit + 8 * (lastByte - i / 8) + i % 8;
}

Result<void> check(const ReportField& field, std::size_t index, std::size_t length) {
    if (field.bits < 1 || field.bits > 32) {
        return invalid("field {} has {} bits; 1 to 32 are accepted", index, field.bits);
    }
    if (field.order == ByteOrder::Big && (field.bit % 8 != 0 || field.bits % 8 != 0)) {
        return invalid("field {} is big-endian at bit {} with {} bits; whole bytes are accepted", index, field.bit,
                       field.bits);
    }
    if (field.bit < 8)
        return invalid("field {} stands at bit {}, in the report's number; 8 is its first", index, field.bit);
    if (field.bit > 8 * length - field.bits || field.bits > 8 * length) {
        return invalid("field {} ends at bit {}, behind the report of {} bytes", index,
                       std::uint64_t{field.bit} + field.bits, length);
    }
    const bool isSigned = field.min < 0;
    const std::int64_t low = isSigned ? -(std::int64_t{1} << (field.bits - 1)) : 0;
    const std::int64_t high = (std::int64_t{1} << (field.bits - (isSigned ? 1 : 0))) - 1;
    if (!(field.min < field.max) || field.min < low || field.max > high) {
        return invalid(
            "field {} goes from {} to {}; a rising range within {} to {} is accepted, which its {} bits hold", index,
            field.min, field.max, low, high, field.bits);
    }
    return {};
}

}  // namespace

Result<void> validate(const VibrationReports& reports) {
    const std::size_t length = reports.start.size();
    if (length < 2 || length > kMaxReport) {
        return invalid("the report has {} bytes; 2 to {} are accepted, its number included", length, kMaxReport);
    }
    if (reports.stop.size() != length) {
        return invalid("the stop report has {} bytes and the start report {}; both reports must have the same length",
                       reports.stop.size(), length);
    }
    if (reports.stop[0] != reports.start[0]) {
        return invalid("the stop report has the number {} and the start report {}; both must have the same number",
                       reports.stop[0], reports.start[0]);
    }
    if (reports.fields.empty()) return invalid("the report has no field for the intensity; one or more is needed");
    std::vector<bool> taken(8 * length);
    auto fields = reports.fields;
    if (reports.ends) fields.push_back(reports.ends->at);
    for (std::size_t i = 0; i < fields.size(); ++i) {
        const auto& field = fields[i];
        if (auto sound = check(field, i, length); !sound) return sound;
        for (std::size_t bit = 0; bit < field.bits; ++bit) {
            const auto place = placeOf(field, bit);
            if (taken[place]) return invalid("field {} stands over another one, at bit {}", i, place);
            taken[place] = true;
        }
    }
    if (reports.ends && !(reports.ends->unit.count() > 0 && reports.ends->unit.count() <= 60)) {
        return invalid("the device's unit of duration is {} s; above 0 to 60 s is accepted",
                       reports.ends->unit.count());
    }
    const double keep = reports.keepAlive.count();
    if (!(keep == 0 || (keep >= kMinKeepAlive.count() && keep <= 60))) {
        return invalid("the keep-alive is {} s; 0 (none) or {} to 60 s are accepted", keep, kMinKeepAlive.count());
    }
    const double shortest = reports.shortestWrite.count();
    if (!(shortest >= 0 && shortest <= kMaxShortestWrite.count())) {
        return invalid("the shortest write interval is {} s; 0 to {} s are accepted", shortest,
                       kMaxShortestWrite.count());
    }
    if (keep != 0 && !(keep >= shortest)) {
        return invalid("the keep-alive of {} s comes before the shortest write interval of {} s", keep, shortest);
    }
    return {};
}

void setValue(const ReportField& field, std::int64_t value, std::span<std::uint8_t> report) noexcept {
    const auto raw = static_cast<std::uint64_t>(value);
    for (std::size_t i = 0; i < field.bits; ++i) {
        const std::size_t place = placeOf(field, i);
        const auto mask = static_cast<std::uint8_t>(1U << (place % 8));
        auto& byte = report[place / 8];
        byte = static_cast<std::uint8_t>((raw >> i & 1) != 0 ? byte | mask : byte & ~mask);
    }
}

std::int64_t valueOf(const ReportField& field, std::span<const std::uint8_t> report) noexcept {
    std::uint64_t raw = 0;
    for (std::size_t i = 0; i < field.bits; ++i) {
        const std::size_t place = placeOf(field, i);
        raw |= std::uint64_t{static_cast<unsigned>(report[place / 8] >> (place % 8)) & 1U} << i;
    }
    const bool negative = field.min < 0 && (raw >> (field.bits - 1) & 1) != 0;
    return negative ? static_cast<std::int64_t>(raw) - (std::int64_t{1} << field.bits) : static_cast<std::int64_t>(raw);
}

namespace {

/// Returns the value that makes the device play for at least `duration`.
Result<std::int64_t> valueFor(const DurationField& ends, Seconds duration) {
    constexpr double kRounding = 1e-9;  // so that 0.1 s is 100 units of 0.001 s despite binary fractions
    const double units = std::ceil(duration.count() / ends.unit.count() * (1 - kRounding));
    const double most = static_cast<double>(ends.at.max + ends.first);
    if (!(duration.count() > 0) || !(units <= most)) {
        return invalid("the burst lasts {} s; above 0 to {} s is accepted, the most that this device plays at once",
                       duration.count(), most * ends.unit.count());
    }
    return std::max(static_cast<std::int64_t>(units) - ends.first, ends.at.min);
}

}  // namespace

Result<void> writeStart(const VibrationReports& reports, double intensity, Seconds duration,
                        std::span<std::uint8_t> into) {
    if (!(intensity >= 0 && intensity <= 1)) {
        return invalid("intensity is {}; 0 to 1 is accepted", intensity);
    }
    if (into.size() != reports.start.size()) {
        return invalid("{} bytes for a report of {}", into.size(), reports.start.size());
    }
    std::ranges::copy(reports.start, into.begin());
    for (const auto& field : reports.fields) {
        const double range = static_cast<double>(field.max - field.min);
        setValue(field, field.min + std::llround(intensity * range), into);
    }
    if (reports.ends) {
        const auto value = valueFor(*reports.ends, duration);
        if (!value) return failure(value);
        setValue(reports.ends->at, *value, into);
    }
    return {};
}

Result<std::vector<std::uint8_t>> startBytes(const VibrationReports& reports, double intensity, Seconds duration) {
    std::vector<std::uint8_t> bytes(reports.start.size());
    if (auto written = writeStart(reports, intensity, duration, bytes); !written) return failure(written);
    return bytes;
}

std::string hexOf(std::span<const std::uint8_t> bytes) { return fmt::format("{:02X}", fmt::join(bytes, " ")); }

}  // namespace tacto::hid
