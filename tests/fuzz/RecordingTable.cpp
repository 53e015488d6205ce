// Any text as a recording's CSV: read or refused with a message, never a crash.
#include "core/acquisition/RecordingTable.h"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "tests/fuzz/FuzzTarget.h"

namespace tacto::fuzz::RecordingTable {

TACTO_FUZZ(RecordingTable, const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    const auto table = tacto::readTable(text, "fuzz.csv", {"time", 1000, {"a", "b"}, 9.80665});
    if (!table && table.error().message.find("fuzz.csv:") != 0) std::abort();
    if (table && table->values.size() != 2 * table->samples()) std::abort();
    return 0;
}

}  // namespace tacto::fuzz::RecordingTable
