// ZipDirectory.h - what a zip archive says it holds, read from its end: names, sizes and checksums of its entries.
//
// libsigrok reads .sr archives but says neither how much is coming nor whether all of it came. Read here so that memory
// is taken once, progress is known, and a file that was cut short or damaged is refused. Archives of more than 4 GiB
// (Zip64) are not read. Source: PKWARE's APPNOTE.TXT, sections 4.3.7, 4.3.12 and 4.3.16.
//
// Thread-safety: pure functions on files.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/formats/ByteFile.h"

namespace tacto::sigrok_driver {

struct ZipEntry {
    std::string name;
    std::uint16_t method = 0;      ///< 0 stored, 8 deflated
    std::uint64_t compressed = 0;  ///< bytes in the archive
    std::uint64_t size = 0;        ///< bytes once unpacked
    std::uint32_t crc = 0;         ///< CRC-32 of those
    std::uint64_t header = 0;      ///< where its local header begins
};

/// Errors: ParseError for what is no archive, is inconsistent, has entries that are neither stored nor deflated or
/// claim more than deflate can give (1032 bytes from one); Io.
[[nodiscard]] Result<std::vector<ZipEntry>> zipDirectory(ByteFile& file);

/// A small entry, unpacked. Errors: ParseError when it is damaged or larger than `most`; Io.
[[nodiscard]] Result<std::string> unpack(ByteFile& file, const ZipEntry& entry, std::size_t most);

}  // namespace tacto::sigrok_driver
