#include "core/session/Chunk.h"

#include <bit>
#include <cmath>
#include <cstring>

#include "core/base/NaN.h"
#include "core/base/RecordFields.h"

namespace tacto {

static_assert(std::endian::native == std::endian::little, "session files are little-endian");

namespace {

/// A number of the line, which stands in an object of its own nowhere.
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
    all.passOverUnknownKeys();
    all.rule([](const C& head) -> Result<void> {
        if (!head.line || !(std::isnan(head.line->t0_s) || std::isnan(head.line->step_s))) return {};
        return fail(ErrorCode::ParseError, "it has one of t0_s and step_s; both or neither was expected");
    });
    return all;
}

const RecordFields<ChunkHead>& chunkFields() {
    static const auto fields = buildChunkFields();
    return fields;
}

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

Result<void> unpackChunk(const ChunkHead& head, std::size_t columns, std::span<const std::byte> stamps,
                         std::span<const std::byte> data, SampleBlock& into) {
    into.clear();
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
    if (head.line) {
        for (std::size_t i = 0; i < samples; ++i)
            into.t_s[i] = head.line->t0_s + static_cast<double>(i) * head.line->step_s;
    } else {
        std::memcpy(into.t_s.data(), stamps.data(), stamps.size());
    }
    return {};
}

}  // namespace tacto
