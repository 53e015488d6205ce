#include "core/formats/WavHeader.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/Text.h"

namespace tacto {

namespace {

constexpr std::string_view kOwnComment = "Tactoscope capture";
constexpr std::uint64_t kRiffHeader = 12;
constexpr std::uint64_t kLongestComment = 65536;

std::uint32_t number(std::string_view bytes, std::size_t at, std::size_t count) {
    std::uint32_t value = 0;
    for (std::size_t i = count; i > 0; --i) value = value << 8U | static_cast<unsigned char>(bytes[at + i - 1]);
    return value;
}

void append(std::string& text, std::uint32_t value, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) text.push_back(static_cast<char>(value >> (8 * i) & 0xFFU));
}

Result<std::string> bytesAt(ByteFile& file, std::uint64_t at, std::uint64_t count) {
    std::string bytes(static_cast<std::size_t>(count), '\0');
    if (auto placed = file.seek(at); !placed) return failure(placed);
    const auto got = file.read(bytes.data(), bytes.size());
    if (!got) return failure(got);
    bytes.resize(*got);
    return bytes;
}

Result<void> takeFormat(std::string_view chunk, WavHeader& header, std::string_view file) {
    constexpr std::uint32_t kPcm = 1;
    constexpr std::uint32_t kFloat = 3;
    constexpr std::uint32_t kExtensible = 0xFFFE;
    if (chunk.size() < 16) {
        return fail(ErrorCode::ParseError, "{}: the fmt chunk has {} bytes; at least 16 were expected", file,
                    chunk.size());
    }
    auto kind = number(chunk, 0, 2);
    // The extensible form carries the old number at the beginning of an identifier.
    if (kind == kExtensible && chunk.size() >= 26) kind = number(chunk, 24, 2);
    header.channels = number(chunk, 2, 2);
    header.rate_hz = number(chunk, 4, 4);
    header.bits = number(chunk, 14, 2);
    header.isFloat = kind == kFloat;
    const auto bits = header.bits;
    const bool known = kind == kPcm ? bits == 8 || bits == 16 || bits == 24 || bits == 32
                                    : kind == kFloat && (bits == 32 || bits == 64);
    if (!known) {
        return fail(ErrorCode::ParseError,
                    "{}: samples of kind {} with {} bits; PCM of 8, 16, 24 or 32 or floats of 32 or 64 were expected",
                    file, kind, bits);
    }
    if (header.channels == 0 || header.rate_hz == 0) {
        return fail(ErrorCode::ParseError, "{}: {} channels at {} Hz; at least one of each was expected", file,
                    header.channels, header.rate_hz);
    }
    return {};
}

std::string commentIn(std::string_view list) {
    if (!list.starts_with("INFO")) return {};
    for (std::size_t at = 4; at + 8 <= list.size();) {
        const std::size_t size = number(list, at + 4, 4);
        if (list.substr(at, 4) == "ICMT") {
            auto text = list.substr(at + 8, size);
            return std::string(text.substr(0, text.find('\0')));
        }
        at += 8 + size + size % 2;
    }
    return {};
}

std::string ownComment(const Capture& capture) {
    std::string text(kOwnComment);
    text += fmt::format("\nstart_s={}", capture.start_s);
    for (const auto& channel : capture.channels) {
        std::string name = channel.name;
        std::ranges::replace_if(
            name, [](char c) { return c == '\n' || c == '\0'; }, ' ');
        text += fmt::format("\nchannel={};{}", channel.unit, name);
    }
    return text;
}

}  // namespace

bool isWav(std::string_view head) noexcept {
    return head.size() >= kRiffHeader && head.starts_with("RIFF") && head.substr(8, 4) == "WAVE";
}

Result<WavHeader> readWavHeader(ByteFile& file) {
    const auto riff = bytesAt(file, 0, kRiffHeader);
    if (!riff) return failure(riff);
    if (!isWav(*riff)) return fail(ErrorCode::ParseError, "{}: no RIFF WAVE at its beginning", file.name());
    WavHeader header;
    bool described = false;
    for (std::uint64_t at = kRiffHeader; at + 8 <= file.size();) {
        const auto tag = bytesAt(file, at, 8);
        if (!tag) return failure(tag);
        if (tag->size() < 8) break;
        const std::uint64_t size = number(*tag, 4, 4);
        const auto name = std::string_view(*tag).substr(0, 4);
        const std::uint64_t begin = at + 8;
        const std::uint64_t there = std::min(size, file.size() - begin);
        if (name == "data") {
            if (!described) break;
            header.begin = begin;
            // Programs that write to a pipe leave 0 or all ones: then the samples go to the end.
            const bool open = size == 0 || size == 0xFFFFFFFFU;
            header.bytes = open ? file.size() - begin : there;
            header.cutShort = !open && there < size;
            return header;
        }
        if (name == "fmt " || name == "LIST") {
            const auto chunk = bytesAt(file, begin, std::min(there, kLongestComment));
            if (!chunk) return failure(chunk);
            if (name == "LIST") {
                header.comment = commentIn(*chunk);
            } else {
                if (auto taken = takeFormat(*chunk, header, file.name()); !taken) return failure(taken);
                described = true;
            }
        }
        at = begin + size + size % 2;
    }
    return fail(ErrorCode::ParseError, "{}: no {} chunk; one was expected before byte {}", file.name(),
                described ? "data" : "fmt", file.size());
}

std::string wavHeaderOf(const Capture& capture, std::uint32_t rate_hz) {
    const auto channels = static_cast<std::uint32_t>(capture.channels.size());
    constexpr std::uint32_t kSampleBytes = 4;
    std::string info = "INFO";
    auto comment = ownComment(capture);
    comment.push_back('\0');
    info += "ICMT";
    append(info, static_cast<std::uint32_t>(comment.size()), 4);
    if (comment.size() % 2 != 0) comment.push_back('\0');
    info += comment;

    std::string rest = "WAVEfmt ";
    append(rest, 16, 4);
    append(rest, 3, 2);  // float
    append(rest, channels, 2);
    append(rest, rate_hz, 4);
    append(rest, rate_hz * channels * kSampleBytes, 4);  // wraps for rates that no sound card has; not needed
    append(rest, channels * kSampleBytes, 2);
    append(rest, 8 * kSampleBytes, 2);
    rest += "LIST";
    append(rest, static_cast<std::uint32_t>(info.size()), 4);
    rest += info;
    rest += "data";
    const auto dataBytes = static_cast<std::uint32_t>(capture.samples() * channels * kSampleBytes);
    append(rest, dataBytes, 4);

    std::string header = "RIFF";
    append(header, static_cast<std::uint32_t>(rest.size()) + dataBytes, 4);
    return header + rest;
}

bool takeOwnComment(std::string_view comment, Capture& capture) {
    const auto lines = split(comment, '\n');
    if (lines.empty() || lines.front() != kOwnComment) return false;
    std::size_t next = 0;
    for (const auto line : lines) {
        if (line.starts_with("start_s=")) {
            const auto start = parseNumber(line.substr(8));
            if (start && std::isfinite(*start)) capture.start_s = *start;
        }
        if (line.starts_with("channel=") && next < capture.channels.size()) {
            const auto text = line.substr(8);
            const auto semicolon = std::min(text.find(';'), text.size());
            const auto unit = text.substr(0, semicolon);
            auto& channel = capture.channels[next++];
            if (unit == "V" || unit == "A") channel.unit = unit;
            if (semicolon + 1 < text.size()) channel.name = text.substr(semicolon + 1);
        }
    }
    return next == capture.channels.size();
}

}  // namespace tacto
