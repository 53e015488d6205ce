#include "tests/drivers/sigrok/ZipWriter.h"

#include <cstdint>
#include <zlib.h>

namespace tacto::test {

namespace {
void put(std::string& into, std::uint64_t value, int bytes) {
    for (int i = 0; i < bytes; ++i) into.push_back(static_cast<char>(value >> (8 * i) & 0xffU));
}

/// What the local header and the directory have in common, from "version needed" to the extra field's length.
std::string common(const std::pair<std::string, std::string>& entry) {
    std::string text;
    put(text, 20, 2);
    put(text, 0, 2);
    put(text, 0, 2);  // stored
    put(text, 0, 4);
    put(text, ::crc32_z(0, reinterpret_cast<const Bytef*>(entry.second.data()), entry.second.size()), 4);
    put(text, entry.second.size(), 4);
    put(text, entry.second.size(), 4);
    put(text, entry.first.size(), 2);
    put(text, 0, 2);
    return text;
}
}  // namespace

std::string zipOf(const std::vector<std::pair<std::string, std::string>>& entries) {
    std::string archive, directory;
    for (const auto& entry : entries) {
        directory += "PK\1\2";
        put(directory, 20, 2);
        directory += common(entry);
        put(directory, 0, 8);  // comment, disk, attributes
        put(directory, 0, 2);
        put(directory, archive.size(), 4);
        directory += entry.first;
        archive += "PK\3\4" + common(entry) + entry.first + entry.second;
    }
    const auto offset = archive.size();
    archive += directory + "PK\5\6";
    put(archive, 0, 4);
    put(archive, entries.size(), 2);
    put(archive, entries.size(), 2);
    put(archive, directory.size(), 4);
    put(archive, offset, 4);
    put(archive, 0, 2);
    return archive;
}

}  // namespace tacto::test
