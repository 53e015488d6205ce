#include "drivers/sigrok/ZipDirectory.h"

#include <algorithm>
#include <zlib.h>

namespace tacto::sigrok_driver {

namespace {

constexpr std::size_t kEndBytes = 22;      // the end record without its comment, which has at most 65535
constexpr std::size_t kCentralBytes = 46;  // an entry of the directory without its names
constexpr std::size_t kLocalBytes = 30;    // a local header without its names
constexpr std::uint64_t kMaxByOne = 1032;  // deflate's best

std::uint32_t wordAt(std::string_view bytes, std::size_t at, std::size_t count) {
    std::uint32_t value = 0;
    for (std::size_t i = count; i > 0; --i) value = value << 8U | static_cast<unsigned char>(bytes[at + i - 1]);
    return value;
}

template <class... Args>
tl::unexpected<Error> broken(const ByteFile& file, fmt::format_string<Args...> text, Args&&... args) {
    return fail(ErrorCode::ParseError, "{}: {}; a complete .sr archive was expected", file.name(),
                fmt::format(text, std::forward<Args>(args)...));
}

Result<std::string> bytesAt(ByteFile& file, std::uint64_t at, std::size_t count) {
    if (at > file.size() || count > file.size() - at) return broken(file, "it ends before byte {}", at + count);
    if (auto placed = file.seek(at); !placed) return failure(placed);
    std::string bytes(count, '\0');
    const auto got = file.read(bytes.data(), count);
    if (!got) return failure(got);
    if (*got < count) return broken(file, "it ends before byte {}", at + count);
    return bytes;
}

}  // namespace

Result<std::vector<ZipEntry>> zipDirectory(ByteFile& file) {
    const auto tailBytes = static_cast<std::size_t>(std::min<std::uint64_t>(file.size(), kEndBytes + 65535));
    const auto tail = bytesAt(file, file.size() - tailBytes, tailBytes);
    if (!tail) return failure(tail);
    const std::size_t end = tail->rfind("PK\5\6");
    if (end == std::string::npos || tail->size() - end < kEndBytes)
        return broken(file, "it has no directory at its end");
    const std::size_t count = wordAt(*tail, end + 10, 2);
    const std::size_t size = wordAt(*tail, end + 12, 4);
    const std::size_t offset = wordAt(*tail, end + 16, 4);
    if (count == 0xffff || size == 0xffffffff || offset == 0xffffffff) {
        return broken(file, "it is larger than this program reads (Zip64)");
    }
    const auto directory = bytesAt(file, offset, size);
    if (!directory) return failure(directory);
    std::vector<ZipEntry> entries;
    for (std::size_t at = 0; entries.size() < count;) {
        if (directory->size() - at < kCentralBytes || directory->compare(at, 4, "PK\1\2") != 0) {
            return broken(file, "its directory ends after {} of {} entries", entries.size(), count);
        }
        ZipEntry entry;
        entry.method = static_cast<std::uint16_t>(wordAt(*directory, at + 10, 2));
        entry.crc = wordAt(*directory, at + 16, 4);
        entry.compressed = wordAt(*directory, at + 20, 4);
        entry.size = wordAt(*directory, at + 24, 4);
        const std::size_t name = wordAt(*directory, at + 28, 2);
        const std::size_t rest = std::size_t{wordAt(*directory, at + 30, 2)} + wordAt(*directory, at + 32, 2);
        entry.header = wordAt(*directory, at + 42, 4);
        if (directory->size() - at < kCentralBytes + name + rest) return broken(file, "its directory is cut short");
        entry.name = directory->substr(at + kCentralBytes, name);
        at += kCentralBytes + name + rest;
        const std::uint64_t most = entry.method == 0 ? entry.compressed : entry.compressed * kMaxByOne + 64;
        if ((entry.method != 0 && entry.method != 8) || entry.size > most || entry.compressed > file.size()) {
            return broken(file, "its entry {} cannot be unpacked to {} bytes", entry.name, entry.size);
        }
        entries.push_back(std::move(entry));
    }
    return entries;
}

Result<std::string> unpack(ByteFile& file, const ZipEntry& entry, std::size_t most) {
    if (entry.size > most || entry.compressed > most) {
        return broken(file, "its entry {} has {} bytes, at most {} make sense", entry.name, entry.size, most);
    }
    const auto header = bytesAt(file, entry.header, kLocalBytes);
    if (!header) return failure(header);
    if (header->compare(0, 4, "PK\3\4") != 0) return broken(file, "its entry {} is not where it should be", entry.name);
    const std::uint64_t begin = entry.header + kLocalBytes + wordAt(*header, 26, 2) + wordAt(*header, 28, 2);
    auto packed = bytesAt(file, begin, static_cast<std::size_t>(entry.compressed));
    if (!packed) return packed;
    std::string text(static_cast<std::size_t>(entry.size), '\0');
    if (entry.method == 0) {
        text = *packed;
    } else {
        z_stream stream{};
        // NOLINTBEGIN(cppcoreguidelines-pro-type-reinterpret-cast): zlib's bytes are unsigned
        stream.next_in = reinterpret_cast<Bytef*>(packed->data());
        stream.avail_in = static_cast<uInt>(packed->size());
        stream.next_out = reinterpret_cast<Bytef*>(text.data());
        stream.avail_out = static_cast<uInt>(text.size());
        // NOLINTEND(cppcoreguidelines-pro-type-reinterpret-cast)
        const bool whole = ::inflateInit2(&stream, -MAX_WBITS) == Z_OK &&
                           ::inflate(&stream, Z_FINISH) == Z_STREAM_END && stream.avail_out == 0;
        ::inflateEnd(&stream);
        if (!whole) return broken(file, "its entry {} is damaged", entry.name);
    }
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): zlib's bytes are unsigned
    const auto crc = ::crc32(0, reinterpret_cast<const Bytef*>(text.data()), static_cast<uInt>(text.size()));
    if (crc != entry.crc) return broken(file, "its entry {} is damaged", entry.name);
    return text;
}

}  // namespace tacto::sigrok_driver
