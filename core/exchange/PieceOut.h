// PieceOut.h - a new file that is written in pieces of 256 KiB, for formats that append small parts.
//
// Thread-safety: one caller at a time.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>

#include "core/base/WholeFile.h"

namespace tacto {

class PieceOut {
public:
    explicit PieceOut(std::filesystem::path path) : path_(std::move(path)), file_(FileOut::create(path_)) {
        text_.reserve(2 * kPiece);
    }
    /// Writes what was appended. Errors: Io naming the file.
    [[nodiscard]] Result<void> flush() {
        auto written = file_ ? file_->write(text_) : failure(file_);
        text_.clear();
        return namedAs(path_, std::move(written));
    }

protected:
    [[nodiscard]] Result<void> flushIfFull() { return text_.size() >= kPiece ? flush() : Result<void>(); }

    std::string text_;  ///< appended and not yet written

private:
    static constexpr std::size_t kPiece = std::size_t{1} << 18;
    std::filesystem::path path_;
    Result<FileOut> file_;
};

}  // namespace tacto
