#include "core/formats/IsfFormat.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/base/LocaleFreeText.h"
#include "core/formats/ChannelOptions.h"
#include "core/formats/TextBlocks.h"

namespace tacto {

namespace {

constexpr std::size_t kBlock = 1024UL * 1024;

/// The header of a block, "#6200000": where the samples begin and how many bytes they have.
struct Block {
    std::size_t begin;
    std::size_t bytes;
};
Result<Block> blockAt(std::string_view head, std::size_t at, std::string_view file) {
    const auto wrong = [&] {
        return fail(ErrorCode::ParseError,
                    "{}: byte {}: '#', a digit and that many digits of a length were expected before the samples", file,
                    at);
    };
    if (at + 2 > head.size() || head[at] != '#' || head[at + 1] < '1' || head[at + 1] > '9') return wrong();
    const auto digits = static_cast<std::size_t>(head[at + 1] - '0');
    const auto length = parseNumber(head.substr(at + 2, digits));
    if (at + 2 + digits > head.size() || !length || !(*length >= 0) || *length != std::floor(*length)) return wrong();
    return Block{at + 2 + digits, static_cast<std::size_t>(*length)};
}

float codeAt(const unsigned char* bytes, const IsfPreamble& pre) {
    if (pre.bytes == 1) return pre.isSigned ? static_cast<float>(static_cast<signed char>(*bytes)) : *bytes;
    const unsigned high = pre.mostFirst ? bytes[0] : bytes[1];
    const unsigned low = pre.mostFirst ? bytes[1] : bytes[0];
    const auto code = static_cast<std::uint16_t>(high << 8U | low);
    return pre.isSigned ? static_cast<float>(static_cast<std::int16_t>(code)) : static_cast<float>(code);
}

Result<void> readBlock(ByteFile& file, std::string_view head, const IsfPreamble& pre, const ReadWatch& watch,
                       CaptureReading& reading) {
    auto& samples = reading.capture.channels[0].samples;
    const auto block = blockAt(head, pre.curve, file.name());
    if (!block) return failure(block);
    const std::size_t announced = block->bytes / pre.bytes;
    const auto there =
        static_cast<std::size_t>(file.size() - std::min<std::uint64_t>(file.size(), block->begin)) / pre.bytes;
    const std::size_t wanted = std::min({announced, pre.points, there});
    if (wanted < pre.points) {
        reading.warnings.push_back(fmt::format("{}: {} points are announced, {} are there: the file was cut short",
                                               file.name(), pre.points, wanted));
    }
    if (auto placed = file.seek(block->begin); !placed) return placed;
    samples.reserve(wanted);
    std::vector<char> chunk(kBlock);
    bool lowBits = false;
    while (samples.size() < wanted) {
        const auto got = file.read(chunk.data(), std::min(kBlock, (wanted - samples.size()) * pre.bytes));
        if (!got) return failure(got);
        const auto count = *got / pre.bytes;
        if (count == 0) return fail(ErrorCode::Io, "{} became shorter while it was read", file.name());
        const auto* bytes = reinterpret_cast<const unsigned char*>(chunk.data());
        for (std::size_t i = 0; i < count; ++i) {
            const float code = codeAt(bytes + i * pre.bytes, pre);
            lowBits = lowBits || (pre.bytes == 2 && std::fmod(code, 256.0F) != 0);
            samples.push_back(static_cast<float>(pre.valueOf(static_cast<double>(code))));
        }
        const auto done = static_cast<double>(samples.size()) / static_cast<double>(wanted);
        if (auto going = keepReading(watch, done, file.name()); !going) return going;
    }
    // Two-byte samples whose low bits are all zero come from an 8-bit converter, with codes up to 0x7F00.
    const double step = pre.bytes == 2 && !lowBits ? 256 : 1;
    const double codes = pre.bytes == 2 ? 65536 : 256;
    const double lowest = pre.isSigned ? -codes / 2 : 0;
    auto& channel = reading.capture.channels[0];
    channel.low = std::min(pre.valueOf(lowest), pre.valueOf(lowest + codes - step));
    channel.high = std::max(pre.valueOf(lowest), pre.valueOf(lowest + codes - step));
    channel.lsb = std::abs(pre.scale) * step;
    return {};
}

Result<void> readText(ByteFile& file, const IsfPreamble& pre, const ReadWatch& watch, CaptureReading& reading) {
    auto& samples = reading.capture.channels[0].samples;
    if (auto placed = file.seek(pre.curve); !placed) return placed;
    std::vector<char> chunk(kBlock);
    std::string rest;
    std::uint64_t taken = pre.curve;
    for (bool ended = false; !ended && samples.size() < pre.points;) {
        const auto got = file.read(chunk.data(), chunk.size());
        if (!got) return failure(got);
        ended = *got == 0;
        rest.append(chunk.data(), *got);
        taken += *got;
        std::size_t at = 0;
        for (;;) {
            const auto comma = rest.find_first_of(",;\n", at);
            if (comma == std::string::npos && !ended) break;
            const auto field = trimmed(std::string_view(rest).substr(at, comma - at));
            if (!field.empty()) {
                const auto code = parseNumber(field);
                if (!code) {
                    return fail(ErrorCode::ParseError, "{}: point {} is '{}'; a number was expected", file.name(),
                                samples.size() + 1, field.substr(0, 40));
                }
                samples.push_back(static_cast<float>(isNoValue(*code) ? *code : pre.valueOf(*code)));
            }
            at = comma == std::string::npos ? rest.size() : comma + 1;
            if (at >= rest.size() || samples.size() == pre.points) break;
        }
        rest.erase(0, at);
        if (rest.size() > 2 * kBlock) {
            return fail(ErrorCode::ParseError, "{}: point {} is longer than {} bytes; a number was expected",
                        file.name(), samples.size() + 1, kBlock);
        }
        const auto done = static_cast<double>(taken) / static_cast<double>(std::max<std::uint64_t>(file.size(), 1));
        if (auto going = keepReading(watch, std::min(1.0, done), file.name()); !going) return going;
    }
    if (samples.size() < pre.points) {
        reading.warnings.push_back(fmt::format("{}: {} points are announced, {} are there: the file was cut short",
                                               file.name(), pre.points, samples.size()));
    }
    return {};
}

}  // namespace

bool IsfFormat::recognises(const std::filesystem::path& /*path*/, std::string_view head) const { return isIsf(head); }

Result<CaptureReading> IsfFormat::read(const std::filesystem::path& path, const ReadOptions& options,
                                       const ReadWatch& watch) const {
    const auto head = readHead(path);
    if (!head) return failure(head);
    auto file = ByteFile::open(path);
    if (!file) return failure(file);
    const auto pre = readIsfPreamble(*head, file->name());
    if (!pre) return failure(pre);
    CaptureReading reading;
    auto& channel = reading.capture.channels.emplace_back();
    // "Ch1, DC coupling, 2.000V/div, …": the first part is the source.
    channel.name = capitals(trimmed(std::string_view(pre->title).substr(0, pre->title.find(','))));
    if (channel.name.empty()) channel.name = "CH1";
    auto read = pre->text ? readText(*file, *pre, watch, reading) : readBlock(*file, *head, *pre, watch, reading);
    if (!read) return failure(read);
    if (pre->text) dropNoValues(reading, file->name());
    if (channel.samples.size() < 2) {
        return fail(ErrorCode::ParseError, "{}: {} point(s) in the file; at least 2 were expected", file->name(),
                    channel.samples.size());
    }
    const auto unit = channelUnit(pre->unit);
    const double factor = unit ? unit->factor : 1;
    channel.unit = unit ? unit->unit : "";
    for (float& sample : channel.samples) sample = static_cast<float>(static_cast<double>(sample) * factor);
    for (double* scaled : {&channel.low, &channel.high, &channel.lsb}) *scaled *= factor;
    if (!unit && !options.units.contains(channel.name)) {
        reading.warnings.push_back(fmt::format("{}: the unit '{}' of {} is unknown; its values are bare numbers",
                                               file->name(), pre->unit, channel.name));
    }
    reading.capture.rate_hz = 1 / pre->interval_s;
    reading.capture.start_s = pre->start_s;
    reading.capture.trigger_s = std::numeric_limits<double>::quiet_NaN();
    if (options.rate) {
        const auto rate = rateFrom(options);
        if (!rate) return failure(rate);
        reading.capture.rate_hz = *rate;
    }
    auto applied =
        applyChannelOptions(reading.capture, {{channel.name, 1, channel.unit, factor, ""}}, options, file->name());
    if (!applied) return failure(applied);
    return reading;
}

namespace {

/// The long spelling of a key and the shortest one in use. Any length between them is the same key.
struct Key {
    std::string_view full;
    std::string_view shortest;
};
constexpr Key kBytes{"byt_nr", "byt_n"};
constexpr Key kEncoding{"encdg", "enc"};
constexpr Key kNumbers{"bn_fmt", "bn_f"};
constexpr Key kOrder{"byt_or", "byt_o"};
constexpr Key kTitle{"wfid", "wfi"};
constexpr Key kPoints{"nr_pt", "nr_p"};
constexpr Key kPointFormat{"pt_fmt", "pt_f"};
constexpr Key kXUnit{"xunit", "xun"};
constexpr Key kXStep{"xincr", "xin"};
constexpr Key kXZero{"xzero", "xze"};
constexpr Key kPointOffset{"pt_off", "pt_o"};
constexpr Key kYUnit{"yunit", "yun"};
constexpr Key kYScale{"ymult", "ymu"};
constexpr Key kYOffset{"yoff", "yof"};
constexpr Key kYZero{"yzero", "yze"};

/// The samples begin after the last `CURV…` that is followed by a blank. This also holds the position of that word.
struct Curve {
    std::size_t word;
    std::size_t behind;
};
std::optional<Curve> curveIn(std::string_view head) {
    const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
    const std::string_view wanted = "curv";
    bool quoted = false;
    for (std::size_t i = 0; i + wanted.size() < head.size(); ++i) {
        if (head[i] == '"') quoted = !quoted;
        if (quoted || (i > 0 && head[i - 1] != ':' && head[i - 1] != ';')) continue;
        std::size_t matched = 0;
        while (matched < wanted.size() && lower(head[i + matched]) == wanted[matched]) ++matched;
        if (matched < wanted.size()) continue;
        std::size_t behind = i + matched;
        if (lower(head[behind]) == 'e') ++behind;
        while (behind < head.size() && head[behind] == ' ') ++behind;
        return Curve{i, behind};
    }
    return std::nullopt;
}

class Pairs {
public:
    explicit Pairs(std::string_view text) : text_(text) {}

