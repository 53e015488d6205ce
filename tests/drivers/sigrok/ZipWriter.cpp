#include "tests/drivers/sigrok/ZipWriter.h"

#include <cstdint>
#include <zlib.h>

namespace tacto::test {

namespace {
void put(std::string& into, std::uint64_t value, int bytes) {
    for (int i = 0; i < bytes; ++i) into.push_back(static_cast<char>(value >> (8 * i) & 0xffU));
}

/// Returns the part common to local header and directory, from "version needed" to the extra field's length.
std::string common(const std::pair<std::string, std::string>& entry, std::size_t packed, int level) {
    std::string text;
    put(text, 20, 2);
    put(text, 0, 2);
    put(text, level == 0 ? 0 : 8, 2);  // stored or deflated
    put(text, 0, 4);
    put(text, ::crc32_z(0, reinterpret_cast<const Bytef*>(entry.second.data()), entry.second.size()), 4);
    put(text, packed, 4);
    put(text, entry.second.size(), 4);
    put(text, entry.first.size(), 2);
    put(text, 0, 2);
    return text;
}

std::string deflated(const std::string& bytes, int level) {
    if (level == 0) return bytes;
    std::string packed(::compressBound(static_cast<uLong>(bytes.size())), '\0');
    z_stream stream{};
    ::deflateInit2(&stream, level, Z_DEFLATED, -MAX_WBITS, 8, Z_DEFAULT_STRATEGY);
    stream.next_in = const_cast<Bytef*>(reinterpret_cast<const Bytef*>(bytes.data()));
    stream.avail_in = static_cast<uInt>(bytes.size());
    stream.next_out = reinterpret_cast<Bytef*>(packed.data());
    stream.avail_out = static_cast<uInt>(packed.size());
    ::deflate(&stream, Z_FINISH);
    packed.erase(static_cast<std::size_t>(stream.total_out));
    ::deflateEnd(&stream);
    return packed;
}
}  // namespace

std::string zipOf(const std::vector<std::pair<std::string, std::string>>& entries, int level) {
    std::string archive, directory;
    for (const auto& entry : entries) {
        const auto packed = deflated(entry.second, level);
        directory += "PK\1\2";
        put(directory, 20, 2);
        directory += common(entry, packed.size(), level);
        put(directory, 0, 8);  // comment length, disk number, attributes
        put(directory, 0, 2);
        put(directory, archive.size(), 4);
        directory += entry.first;
        archive += "PK\3\4" + common(entry, packed.size(), level) + entry.first + packed;
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
