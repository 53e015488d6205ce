#include "core/exchange/xdf/Gunzip.h"

#include <algorithm>
#include <array>
#include <limits>
#include <zlib.h>

namespace tacto {

namespace {

constexpr std::string_view kGzip("\x1f\x8b\x08", 3);
constexpr int kGzipWindow = 15 + 16;  // the largest window, and gzip's head and checksum
constexpr std::size_t kPiece = std::size_t{1} << 16;

/// One member after another.
class Members {
public:
    explicit Members(std::string_view packed) : left_(packed) { open_ = inflateInit2(&stream_, kGzipWindow) == Z_OK; }
    ~Members() {
        if (open_) inflateEnd(&stream_);
    }
    Members(const Members&) = delete;
    Members& operator=(const Members&) = delete;

    /// Unpacks into `piece`; returns how many bytes. 0: the end, see cut().
    [[nodiscard]] Result<std::size_t> next(std::array<char, kPiece>& piece) {
        if (!open_) return fail(ErrorCode::Io, "cannot be unpacked: there is no memory");
        stream_.next_out = reinterpret_cast<Bytef*>(piece.data());
        stream_.avail_out = static_cast<uInt>(piece.size());
        while (stream_.avail_out > 0 && !ended_) {
            if (stream_.avail_in == 0) feed();
            const auto state = inflate(&stream_, Z_NO_FLUSH);
            if (state == Z_STREAM_END) {
                beginNext();
            } else if (state == Z_BUF_ERROR && stream_.avail_in == 0 && left_.empty()) {
                cut_ = ended_ = true;
            } else if (state != Z_OK && state != Z_BUF_ERROR) {
                return fail(ErrorCode::ParseError, "is damaged: its gzip data at byte {} cannot be unpacked ({})",
                            taken_ - stream_.avail_in, stream_.msg != nullptr ? stream_.msg : "zlib");
            }
        }
        if (stray_) return fail(ErrorCode::ParseError, "goes on behind its gzip data with something else");
        return piece.size() - stream_.avail_out;
    }
    [[nodiscard]] bool cut() const noexcept { return cut_; }

private:
    void feed() {
        const auto size = std::min<std::size_t>(left_.size(), std::numeric_limits<uInt>::max());
        stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(left_.data()));  // zlib does not write there
        stream_.avail_in = static_cast<uInt>(size);
        left_.remove_prefix(size);
        taken_ += size;
    }
    /// Zeros behind a member are padding, as tapes have it.
    void beginNext() {
        for (;;) {
            if (stream_.avail_in == 0) feed();
            if (stream_.avail_in == 0) {
                ended_ = true;
                return;
            }
            if (*stream_.next_in != 0) break;
            ++stream_.next_in;
            --stream_.avail_in;
        }
        stray_ = ended_ = *stream_.next_in != static_cast<unsigned char>(kGzip.front());
        if (!ended_) inflateReset(&stream_);
    }

    std::string_view left_;
    z_stream stream_ = {};
    std::uint64_t taken_ = 0;
    bool open_ = false, ended_ = false, cut_ = false, stray_ = false;
};

}  // namespace

bool isGzip(std::string_view content) noexcept { return content.starts_with(kGzip); }

bool gzipHolds(std::string_view head, std::string_view wanted) noexcept {
    if (!isGzip(head)) return false;
    z_stream stream = {};
    if (inflateInit2(&stream, kGzipWindow) != Z_OK) return false;
    std::array<char, 64> begin{};
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(head.data()));
    stream.avail_in = static_cast<uInt>(std::min<std::size_t>(head.size(), kPiece));
    stream.next_out = reinterpret_cast<Bytef*>(begin.data());
    stream.avail_out = static_cast<uInt>(begin.size());
    static_cast<void>(inflate(&stream, Z_SYNC_FLUSH));
    const std::string_view unpacked(begin.data(), begin.size() - stream.avail_out);
    inflateEnd(&stream);
    return unpacked.starts_with(wanted);
}

Result<Unpacked> gunzip(std::string_view packed, std::uint64_t most) {
    std::array<char, kPiece> piece;
    std::uint64_t size = 0;
    Unpacked made;
    for (Members counted(packed);;) {
        const auto got = counted.next(piece);
        if (!got) return failure(got);
        size += *got;
        if (size > most)
            return fail(ErrorCode::LimitExceeded,
                        "holds more than {} bytes unpacked; at most that is unpacked here: unpack it with gunzip if "
                        "you trust it",
                        most);
        if (*got < piece.size()) break;
    }
    made.content.reserve(static_cast<std::size_t>(size));
    for (Members members(packed);;) {
        const auto got = members.next(piece);
        if (!got) return failure(got);
        made.content.append(piece.data(), *got);
        made.cut = members.cut();
        if (*got < piece.size()) break;
    }
    return made;
}

}  // namespace tacto
