#include "core/exchange/bids/TsvOut.h"

#include <charconv>
#include <cmath>
#include <new>
#include <zlib.h>

#include "core/base/Printable.h"

namespace tacto {

namespace {
constexpr std::size_t kPacked = std::size_t{1} << 16;  // bytes that are packed at once
}

struct TsvOut::Packer {
    Packer() {
        constexpr int kLevel = 4, kGzip = 15 + 16, kMemory = 8;
        // The header that zlib makes by itself has the date 0 and no name.
        if (deflateInit2(&stream, kLevel, Z_DEFLATED, kGzip, kMemory, Z_DEFAULT_STRATEGY) != Z_OK)
            throw std::bad_alloc();
    }
    Packer(const Packer&) = delete;
    Packer& operator=(const Packer&) = delete;
    ~Packer() { deflateEnd(&stream); }

    z_stream stream{};
};

TsvOut::TsvOut(const std::filesystem::path& path, Packing packing)
    : PieceOut(path), packer_(packing == Packing::Gzip ? new Packer : nullptr, [](Packer* packer) { delete packer; }) {}

void TsvOut::separate() {
    if (begun_) rows_ += '\t';
    begun_ = true;
}

void TsvOut::number(double value) {
    separate();
    if (std::isnan(value)) {
        rows_ += "n/a";
        return;
    }
    char digits[32];
    rows_.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}

void TsvOut::text(std::string_view value) {
    separate();
    if (value.empty()) {
        rows_ += "n/a";
        return;
    }
    const auto shown = printable(value);
    if (shown.front() != '"') {
        rows_ += shown;
        return;
    }
    rows_ += '"';
    for (const char c : shown) {
        if (c == '"') rows_ += '"';
        rows_ += c;
    }
    rows_ += '"';
}

void TsvOut::pack(bool last) {
    if (packer_ == nullptr) {
        text_ += rows_;
    } else {
        auto& stream = packer_->stream;
        stream.next_in = reinterpret_cast<Bytef*>(rows_.data());
        stream.avail_in = static_cast<uInt>(rows_.size());
        do {
            char piece[1 << 14];
            stream.next_out = reinterpret_cast<Bytef*>(piece);
            stream.avail_out = sizeof piece;
            deflate(&stream, last ? Z_FINISH : Z_NO_FLUSH);
            text_.append(piece, sizeof piece - stream.avail_out);
        } while (stream.avail_out == 0);
    }
    rows_.clear();
}

void TsvOut::cell(const ExportCell& value) {
    if (const auto* number = std::get_if<double>(&value))
        this->number(*number);
    else
        text(std::get<std::string>(value));
}

Result<void> TsvOut::endRow() {
    rows_ += '\n';
    begun_ = false;
    if (rows_.size() < kPacked) return {};
    pack(false);
    return flushIfFull();
}

Result<void> TsvOut::end() {
    pack(true);
    return flush();
}

}  // namespace tacto
