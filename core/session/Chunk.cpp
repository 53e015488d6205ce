#include "core/session/Chunk.h"

#include <bit>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <zlib.h>

#include "core/base/JsonText.h"
#include "core/base/Printable.h"
#include "core/base/RecordFields.h"
#include "core/base/Statistics.h"
#include "core/measure/CaptureDescription.h"
#include "core/packing/PackedColumns.h"

namespace tacto {

static_assert(std::endian::native == std::endian::little, "session files are little-endian");

namespace {

/// Describes a number of the line. In JSON the number is a member of the head, not of an object of its own.
ValueKind<ChunkHead> lineKind(double StampLine::*number) {
    ValueKind<ChunkHead> kind;
    kind.info.accepted = "a number";
    kind.reads([number](const nlohmann::json& value, ChunkHead& head, const RecordPlace& place,
                        std::string_view key) -> Result<void> {
        if (!value.is_number()) return place.refuse(ErrorCode::ParseError, key, shownJson(value), "a number");
        if (!head.line) head.line = StampLine{kNaN, kNaN};
        (*head.line).*number = value.get<double>();
        return {};
    });
    kind.writes([number](const ChunkHead& head) {
        return head.line ? nlohmann::json((*head.line).*number) : nlohmann::json();
    });
    return kind;
}

RecordFields<ChunkHead> buildChunkFields() {
    using C = ChunkHead;
    RecordFields<C> all;
    all.number("stream", &C::stream, {.low = 0}).required = true;
    all.number("index", &C::index, {.low = 0}).required = true;
    all.number("first", &C::firstSample).required = true;
    all.number("samples", &C::samples).required = true;
    all.number("crc32", &C::crc).required = true;
    all.add("t0_s", std::identity{}, lineKind(&StampLine::t0_s)).leftOutIfEmpty = true;
    all.add("step_s", std::identity{}, lineKind(&StampLine::step_s)).leftOutIfEmpty = true;
    all.text("packing", &C::packing).leftOutIfEmpty = true;
    all.passOverUnknownKeys();
    all.rule([](const C& head) -> Result<void> {
        if (!head.line || !(std::isnan(head.line->t0_s) || std::isnan(head.line->step_s))) return {};
        return fail(ErrorCode::ParseError, "it has one of t0_s and step_s; both or neither was expected");
    });
    return all;
}

const RecordFields<ChunkHead>& chunkFields() { return builtOnce<buildChunkFields>(); }

}  // namespace

std::optional<StampLine> lineThrough(std::span<const double> t_s) noexcept {
    if (t_s.empty() || !std::isfinite(t_s.front()) || !std::isfinite(t_s.back())) return std::nullopt;
    const double t0 = t_s.front();
    const double step = t_s.size() < 2 ? 0 : (t_s.back() - t0) / static_cast<double>(t_s.size() - 1);
    for (std::size_t i = 0; i < t_s.size(); ++i) {
        if (!(std::abs(t_s[i] - (t0 + static_cast<double>(i) * step)) <= kStampTolerance_s)) return std::nullopt;
    }
    return StampLine{t0, step};
}

std::string toJsonText(const ChunkHead& head) { return dumpJson(chunkFields().write(head)); }

Result<ChunkHead> parseChunkHead(std::string_view text) {
    return parseRecord(chunkFields(), text, "the description of a chunk");
}

Result<ChunkHead> chunkHeadFrom(const nlohmann::json& json) {
    return chunkFields().read(json, {.file = "the description of a chunk"}).map_error(asParseError);
}

std::array<std::span<const std::byte>, 2> recordedBytes(const SampleBlock& block, bool withStamps) noexcept {
    const auto stamps = std::span(block.t_s).first(withStamps ? block.samples() : 0);
    return {std::as_bytes(stamps), std::as_bytes(std::span(block.values))};
}

namespace {
void putLine(const ChunkHead& head, SampleBlock& into) {
    for (std::size_t i = 0; head.line && i < into.t_s.size(); ++i)
        into.t_s[i] = head.line->t0_s + static_cast<double>(i) * head.line->step_s;
}
}  // namespace

Result<void> unpackChunk(const ChunkHead& head, std::size_t columns, std::span<const std::byte> stamps,
                         std::span<const std::byte> data, SampleBlock& into) {
    into.clear();
    if (head.packing) {
        const auto because = [&](std::string_view why) {
            return fmt::format("chunk {} of stream {} cannot be unpacked: {}", head.index, head.stream, why);
        };
        if (*head.packing != kPackedAsSteps)
            return fail(ErrorCode::Unsupported, "{}",
                        because(fmt::format("it is packed as '{}', and this program knows '{}'",
                                            printable(*head.packing), kPackedAsSteps)));
        auto unpacked = unpackColumns(data, head.samples, columns, !head.line, into);
        if (!unpacked) return fail(ErrorCode::ParseError, "{}", because(unpacked.error().message));
        putLine(head, into);
        return {};
    }
    const std::size_t samples = data.size() / sizeof(double) / columns;
    if (samples != head.samples || data.size() != samples * columns * sizeof(double) ||
        (head.line ? 0 : samples * sizeof(double)) != stamps.size()) {
        return fail(ErrorCode::ParseError, "chunk {} of stream {} holds {} bytes of samples, not {} samples of {}",
                    head.index, head.stream, data.size(), head.samples, columns);
    }
    into.values.resize(samples * columns);
    into.t_s.resize(samples);
    if (samples == 0) return {};
    std::memcpy(into.values.data(), data.data(), data.size());
    if (!head.line) std::memcpy(into.t_s.data(), stamps.data(), stamps.size());
    putLine(head, into);
    return {};
}

void stampsOf(const ChunkHead& head, SampleBlock& into) {
    into.clear();
    into.t_s.resize(head.samples);
    putLine(head, into);
}

namespace {

/// Puts bytes of equal significance side by side: the high bytes of a converter's codes repeat, so deflate finds them.
constexpr std::size_t kWidth = sizeof(float);

std::vector<std::byte> planes(const Capture& capture) {
    const std::size_t samples = capture.samples();
    std::vector<std::byte> out(samples * capture.channels.size() * kWidth);
    std::byte* plane = out.data();
    for (const auto& channel : capture.channels) {
        const auto bytes = std::as_bytes(std::span(channel.samples));
        for (std::size_t b = 0; b < kWidth; ++b) {
            for (std::size_t i = 0; i < samples; ++i) plane[i] = bytes[i * kWidth + b];
            plane += samples;
        }
    }
    return out;
}

void fromPlanes(std::span<const std::byte> bytes, Capture& capture, std::size_t samples) {
    const std::byte* plane = bytes.data();
    for (auto& channel : capture.channels) {
        channel.samples.resize(samples);
        const auto out = std::as_writable_bytes(std::span(channel.samples));
        for (std::size_t b = 0; b < kWidth; ++b) {
            for (std::size_t i = 0; i < samples; ++i) out[i * kWidth + b] = plane[i];
            plane += samples;
        }
    }
}

/// A deflated capture cannot unpack to more than this many times its size (deflate's own limit is 1032).
constexpr std::size_t kLargestRatio = 1100;

}  // namespace

PackedCapture packSamples(const Capture& capture) {
    PackedCapture packed{planes(capture), false};
    uLongf size = compressBound(static_cast<uLong>(packed.data.size()));
    std::vector<std::byte> smaller(size);
    const int code =
        compress2(reinterpret_cast<Bytef*>(smaller.data()), &size, reinterpret_cast<const Bytef*>(packed.data.data()),
                  static_cast<uLong>(packed.data.size()), Z_BEST_SPEED);
    if (code == Z_OK && size < packed.data.size() - packed.data.size() / 10) {
        smaller.resize(size);
        packed = {std::move(smaller), true};
    }
    return packed;
}

nlohmann::json describePacked(const Capture& capture, const PackedCapture& packed) {
    auto description = describeCapture(capture);
    description["samples"] = capture.samples();
    description["deflated"] = packed.deflated;
    return description;
}

Result<Capture> unpackCapture(const nlohmann::json& description, std::span<const std::byte> data) {
    auto described = captureDescribed(description);
    if (!described) return fail(ErrorCode::ParseError, "a capture has no list of channels");
    Capture& capture = *described;
    const auto samples = static_cast<std::size_t>(countOr(description, "samples"));
    const bool deflated = flagOr(description, "deflated");
    const std::size_t values = deflated ? data.size() * kLargestRatio / kWidth : data.size() / kWidth;
    if (capture.channels.empty() ? samples != 0 : samples > values / capture.channels.size()) {
        return fail(ErrorCode::ParseError, "a capture says {} samples and holds {} bytes", samples, data.size());
    }
    std::vector<std::byte> bytes;
    const std::size_t expected = samples * capture.channels.size() * kWidth;
    if (deflated) {
        bytes.resize(expected);
        auto size = static_cast<uLongf>(expected);
        const int code = uncompress(reinterpret_cast<Bytef*>(bytes.data()), &size,
                                    reinterpret_cast<const Bytef*>(data.data()), static_cast<uLong>(data.size()));
        if (code != Z_OK || size != expected) return fail(ErrorCode::ParseError, "a capture does not unpack");
        data = bytes;
    }
    if (data.size() != expected) {
        return fail(ErrorCode::ParseError, "a capture says {} samples and holds {} bytes", samples, data.size());
    }
    fromPlanes(data, capture, samples);
    return std::move(capture);
}

}  // namespace tacto
