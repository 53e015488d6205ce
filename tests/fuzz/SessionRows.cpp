// Any row of a session file about samples, and the samples themselves, are read or refused, whatever the bytes (hazard
// H10). SessionFuzz reads whole files, at the speed of SQLite; this target tests only Tactoscope's own decoding. The
// input: one byte for the kind of row; one byte for the share of the row's JSON in the rest (in 1/256); then the JSON
// and the row's data.
#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <string_view>

#include "core/base/JsonText.h"
#include "core/session/Chunk.h"
#include "core/session/SessionTypes.h"
#include "tests/fuzz/FuzzTarget.h"

namespace tacto::fuzz::SessionRows {

namespace {

using namespace tacto;
using Data = std::span<const std::byte>;

void chunk(std::string_view text, Data data) {
    const auto head = parseChunkHead(text);
    if (!head) {
        require(head.error().code == ErrorCode::ParseError);
        return;
    }
    const auto again = parseChunkHead(toJsonText(*head));
    require(again && again->samples == head->samples && again->crc == head->crc && again->packing == head->packing);
    SampleBlock block;
    for (const std::size_t columns : {1U, 3U}) {
        const auto stamps = head->line ? std::size_t{0} : data.size() / (columns + 1) / 8 * 8;
        if (!unpackChunk(*head, columns, data.first(stamps), data.subspan(stamps), block)) continue;
        require(block.samples() == head->samples && block.values.size() == columns * head->samples);
    }
}

void capture(std::string_view text, Data data) {
    const auto json = nlohmann::json::parse(text, nullptr, false);
    if (json.is_discarded()) return;
    const auto read = unpackCapture(json, data);
    if (!read) {
        require(read.error().code == ErrorCode::ParseError && !read.error().message.empty());
        return;
    }
    for (const auto& channel : read->channels) require(channel.samples.size() == read->samples());
    if (read->channels.empty()) return;
    const auto packed = packSamples(*read);
    const auto again = unpackCapture(describePacked(*read, packed), packed.data);
    require(again && again->samples() == read->samples() && again->channels.size() == read->channels.size());
}

void about(std::string_view text) {
    const auto json = nlohmann::json::parse(text, nullptr, false);
    if (json.is_discarded()) return;
    require(dumpJson(json).find('\n') == std::string::npos);
    // Compared as text, because NaN is null there and so equals itself.
    const auto once = reproducible(aboutFrom(json));
    require(dumpJson(reproducible(aboutFrom(toJson(aboutFrom(json))))) == dumpJson(once));
    const auto stream = toJson(streamFrom(json));
    require(dumpJson(toJson(streamFrom(stream))) == dumpJson(stream));
}

}  // namespace

TACTO_FUZZ(SessionRows, const std::uint8_t* data, std::size_t size) {
    if (size < 2) return 0;
    const std::span<const std::uint8_t> rest(data + 2, size - 2);
    const auto cut = (rest.size() * (std::size_t{data[1]} + 1) + 255) / 256;
    const std::string_view text(reinterpret_cast<const char*>(rest.data()), cut);
    if (data[0] % 3 == 0) chunk(text, std::as_bytes(rest.subspan(cut)));
    if (data[0] % 3 == 1) capture(text, std::as_bytes(rest.subspan(cut)));
    if (data[0] % 3 == 2) about(text);
    return 0;
}

}  // namespace tacto::fuzz::SessionRows
