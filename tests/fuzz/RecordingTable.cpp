// Any text as a recording's table is read or refused with a message, never a crash; so is any JSON that describes it.
#include "core/acquisition/RecordingTable.h"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "core/acquisition/RecordingDraft.h"
#include "core/base/JsonText.h"
#include "tests/fuzz/FuzzTarget.h"
#include "tests/fuzz/InputFile.h"

namespace tacto::fuzz::RecordingTable {

TACTO_FUZZ(RecordingTable, const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    const tacto::TableLayout layouts[] = {
        {.timeColumn = "time", .timeDivisor = 1000, .columns = {"a", "b"}, .valueFactor = 9.80665},
        {.timeColumn = std::size_t{1}, .columns = {std::size_t{2}, "b"}, .skipRows = 1},
        {.columns = {std::size_t{1}, std::size_t{2}}, .rate_hz = 1000, .decimal = ','}};
    for (const auto& layout : layouts) {
        const auto table = tacto::readTable(text, "fuzz.csv", layout);
        if (!table && table.error().message.find("fuzz.csv:") != 0) std::abort();
        if (table && table->values.size() != 2 * table->samples()) std::abort();
    }
    const auto draft = tacto::draftRecording(inputFile("fuzz.csv", {data, size}));
    if (draft ? draft->json.empty() : draft.error().message.empty()) std::abort();
    if (draft && !tacto::parseJson(draft->json, "draft")) std::abort();
    return 0;
}

}  // namespace tacto::fuzz::RecordingTable