    /// Returns the value after `key`, without quotes. A path may precede a key (":WFMPRE:BYT_NR").
    [[nodiscard]] std::optional<std::string_view> value(const Key& key) const {
        std::size_t at = 0;
        while (at < text_.size()) {
            std::size_t end = at;
            bool quoted = false;
            while (end < text_.size() && (quoted || text_[end] != ';')) quoted ^= text_[end++] == '"';
            const auto pair = trimmed(text_.substr(at, end - at));
            at = end + 1;
            const auto blank = pair.find(' ');
            if (blank == std::string_view::npos) continue;
            auto word = pair.substr(0, blank);
            if (const auto colon = word.rfind(':'); colon != std::string_view::npos) word.remove_prefix(colon + 1);
            const auto name = folded(word);
            if (!key.full.starts_with(name) || !name.starts_with(key.shortest)) continue;
            auto its = trimmed(pair.substr(blank));
            if (its.size() >= 2 && its.front() == '"' && its.back() == '"') its = its.substr(1, its.size() - 2);
            return its;
        }
        return std::nullopt;
    }

private:
    std::string_view text_;
};

}  // namespace

bool isIsf(std::string_view head) {
    const auto begin = folded(head.substr(0, 200));
    return begin.starts_with(":wfmp") || begin.starts_with(":wfmo") || begin.starts_with("wfmp") ||
           begin.starts_with("wfmo") || begin.starts_with("byt_n") || begin.starts_with(":curv");
}

Result<IsfPreamble> readIsfPreamble(std::string_view head, std::string_view file) {
    const auto curve = curveIn(head);
    if (!curve) {
        return fail(ErrorCode::ParseError, "{}: no :CURVE in the first {} bytes; the samples were expected behind it",
                    file, head.size());
    }
    const Pairs pairs(head.substr(0, curve->word));
    std::string wrong;  // the first error; kept here so that the fields below can be read as a table
    const auto text = [&](const Key& key) { return folded(pairs.value(key).value_or("")); };
    const auto refuse = [&](const Key& key, std::string_view expected) {
        if (!wrong.empty()) return;
        const auto its = pairs.value(key);
        wrong = its ? fmt::format("{}: {} is '{}'; {} was expected", file, key.full, its->substr(0, 40), expected)
                    : fmt::format("{}: {} is missing; {} was expected", file, key.full, expected);
    };
    const auto number = [&](const Key& key, std::optional<double> otherwise = std::nullopt) {
        const auto its = pairs.value(key);
        const auto found = its ? parseNumber(*its) : otherwise;
        if (!found || !std::isfinite(*found)) refuse(key, "a number");
        return found.value_or(0);
    };
    IsfPreamble pre;
    pre.curve = curve->behind;
    const auto encoding = text(kEncoding);
    pre.text = encoding.starts_with("asc");
    if (!pre.text && !encoding.starts_with("bin")) refuse(kEncoding, "BINARY or ASCII");
    const double bytes = number(kBytes, 1);
    if (bytes != 1 && bytes != 2) refuse(kBytes, "1 or 2");
    pre.bytes = bytes == 2 ? 2 : 1;
    const auto numbers = text(kNumbers);
    pre.isSigned = numbers != "rp";
    if (!pre.text && numbers != "ri" && numbers != "rp") refuse(kNumbers, "RI or RP (integers)");
    const auto order = text(kOrder);
    pre.mostFirst = order != "lsb";
    if (!pre.text && pre.bytes == 2 && order != "msb" && order != "lsb") refuse(kOrder, "MSB or LSB");
    const double points = number(kPoints);
    if (!(points >= 2 && points <= 4e9) || points != std::floor(points)) refuse(kPoints, "a whole number from 2 on");
    const auto format = text(kPointFormat);
    if (!format.empty() && format != "y") refuse(kPointFormat, "Y, one value per point,");
    const auto unit = text(kXUnit);
    if (!unit.empty() && unit != "s") refuse(kXUnit, "s");
    pre.interval_s = number(kXStep);
    if (!(pre.interval_s > 0) || !std::isfinite(1 / pre.interval_s)) refuse(kXStep, "a time above 0");
    pre.start_s = number(kXZero, 0) - number(kPointOffset, 0) * pre.interval_s;
    pre.scale = number(kYScale);
    if (pre.scale == 0) refuse(kYScale, "a number other than 0");
    pre.offset = number(kYOffset);
    pre.zero = number(kYZero);
    if (!std::isfinite(pre.start_s)) refuse(kXZero, "a time within reason");
    if (!std::isfinite(pre.valueOf(-65536)) || !std::isfinite(pre.valueOf(65536)))
        refuse(kYScale, "a scale within reason");
    if (!wrong.empty()) return tl::unexpected<Error>(Error{ErrorCode::ParseError, std::move(wrong)});
    pre.points = static_cast<std::size_t>(points);
    pre.unit = pairs.value(kYUnit).value_or("");
    pre.title = pairs.value(kTitle).value_or("");
    return pre;
}

}  // namespace tacto
