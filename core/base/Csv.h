// Csv.h - reads tables of text as laboratories really write them, line by line with line numbers.
//
// Accepts a byte-order mark, CR LF, blank lines, `#` comment lines, blanks around fields, quoted fields, trailing
// separators, and comma, semicolon or tab as separator (taken from the first line that is not a comment). Does not
// guess at decimal commas. The caller interprets the fields and refuses unsuitable ones; every refusal names file and
// line.
//
// Thread-safety: none; one owner. Fields are views into the given text, which must outlive them.
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

/// Checks that a plain file exists. Errors: NotFound; Io for a folder, a pipe or a device.
[[nodiscard]] Result<void> checkPlainFile(const std::filesystem::path& path);

/// Reads a whole file. Errors: NotFound if it does not exist, Io if it is not a plain file or cannot be read,
/// ParseError if it has more than `maxBytes`.
[[nodiscard]] Result<std::string> readTextFile(const std::filesystem::path& path,
                                               std::uintmax_t maxBytes = std::numeric_limits<std::uintmax_t>::max());

/// Whether the line is empty or contains only a `#` comment.
[[nodiscard]] bool isBlankOrComment(std::string_view line);
/// Cuts a line into trimmed `fields`, and removes outer quotes. A quoted field may contain separators, but not line
/// ends, which tables of readings never contain.
void cutLine(std::string_view line, char separator, std::vector<std::string_view>& fields);

class CsvReader {
public:
    /// Skips the first `skipRows` lines. If `separator` is '\0', the first line after them decides.
    explicit CsvReader(std::string_view text, std::size_t skipRows = 0, char separator = '\0');

    /// Moves to the next line that is not blank; returns false at the end.
    [[nodiscard]] bool next();
    /// The current line's fields, trimmed and without outer quotes; empty fields at the end are kept.
    [[nodiscard]] const std::vector<std::string_view>& fields() const noexcept { return fields_; }
    /// Number of the current line in the file, from 1.
    [[nodiscard]] std::size_t line() const noexcept { return line_; }
    /// Number of empty lines directly before the current line; with tabs as separator, lines of tabs count as empty.
    [[nodiscard]] std::size_t blanksBefore() const noexcept { return blanks_; }

private:
    [[nodiscard]] std::optional<std::string_view> takeLine() noexcept;

    std::string_view text_;
    std::size_t position_ = 0;
    std::size_t line_ = 0;
    std::size_t blanks_ = 0;
    char separator_;  // '\0' until the first line decides the separator
    std::vector<std::string_view> fields_;
};

/// The rows of a table with column names in its header. Every refusal names file and line.
class NamedRows {
public:
    /// `text` and the words must outlive this object. `name`: of the file. For messages: `columns`, what the header
    /// must contain ("columns a and b were expected"), and `row`, what a row is ("a row per trial").
    NamedRows(std::string_view text, std::string_view name, std::string_view columns, std::string_view row);

    /// Returns the column of the first of `names` that is in the header, or nothing.
    [[nodiscard]] std::optional<std::size_t> find(std::initializer_list<std::string_view> names);
    /// As find(). Errors: ParseError if none of `names` is in the header, or the file is empty.
    [[nodiscard]] Result<std::size_t> column(std::initializer_list<std::string_view> names);

    /// Moves to the next row; returns false at the end. Errors: ParseError for a row without a column that was found,
    /// and if the table has no rows.
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
    std::size_t needed_ = 0;  ///< number of fields that a row must have
    bool any_ = false;
};

}  // namespace tacto
