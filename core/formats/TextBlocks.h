// TextBlocks.h - a text in blocks of whole lines, from a file or from memory; UTF-16 with its mark becomes UTF-8.
//
// Thread-safety: none; one owner. A block is valid until the next one is asked for.
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

/// A file read piece by piece. Not mapped into memory: a stick that is pulled out, or a file cut short by someone else,
/// is an error here and not a signal that ends the program.
class ByteFile {
public:
    /// Errors: NotFound when it is not there, Io when it cannot be read or is not a plain file.
    [[nodiscard]] static Result<ByteFile> open(const std::filesystem::path& path);

    [[nodiscard]] const std::string& name() const noexcept { return name_; }
    [[nodiscard]] std::uint64_t size() const noexcept { return size_; }

    /// The next up to `count` bytes into `into`; fewer only at the end. Errors: Io.
    [[nodiscard]] Result<std::size_t> read(char* into, std::size_t count);
    /// Errors: Io.
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

/// The file's first kHeadBytes (CaptureFormat.h). Errors: as ByteFile.
[[nodiscard]] Result<std::string> readHead(const std::filesystem::path& path);

class TextBlocks {
public:
    /// Bytes of a block, and so of the longest line. What is read stays in the processor's cache until it is parsed.
    static constexpr std::size_t kBlockBytes = 256UL * 1024;

    /// Errors: of ByteFile::open().
    [[nodiscard]] static Result<TextBlocks> ofFile(const std::filesystem::path& path);
    /// `text` must outlive this; `name` stands for the file in messages.
    [[nodiscard]] static TextBlocks ofText(std::string_view text, std::string_view name);

    /// Whole lines, the last one ended by '\n' even where the file's is not; empty at the end. Without the
    /// byte-order mark.
    /// Errors: Io; ParseError for a line longer than a block.
    [[nodiscard]] Result<std::string_view> next();

    /// Starts from the beginning again. Errors: Io.
    [[nodiscard]] Result<void> rewind();

    [[nodiscard]] const std::string& name() const noexcept { return name_; }
    /// How much of the text has been taken, 0 to 1.
    [[nodiscard]] double fraction() const noexcept;
    [[nodiscard]] std::uint64_t size() const noexcept { return file_ ? file_->size() : text_.size(); }

private:
    TextBlocks(std::optional<ByteFile> file, std::string_view text, std::string name);
    /// UTF-8, converted from any encoding of the file; 0 at the end.
    [[nodiscard]] Result<std::size_t> fill(char* into, std::size_t count);
    [[nodiscard]] Result<std::size_t> fillRaw(char* into, std::size_t count);
    [[nodiscard]] Result<std::size_t> fillFromUtf16(char* into, std::size_t count);

    std::optional<ByteFile> file_;
    std::string_view text_;
    std::string name_;
    std::vector<char> buffer_;
    std::size_t held_ = 0;  // bytes in buffer_
    std::size_t used_ = 0;  // how many of them the last block has given away
    std::uint64_t taken_ = 0;
    bool ended_ = false;
    std::optional<Utf16Order> order_;  // byte order of a text in UTF-16
    std::string raw_;                  // bytes that were read and not yet turned into UTF-8
};

}  // namespace tacto
