// TsvOut.h - a table of a BIDS dataset, written row by row: tab-separated, UTF-8, LF, n/a for what is absent, plain or
// gzipped. Numbers are the shortest decimals that read back exactly. A text that begins with a quote is quoted as in
// CSV, and its control characters are escapes, so that a cell stays one cell.
//
// Thread-safety: one caller at a time.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "core/exchange/ExportSource.h"
#include "core/exchange/PieceOut.h"

namespace tacto {

class TsvOut : public PieceOut {
public:
    enum class Packing { Plain, Gzip };
    explicit TsvOut(const std::filesystem::path& path, Packing packing = Packing::Plain);

    void number(double value);
    void text(std::string_view value);
    void cell(const ExportCell& value);
    /// Errors: Io naming the file.
    [[nodiscard]] Result<void> endRow();
    /// Writes what is left; nothing may follow.
    [[nodiscard]] Result<void> end();

private:
    void separate();
    void pack(bool last);

    struct Packer;
    std::unique_ptr<Packer, void (*)(Packer*)> packer_;  ///< null: plain
    std::string rows_;                                   ///< not packed yet
    bool begun_ = false;
};

}  // namespace tacto
