#include "core/session/WalScan.h"

#include <algorithm>
#include <fstream>
#include <span>
#include <vector>

namespace tacto {

namespace {

constexpr std::size_t kHeader = 32;
constexpr std::size_t kFrameHeader = 24;
constexpr std::uint32_t kMagic = 0x377f0682;  // the last bit says that checksums read big-endian words

std::uint32_t word(std::span<const char> bytes, std::size_t at, bool big) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        const auto byte = static_cast<unsigned char>(bytes[at + (big ? i : 3 - i)]);
        value = value << 8 | byte;
    }
    return value;
}

struct Checksum {
    std::uint32_t first = 0;
    std::uint32_t second = 0;
    void add(std::span<const char> bytes, bool big) {
        for (std::size_t i = 0; i + 8 <= bytes.size(); i += 8) {
            first += word(bytes, i, big) + second;
            second += word(bytes, i + 4, big) + first;
        }
    }
    [[nodiscard]] bool matches(std::span<const char> bytes, std::size_t at) const {
        return word(bytes, at, true) == first && word(bytes, at + 4, true) == second;
    }
};

}  // namespace

Result<WalFindings> scanWal(const std::filesystem::path& wal) {
    WalFindings findings;
    std::ifstream file(wal, std::ios::binary);
    if (!file) return fail(ErrorCode::Io, "{} cannot be read", wal.string());
    std::vector<char> header(kHeader);
    if (!file.read(header.data(), kHeader)) return findings;
    const auto magic = word(header, 0, true);
    const std::size_t pageSize = word(header, 8, true);
    if ((magic & ~1U) != kMagic || pageSize < 512 || pageSize > 65'536) {
        findings.headerDamaged = file.peek() != std::char_traits<char>::eof();
        return findings;
    }
    const bool big = (magic & 1U) != 0;
    Checksum sum;
    sum.add(std::span(header).first(24), big);
    bool readable = sum.matches(header, 24);
    findings.headerDamaged = !readable && file.peek() != std::char_traits<char>::eof();

    std::vector<char> frame(kFrameHeader + pageSize);
    bool commitWaits = false;  // a commit behind the bad frame counts once a further transaction follows it
    while (file.read(frame.data(), static_cast<std::streamsize>(frame.size()))) {
        const bool current = std::equal(frame.begin() + 8, frame.begin() + 16, header.begin() + 16);
        if (!current) {  // left over from before the journal was last restarted, or altered
            readable = false;
            continue;
        }
        if (readable) {
            sum.add(std::span<const char>(frame).first(8), big);
            sum.add(std::span<const char>(frame).subspan(kFrameHeader), big);
            readable = sum.matches(frame, 16);
            if (readable) ++findings.readableFrames;
        }
        if (!readable) {
            if (commitWaits) ++findings.lostCommits;
            commitWaits = word(frame, 4, true) != 0;
        }
    }
    return findings;
}

}  // namespace tacto
