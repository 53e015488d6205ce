#include "core/measure/CaptureFile.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <iterator>

#include "core/base/LocaleFreeText.h"
#include "core/base/WholeFile.h"
#include "core/measure/CaptureDescription.h"

namespace tacto {

namespace {

std::string columnNameOf(const CaptureChannel& channel) {
    std::string name = channel.unit.empty() ? channel.name : fmt::format("{}_{}", channel.name, lowered(channel.unit));
    std::replace_if(
        name.begin(), name.end(), [](char c) { return c == ',' || c == '"' || c == '\n' || c == '\r'; }, ' ');
    return name;
}

/// Writes fixed-point numbers, several times faster than the general function: a session writes millions of times.
void appendTime(fmt::memory_buffer& text, double t, int decimals) {
    double scale = 1;
    for (int i = 0; i < decimals; ++i) scale *= 10;
    const double scaled = std::round(std::abs(t) * scale);
    if (!(scaled < 9e15)) {  // above this, a double cannot hold every integer
        fmt::format_to(std::back_inserter(text), "{:.{}f}", t, decimals);
        return;
    }
    std::array<char, 24> digits;
    std::size_t at = digits.size();
    auto rest = static_cast<std::uint64_t>(scaled);
    for (int i = 0; i < decimals || rest > 0 || i == decimals; ++i) {
        if (i == decimals) digits[--at] = '.';
        digits[--at] = static_cast<char>('0' + rest % 10);
        rest /= 10;
    }
    if (t < 0 && scaled > 0) digits[--at] = '-';
    text.append(digits.data() + at, digits.data() + digits.size());
}

Result<void> writeRows(FileOut& file, const Capture& capture) {
    constexpr std::size_t kPiece = 1024UL * 1024;  // bytes written at once: a record's text is larger than the record
    fmt::memory_buffer text;
    auto out = std::back_inserter(text);
    fmt::format_to(out, "time_s");
    for (const auto& channel : capture.channels) fmt::format_to(out, ",{}", columnNameOf(channel));
    fmt::format_to(out, "\n{}", captureHeader(capture));
    const int decimals = std::clamp(static_cast<int>(std::ceil(std::log10(1000 * capture.rate_hz))), 3, 12);
    for (std::size_t i = 0; i < capture.samples(); ++i) {
        appendTime(text, capture.start_s + static_cast<double>(i) / capture.rate_hz, decimals);
        for (const auto& channel : capture.channels) {
            if (std::isfinite(channel.samples[i])) {
                fmt::format_to(out, ",{}", channel.samples[i]);
            } else {
                text.push_back(',');
            }
        }
        text.push_back('\n');
        if (text.size() < kPiece) continue;
        if (auto written = file.write({text.data(), text.size()}); !written) return written;
        text.clear();
    }
    return file.write({text.data(), text.size()});
}

}  // namespace

Result<void> checkWritable(const Capture& capture) {
    if (capture.samples() == 0) return invalid("a capture without samples cannot be written");
    if (!(capture.rate_hz > 0) || !std::isfinite(capture.rate_hz) || !std::isfinite(capture.start_s)) {
        return invalid("a capture at {} Hz from {} s cannot be written; both must be finite and the rate above 0",
                       capture.rate_hz, capture.start_s);
    }
    for (const auto& channel : capture.channels) {
        if (channel.samples.size() != capture.samples()) {
            return invalid("channel '{}' has {} samples; {} were expected, as in the first channel", channel.name,
                           channel.samples.size(), capture.samples());
        }
    }
    return {};
}

Result<void> writeCapture(const std::filesystem::path& path, const Capture& capture) {
    if (auto writable = checkWritable(capture); !writable) return writable;
    return namedAs(path, replaceWholeFile(path, [&](const std::filesystem::path& draft) -> Result<void> {
                       auto file = FileOut::create(draft);
                       return file ? writeRows(*file, capture) : failure(file);
                   }));
}

Result<std::size_t> findChannel(const Capture& capture, std::string_view name) {
    name = trimmed(name);
    std::string known;
    for (std::size_t c = 0; c < capture.channels.size(); ++c) {
        const auto& channel = capture.channels[c];
        if (sameLetters(channel.name, name) || sameLetters(columnNameOf(channel), name)) return c;
        known += (c == 0 ? "" : ", ") + channel.name;
    }
    return fail(ErrorCode::NotFound, "no channel '{}'; the capture has {}", name, known.empty() ? "none" : known);
}

Result<void> convertShunt(Capture& capture, std::optional<std::string_view> channel, Ohms shunt) {
    const double ohms = shunt.value();
    if (!(ohms > 0) || !std::isfinite(ohms)) {
        return invalid("a shunt of {} ohm; a finite value above 0 was expected", ohms);
    }
    std::size_t index = 0;
    if (channel) {
        const auto found = findChannel(capture, *channel);
        if (!found) return failure(found);
        index = *found;
    } else {
        const auto isVolts = [](const CaptureChannel& c) { return c.unit == "V"; };
        const auto first = std::find_if(capture.channels.begin(), capture.channels.end(), isVolts);
        const auto count = std::count_if(capture.channels.begin(), capture.channels.end(), isVolts);
        if (count != 1) {
            return invalid("{} channels are in volts; name the one that is across the shunt",
                           count == 0 ? "no" : fmt::format("{}", count));
        }
        index = static_cast<std::size_t>(first - capture.channels.begin());
    }
    auto& target = capture.channels[index];
    if (target.unit != "V") {
        return invalid("channel '{}' is in {}; a shunt converts volts", target.name,
                       target.unit.empty() ? "no unit" : target.unit);
    }
    target.unit.assign(1, 'A');
    for (float& sample : target.samples) sample = static_cast<float>(static_cast<double>(sample) / ohms);
    for (double* scaled : {&target.low, &target.high, &target.lsb, &target.offsetTolerance, &target.linearityTolerance})
        *scaled /= ohms;
    return {};
}

}  // namespace tacto
