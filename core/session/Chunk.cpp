#include "core/session/Chunk.h"

#include <bit>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "core/base/JsonText.h"

namespace tacto {

static_assert(std::endian::native == std::endian::little, "session files are little-endian");

std::optional<StampLine> lineThrough(std::span<const double> t_s) noexcept {
    if (t_s.empty() || !std::isfinite(t_s.front()) || !std::isfinite(t_s.back())) return std::nullopt;
    const double t0 = t_s.front();
    const double step = t_s.size() < 2 ? 0 : (t_s.back() - t0) / static_cast<double>(t_s.size() - 1);
    for (std::size_t i = 0; i < t_s.size(); ++i) {
        if (!(std::abs(t_s[i] - (t0 + static_cast<double>(i) * step)) <= kStampTolerance_s)) return std::nullopt;
    }
    return StampLine{t0, step};
}

std::string toJsonText(const ChunkHead& head) {
    nlohmann::json json = {{"stream", head.stream},
                           {"index", head.index},
                           {"first", head.firstSample},
                           {"samples", head.samples},
                           {"crc32", head.crc}};
    if (head.line) {
        json["t0_s"] = head.line->t0_s;
        json["step_s"] = head.line->step_s;
    }
    return dumpJson(json);
}

Result<ChunkHead> parseChunkHead(std::string_view text) {
    const auto parsed = parseJson(text, "the description of a chunk");
    if (!parsed) return failure(parsed);
    const auto& json = *parsed;
    const auto isCount = [&](const char* key) { return json.contains(key) && json[key].is_number_unsigned(); };
    if (!json.is_object() || !isCount("stream") || !isCount("index") || !isCount("first") || !isCount("samples") ||
        !isCount("crc32")) {
        return fail(ErrorCode::ParseError, "the description of a chunk reads '{}'", text);
    }
    ChunkHead head;
    head.stream = json["stream"].get<int>();
    head.index = json["index"].get<std::int64_t>();
    head.firstSample = json["first"].get<std::uint64_t>();
    head.samples = json["samples"].get<std::uint64_t>();
    head.crc = json["crc32"].get<std::uint32_t>();
    if (json.contains("t0_s")) {
        if (!json["t0_s"].is_number() || !json.contains("step_s") || !json["step_s"].is_number()) {
            return fail(ErrorCode::ParseError, "the time stamps of a chunk read '{}'", text);
        }
        head.line = StampLine{json["t0_s"].get<double>(), json["step_s"].get<double>()};
    }
    return head;
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
