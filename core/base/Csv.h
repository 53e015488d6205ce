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
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/Result.h"

namespace tacto {

/// The whole of a file. Errors: NotFound when it is not there, Io when it cannot be read or is not a plain file.
[[nodiscard]] Result<std::string> readTextFile(const std::filesystem::path& path);

/// Nothing in it, or nothing but a remark behind `#`.
[[nodiscard]] bool isBlankOrComment(std::string_view line);
/// Cuts a line into `fields`, trimmed, a quoted one without its outer quotes. A quoted field may hold separators; it
/// may not span lines, which no table of readings does.
void cutLine(std::string_view line, char separator, std::vector<std::string_view>& fields);

class CsvReader {
public:
    explicit CsvReader(std::string_view text);

    /// Moves to the next line that holds anything; false at the end.
    [[nodiscard]] bool next();
    /// The current line's fields, trimmed, trailing empty ones kept. A quoted field loses its outer quotes.
    [[nodiscard]] const std::vector<std::string_view>& fields() const noexcept { return fields_; }
    /// 1-based number of the current line in the file.
    [[nodiscard]] std::size_t line() const noexcept { return line_; }

private:
    [[nodiscard]] std::optional<std::string_view> takeLine() noexcept;

    std::string_view text_;
    std::size_t position_ = 0;
    std::size_t line_ = 0;
    char separator_ = '\0';  // '\0' until the first line decides
    std::vector<std::string_view> fields_;
};

/// A header line and columns of numbers.
struct NumericCsv {
    std::vector<std::string> names;            ///< of the columns, trimmed, never empty
    std::vector<std::vector<double>> columns;  ///< equally long; NaN where the field is empty or says nan
    std::vector<std::size_t> lines;            ///< file line of each row, 1-based
    std::size_t headerLine = 1;
    [[nodiscard]] std::size_t rows() const noexcept { return lines.size(); }
};

/// Reads `text`; `name` (the file's) begins every message.
/// Errors: ParseError naming line and column where a field is no number, a row has too few fields (a file cut short)
/// or too many, the header is missing, has an empty name or one twice, or there is no row at all.
[[nodiscard]] Result<NumericCsv> parseNumericCsv(std::string_view text, std::string_view name);

}  // namespace tacto
