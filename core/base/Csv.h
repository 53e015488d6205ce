// Csv.h - tables of text as laboratories really write them, read line by line with the line number kept.
//
// Tolerated: a byte-order mark, CR LF, blank lines, `#` comment lines, blanks around fields, quoted fields,
// trailing separators, and comma, semicolon or tab as separator (found on the first line that is not a comment).
// A decimal comma is not guessed at. What a field means is the caller's business, and so is refusing it; every
// refusal names file and line.
//
// Thread-safety: none; one owner. Fields are views into the text given, which must outlive them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/Result.h"

namespace tacto {

/// Errors: NotFound when it is not there, Io for a folder, a pipe or a device.
[[nodiscard]] Result<void> checkPlainFile(const std::filesystem::path& path);

/// The whole of a file. Errors: NotFound when it is not there, Io when it cannot be read, or is not a plain file,
/// ParseError when it has more than `maxBytes`.
[[nodiscard]] Result<std::string> readTextFile(const std::filesystem::path& path,
                                               std::uintmax_t maxBytes = std::numeric_limits<std::uintmax_t>::max());

/// Whether the line is empty, or holds only a remark behind `#`.
[[nodiscard]] bool isBlankOrComment(std::string_view line);
/// Cuts a line into `fields`, trimmed, a quoted one without its outer quotes. A quoted field may hold separators; it
/// may not span lines, which no table of readings does.
void cutLine(std::string_view line, char separator, std::vector<std::string_view>& fields);

class CsvReader {
public:
    /// Passes over the first `skipRows` lines. A `separator` of '\0' is found on the first line that is then left.
    explicit CsvReader(std::string_view text, std::size_t skipRows = 0, char separator = '\0');

    /// Moves to the next line that holds anything; false at the end.
    [[nodiscard]] bool next();
    /// The current line's fields, trimmed, trailing empty ones kept. A quoted field loses its outer quotes.
    [[nodiscard]] const std::vector<std::string_view>& fields() const noexcept { return fields_; }
    /// 1-based number of the current line in the file.
    [[nodiscard]] std::size_t line() const noexcept { return line_; }
    /// Lines without anything between the one before and the current one; with tabs alone where tabs separate.
    [[nodiscard]] std::size_t blanksBefore() const noexcept { return blanks_; }

private:
    [[nodiscard]] std::optional<std::string_view> takeLine() noexcept;

    std::string_view text_;
    std::size_t position_ = 0;
    std::size_t line_ = 0;
    std::size_t blanks_ = 0;
    char separator_;  // '\0' until the first line decides
    std::vector<std::string_view> fields_;
};

/// The rows of a table whose header names its columns. Every refusal names file and line.
class NamedRows {
public:
    /// `text` and the words must outlive this. `name` is the file's; `columns` says what the header must name ("columns
    /// a and b were expected"), `row` what a row is ("a row per trial").
    NamedRows(std::string_view text, std::string_view name, std::string_view columns, std::string_view row);

    /// The column of the first of `names` that the header has; nothing where it has none of them.
    [[nodiscard]] std::optional<std::size_t> find(std::initializer_list<std::string_view> names);
    /// Errors: ParseError where the header has none of them, or the file is empty.
    [[nodiscard]] Result<std::size_t> column(std::initializer_list<std::string_view> names);

    /// Moves to the next row; false at the end. Errors: ParseError for a row that lacks a column that was found, and
    /// where there is no row at all.
    [[nodiscard]] Result<bool> next();
    [[nodiscard]] std::string_view operator[](std::size_t column) const { return reader_.fields()[column]; }

    template <class... Args>
    [[nodiscard]] tl::unexpected<Error> refuse(fmt::format_string<Args...> text, Args&&... args) const {
        return fail(ErrorCode::ParseError, "{}:{}: {}", name_, reader_.line(),
                    fmt::format(text, std::forward<Args>(args)...));
    }

private:
    CsvReader reader_;
    std::string_view name_, columns_, row_;
    bool empty_;
    std::vector<std::string_view> header_;
    std::size_t needed_ = 0;  ///< fields of a row
    bool any_ = false;
};

}  // namespace tacto
