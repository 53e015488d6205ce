#include "core/measure/CaptureFile.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <limits>

#include "core/base/Csv.h"
#include "core/base/Text.h"

namespace tacto {

namespace {

struct KnownUnit {
    std::string_view spelled;  // lower case
    std::string_view unit;
    double factor;
};
constexpr std::array<KnownUnit, 12> kUnits{{{"s", "s", 1},
                                            {"ms", "s", 1e-3},
                                            {"us", "s", 1e-6},
                                            {"ns", "s", 1e-9},
                                            {"v", "V", 1},
                                            {"mv", "V", 1e-3},
                                            {"uv", "V", 1e-6},
                                            {"kv", "V", 1e3},
                                            {"a", "A", 1},
                                            {"ma", "A", 1e-3},
                                            {"ua", "A", 1e-6},
                                            {"na", "A", 1e-9}}};

std::string lowered(std::string_view text) {
    std::string result(text);
    std::transform(result.begin(), result.end(), result.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return result;
}

const KnownUnit* unitCalled(std::string_view spelled) {
    std::string wanted = lowered(trimmed(spelled));
    for (const std::string_view micro : {"µ", "μ"}) {
        if (wanted.starts_with(micro)) wanted.replace(0, micro.size(), "u");
    }
    const auto found = std::find_if(kUnits.begin(), kUnits.end(), [&](const auto& u) { return u.spelled == wanted; });
    return found == kUnits.end() ? nullptr : &*found;
}

struct ColumnName {
    std::string name;
    std::string unit;  // "s", "V", "A" or ""
    double factor = 1;
};

/// "voltage_v", "CH1 (mV)", "time [us]", "D0". Nothing when a bracketed unit is unknown.
std::optional<ColumnName> parseColumnName(std::string_view text) {
    const auto bracket = text.find_first_of("([");
    if (bracket != std::string_view::npos && bracket > 0 && (text.ends_with(')') || text.ends_with(']'))) {
        const auto* unit = unitCalled(text.substr(bracket + 1, text.size() - bracket - 2));
        if (unit == nullptr) return std::nullopt;
        return ColumnName{std::string(trimmed(text.substr(0, bracket))), std::string(unit->unit), unit->factor};
    }
    const auto mark = text.rfind('_');
    if (mark != std::string_view::npos && mark > 0) {
        if (const auto* unit = unitCalled(text.substr(mark + 1))) {
            return ColumnName{std::string(text.substr(0, mark)), std::string(unit->unit), unit->factor};
        }
    }
    return ColumnName{std::string(text), "", 1};
}

bool isTime(const ColumnName& column) {
    const auto name = lowered(column.name);
    return column.unit == "s" || (column.unit.empty() && (name == "time" || name == "t" || name == "seconds"));
}

/// Rows at the end in which no channel has a value: half-written files, and oscilloscopes that pad.
std::size_t rowsWithValues(const NumericCsv& table, std::size_t timeColumn) {
    std::size_t rows = table.rows();
    const auto empty = [&](std::size_t row) {
        for (std::size_t c = 0; c < table.columns.size(); ++c) {
            if (c != timeColumn && !std::isnan(table.columns[c][row])) return false;
        }
        return true;
    };
    while (rows > 0 && empty(rows - 1)) --rows;
    return rows;
}

/// Rate and start from the stamps, or why they are no sampling.
Result<void> readTimes(const std::vector<double>& times, const NumericCsv& table, std::size_t rows,
                       std::string_view name, Capture& capture) {
    for (std::size_t i = 0; i < rows; ++i) {
        if (!std::isfinite(times[i])) {
            return fail(ErrorCode::ParseError, "{}:{}: the time is missing; every row needs one", name, table.lines[i]);
        }
    }
    const double step = (times[rows - 1] - times[0]) / static_cast<double>(rows - 1);
    std::vector<double> steps(rows - 1);
    for (std::size_t i = 0; i + 1 < rows; ++i) steps[i] = times[i + 1] - times[i];
    bool even = step > 0;
    for (std::size_t i = 0; i < rows && even; ++i) {
        even = std::abs(times[i] - times[0] - static_cast<double>(i) * step) <= 0.5 * step;
    }
    if (!even) {
        std::vector<double> sorted = steps;
        const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
        std::nth_element(sorted.begin(), middle, sorted.end());
        const auto worst = std::max_element(steps.begin(), steps.end(), [&](double a, double b) {
            return std::abs(a - *middle) < std::abs(b - *middle);
        });
        const auto row = static_cast<std::size_t>(worst - steps.begin()) + 1;
        return fail(ErrorCode::ParseError,
                    "{}:{}: time moves by {:.6g} s here; it must rise in even steps (most are {:.6g} s)", name,
                    table.lines[row], *worst, *middle);
    }
    capture.rate_hz = 1.0 / step;
    capture.start_s = times[0];
    capture.trigger_s = std::numeric_limits<double>::quiet_NaN();
    return {};
}

std::string columnNameOf(const CaptureChannel& channel) {
    std::string name = channel.unit.empty() ? channel.name : fmt::format("{}_{}", channel.name, lowered(channel.unit));
    std::replace_if(
        name.begin(), name.end(), [](char c) { return c == ',' || c == '"' || c == '\n' || c == '\r'; }, ' ');
    return name;
}

/// Fixed-point, several times faster than the general way: a session writes millions of these.
void appendTime(fmt::memory_buffer& text, double t, int decimals) {
    double scale = 1;
    for (int i = 0; i < decimals; ++i) scale *= 10;
    const double scaled = std::round(std::abs(t) * scale);
    if (!(scaled < 9e15)) {  // beyond this a double no longer holds every integer
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

}  // namespace

Result<CaptureReading> readCapture(const std::filesystem::path& path) {
    const auto text = readTextFile(path);
    if (!text) return failure(text);
    return parseCapture(*text, path.string());
}

Result<CaptureReading> parseCapture(std::string_view text, std::string_view name) {
    const auto table = parseNumericCsv(text, name);
    if (!table) return failure(table);

    std::vector<ColumnName> columns;
    for (const auto& column : table->names) {
        const auto parsed = parseColumnName(column);
        if (!parsed) {
            return fail(ErrorCode::ParseError,
                        "{}:{}: the unit of column '{}' is unknown; s, V or A with m, u, n or k were expected", name,
                        table->headerLine, column);
        }
        columns.push_back(*parsed);
    }
    const auto time = std::find_if(columns.begin(), columns.end(), isTime);
    if (time == columns.end() || columns.size() < 2) {
        return fail(ErrorCode::ParseError,
                    "{}:{}: columns '{}'; a time column and channels were expected, as in time_s,voltage_v,current_a",
                    name, table->headerLine, fmt::join(table->names, ","));
    }
    const auto timeColumn = static_cast<std::size_t>(time - columns.begin());

    CaptureReading reading;
    const std::size_t rows = rowsWithValues(*table, timeColumn);
    if (rows < table->rows()) {
        reading.warnings.push_back(
            fmt::format("{}:{}: {} without values at the end left out", name, table->lines[rows],
                        table->rows() - rows == 1 ? "a row" : fmt::format("{} rows", table->rows() - rows)));
    }
    if (rows < 2) {
        return fail(ErrorCode::ParseError, "{}:{}: {} row(s) with values; at least 2 were expected", name,
                    table->lines.back(), rows);
    }
    std::vector<double> times = table->columns[timeColumn];
    for (double& t : times) t *= time->factor;
    if (auto read = readTimes(times, *table, rows, name, reading.capture); !read) return failure(read);

    for (std::size_t c = 0; c < columns.size(); ++c) {
        if (c == timeColumn) continue;
        CaptureChannel channel;
        channel.name = columns[c].name;
        channel.unit = columns[c].unit;
        channel.samples.reserve(rows);
        std::size_t missing = 0;
        for (std::size_t i = 0; i < rows; ++i) {
            // Beyond a float is beyond any oscilloscope: as missing as nan.
            const auto value = static_cast<float>(table->columns[c][i] * columns[c].factor);
            if (!std::isfinite(value) && missing++ == 0) {
                reading.warnings.push_back(fmt::format(
                    "{}:{}: column '{}' has no finite value here; pulses that touch a missing sample are not measured",
                    name, table->lines[i], table->names[c]));
            }
            channel.samples.push_back(std::isfinite(value) ? value : std::numeric_limits<float>::quiet_NaN());
        }
        reading.capture.channels.push_back(std::move(channel));
    }
    return reading;
}

Result<void> writeCapture(const std::filesystem::path& path, const Capture& capture) {
    if (capture.samples() == 0) return fail(ErrorCode::InvalidArgument, "a capture without samples cannot be written");
    if (!(capture.rate_hz > 0) || !std::isfinite(capture.rate_hz) || !std::isfinite(capture.start_s)) {
        return fail(ErrorCode::InvalidArgument,
                    "a capture at {} Hz from {} s cannot be written; both must be finite and the rate above 0",
                    capture.rate_hz, capture.start_s);
    }
    fmt::memory_buffer text;
    auto out = std::back_inserter(text);
    fmt::format_to(out, "time_s");
    for (const auto& channel : capture.channels) {
        if (channel.samples.size() != capture.samples()) {
            return fail(ErrorCode::InvalidArgument,
                        "channel '{}' has {} samples; {} were expected, as in the first channel", channel.name,
                        channel.samples.size(), capture.samples());
        }
        fmt::format_to(out, ",{}", columnNameOf(channel));
    }
    fmt::format_to(out, "\n");
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
    }
    std::ofstream stream(path, std::ios::binary);
    stream.write(text.data(), static_cast<std::streamsize>(text.size()));
    stream.flush();
    if (!stream) return fail(ErrorCode::Io, "{} could not be written", path.string());
    return {};
}

Result<std::size_t> findChannel(const Capture& capture, std::string_view name) {
    const auto wanted = lowered(trimmed(name));
    std::string known;
    for (std::size_t c = 0; c < capture.channels.size(); ++c) {
        const auto& channel = capture.channels[c];
        if (lowered(channel.name) == wanted || lowered(columnNameOf(channel)) == wanted) return c;
        known += (c == 0 ? "" : ", ") + channel.name;
    }
    return fail(ErrorCode::NotFound, "no channel '{}'; the capture has {}", trimmed(name),
                known.empty() ? "none" : known);
}

Result<void> convertShunt(Capture& capture, std::optional<std::string_view> channel, Ohms shunt) {
    const double ohms = shunt.value();
    if (!(ohms > 0) || !std::isfinite(ohms)) {
        return fail(ErrorCode::InvalidArgument, "a shunt of {} ohm; a finite value above 0 was expected", ohms);
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
            return fail(ErrorCode::InvalidArgument, "{} channels are in volts; name the one that is across the shunt",
                        count == 0 ? "no" : fmt::format("{}", count));
        }
        index = static_cast<std::size_t>(first - capture.channels.begin());
    }
    auto& target = capture.channels[index];
    if (target.unit != "V") {
        return fail(ErrorCode::InvalidArgument, "channel '{}' is in {}; a shunt converts volts", target.name,
                    target.unit.empty() ? "no unit" : target.unit);
    }
    target.unit = "A";
    for (float& sample : target.samples) sample = static_cast<float>(static_cast<double>(sample) / ohms);
    for (double* scaled : {&target.low, &target.high, &target.lsb, &target.offsetTolerance}) *scaled /= ohms;
    return {};
}

}  // namespace tacto
