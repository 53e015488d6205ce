#include "core/base/Csv.h"

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <limits>
#include <system_error>

#include "core/base/Text.h"

namespace tacto {

Result<std::string> readTextFile(const std::filesystem::path& path) {
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (!std::filesystem::exists(status)) return fail(ErrorCode::NotFound, "no file {}", path.string());
    if (std::filesystem::is_directory(status)) {
        return fail(ErrorCode::Io, "{} is a folder; a file was expected", path.string());
    }
    if (!std::filesystem::is_regular_file(status)) {  // a pipe would wait for its other end
        return fail(ErrorCode::Io, "{} is a pipe or a device; a file was expected", path.string());
    }
    std::ifstream stream(path, std::ios::binary);
    if (!stream) return fail(ErrorCode::Io, "{} cannot be opened for reading", path.string());
    std::string text;
    const auto size = std::filesystem::file_size(path, error);
    if (!error) text.reserve(static_cast<std::size_t>(size));
    char buffer[1 << 16];
    while (stream.read(buffer, sizeof buffer) || stream.gcount() > 0) {
        text.append(buffer, static_cast<std::size_t>(stream.gcount()));
    }
    if (stream.bad()) return fail(ErrorCode::Io, "{} could not be read to its end", path.string());
    return text;
}

bool isBlankOrComment(std::string_view line) {
    const auto content = trimmed(line);
    return content.empty() || content.front() == '#';
}

void cutLine(std::string_view line, char separator, std::vector<std::string_view>& fields) {
    fields.clear();
    std::size_t begin = 0;
    for (;;) {
        std::size_t search = begin;
        const auto first = line.find_first_not_of(" \t", begin);
        const bool quoted = first != std::string_view::npos && line[first] == '"';
        if (quoted) {
            const auto closing = line.find('"', first + 1);
            search = closing == std::string_view::npos ? line.size() : closing + 1;
        }
        const auto end = std::min(line.find(separator, search), line.size());
        auto field = trimmed(line.substr(begin, end - begin));
        if (quoted && field.size() >= 2 && field.back() == '"') field = trimmed(field.substr(1, field.size() - 2));
        fields.push_back(field);
        if (end >= line.size()) return;
        begin = end + 1;
    }
}

namespace {

char separatorOf(std::string_view line) {
    if (line.find('\t') != std::string_view::npos && line.find(',') == std::string_view::npos) return '\t';
    const auto semicolons = std::count(line.begin(), line.end(), ';');
    const auto commas = std::count(line.begin(), line.end(), ',');
    return semicolons > commas ? ';' : ',';
}

}  // namespace

CsvReader::CsvReader(std::string_view text) : text_(text) {
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
    if (text_.starts_with(kByteOrderMark)) text_.remove_prefix(kByteOrderMark.size());
}

std::optional<std::string_view> CsvReader::takeLine() noexcept {
    if (position_ >= text_.size()) return std::nullopt;
    const auto end = std::min(text_.find('\n', position_), text_.size());
    auto line = text_.substr(position_, end - position_);
    if (line.ends_with('\r')) line.remove_suffix(1);
    position_ = end + 1;
    return line;
}

bool CsvReader::next() {
    while (const auto line = takeLine()) {
        ++line_;
        if (isBlankOrComment(*line)) continue;
        if (separator_ == '\0') separator_ = separatorOf(*line);
        cutLine(*line, separator_, fields_);
        return true;
    }
    return false;
}

namespace {

/// Fields beyond `count` may only be the empty ones that trailing separators leave.
bool onlyEmptyBeyond(const std::vector<std::string_view>& fields, std::size_t count) {
    return std::all_of(fields.begin() + static_cast<std::ptrdiff_t>(count), fields.end(),
                       [](std::string_view field) { return field.empty(); });
}

Result<std::vector<std::string>> headerOf(const std::vector<std::string_view>& fields, std::string_view name,
                                          std::size_t line) {
    std::vector<std::string> names(fields.begin(), fields.end());
    while (!names.empty() && names.back().empty()) names.pop_back();
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (names[i].empty()) {
            return fail(ErrorCode::ParseError,
                        "{}:{}: column {} has no name; a header line naming every column was expected", name, line,
                        i + 1);
        }
        if (std::find(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(i), names[i]) !=
            names.begin() + static_cast<std::ptrdiff_t>(i)) {
            return fail(ErrorCode::ParseError, "{}:{}: column '{}' appears twice; names must differ", name, line,
                        names[i]);
        }
    }
    if (names.empty() || parseNumber(names.front())) {
        return fail(ErrorCode::ParseError, "{}:{}: a header line naming the columns was expected before the numbers",
                    name, line);
    }
    return names;
}

}  // namespace

Result<NumericCsv> parseNumericCsv(std::string_view text, std::string_view name) {
    CsvReader reader(text);
    if (!reader.next()) {
        return fail(ErrorCode::ParseError, "{}: the file is empty; a header line and rows of numbers were expected",
                    name);
    }
    auto names = headerOf(reader.fields(), name, reader.line());
    if (!names) return failure(names);
    NumericCsv table;
    table.names = std::move(*names);
    table.headerLine = reader.line();
    const std::size_t width = table.names.size();
    table.columns.resize(width);

    while (reader.next()) {
        const auto& fields = reader.fields();
        if (fields.size() < width || !onlyEmptyBeyond(fields, width)) {
            return fail(ErrorCode::ParseError, "{}:{}: {} fields; {} were expected, as in the header", name,
                        reader.line(), fields.size(), width);
        }
        for (std::size_t i = 0; i < width; ++i) {
            double value = std::numeric_limits<double>::quiet_NaN();
            if (i < fields.size() && !fields[i].empty()) {
                const auto number = parseNumber(fields[i]);
                if (!number) {
                    return fail(ErrorCode::ParseError, "{}:{}: '{}' in column '{}'; a number was expected", name,
                                reader.line(), fields[i].substr(0, 40), table.names[i]);
                }
                value = *number;
            }
            table.columns[i].push_back(value);
        }
        table.lines.push_back(reader.line());
    }
    if (table.rows() == 0) {
        return fail(ErrorCode::ParseError, "{}: nothing after the header line; rows of numbers were expected", name);
    }
    return table;
}

}  // namespace tacto
