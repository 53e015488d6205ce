// TextBlocks.h - delivers a text in blocks of whole lines, from a file or memory; UTF-16 with a BOM becomes UTF-8.
//
// Thread-safety: none; one owner. A block is valid until the next one is requested.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/Result.h"
#include "core/base/Utf16.h"

namespace tacto {

/// Reads a file piece by piece. The file is not mapped into memory: removing its drive or truncating it then gives an
/// error, not a signal that ends the program.
class ByteFile {
public:
    /// Errors: NotFound if the file does not exist, Io if it cannot be read or is not a plain file.
    [[nodiscard]] static Result<ByteFile> open(const std::filesystem::path& path);

    [[nodiscard]] const std::string& name() const noexcept { return name_; }
    [[nodiscard]] std::uint64_t size() const noexcept { return size_; }

    /// Reads up to `count` bytes into `into`; fewer only at the end of the file. Errors: Io.
    [[nodiscard]] Result<std::size_t> read(char* into, std::size_t count);
    /// Moves to `position` in bytes. Errors: Io.
    [[nodiscard]] Result<void> seek(std::uint64_t position);

private:
    struct Close {
        void operator()(std::FILE* file) const noexcept { std::fclose(file); }
    };
    ByteFile(std::unique_ptr<std::FILE, Close> file, std::string name, std::uint64_t size);

    std::unique_ptr<std::FILE, Close> file_;
    std::string name_;
    std::uint64_t size_;
};

/// Returns the file's first kHeadBytes (CaptureFormat.h). Errors: as ByteFile.
[[nodiscard]] Result<std::string> readHead(const std::filesystem::path& path);

class TextBlocks {
public:
    /// Bytes of a block, and the limit for a line. A block stays in the processor's cache until it is parsed.
    static constexpr std::size_t kBlockBytes = 256UL * 1024;

    /// Errors: those of ByteFile::open().
    [[nodiscard]] static Result<TextBlocks> ofFile(const std::filesystem::path& path);
    /// `text` must outlive this object; messages use `name` in place of a file name.
    [[nodiscard]] static TextBlocks ofText(std::string_view text, std::string_view name);

    /// Returns the next whole lines, or an empty text at the end. Removes the byte-order mark, and adds '\n' to the
    /// last line if it is missing. Errors: Io; ParseError for a line longer than a block.
    [[nodiscard]] Result<std::string_view> next();

    /// Returns to the beginning. Errors: Io.
    [[nodiscard]] Result<void> rewind();

    [[nodiscard]] const std::string& name() const noexcept { return name_; }
    /// Returns the share of the text that was delivered, 0 to 1.
    [[nodiscard]] double fraction() const noexcept;
    [[nodiscard]] std::uint64_t size() const noexcept { return file_ ? file_->size() : text_.size(); }

private:
    TextBlocks(std::optional<ByteFile> file, std::string_view text, std::string name);
    /// Fills `into` with UTF-8, converted from the file's encoding. Returns 0 at the end.
    [[nodiscard]] Result<std::size_t> fill(char* into, std::size_t count);
    [[nodiscard]] Result<std::size_t> fillRaw(char* into, std::size_t count);
    [[nodiscard]] Result<std::size_t> fillFromUtf16(char* into, std::size_t count);

    std::optional<ByteFile> file_;
    std::string_view text_;
    std::string name_;
    std::vector<char> buffer_;
    std::size_t held_ = 0;  // number of bytes in buffer_
    std::size_t used_ = 0;  // bytes of buffer_ that were delivered with the last block
    std::uint64_t taken_ = 0;
    bool ended_ = false;
    std::optional<Utf16Order> order_;  // byte order of UTF-16 text
    std::string raw_;                  // bytes read but not yet converted to UTF-8
};

}  // namespace tacto
