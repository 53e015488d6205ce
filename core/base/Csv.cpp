#include "core/base/Csv.h"

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <system_error>

#include "core/base/CsvHead.h"
#include "core/base/LocaleFreeText.h"

namespace tacto {

Result<void> checkPlainFile(const std::filesystem::path& path) {
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (!std::filesystem::exists(status)) return fail(ErrorCode::NotFound, "no file {}", path.string());
    if (std::filesystem::is_directory(status)) {
        return fail(ErrorCode::Io, "{} is a folder; a file was expected", path.string());
    }
    if (!std::filesystem::is_regular_file(status)) {  // opening a pipe would wait for its other end
        return fail(ErrorCode::Io, "{} is a pipe or a device; a file was expected", path.string());
    }
    return {};
}

Result<std::string> readTextFile(const std::filesystem::path& path, std::uintmax_t maxBytes) {
    const auto tooLarge = [&] {
        return fail(ErrorCode::ParseError, "{} is too large; at most {} bytes were expected", path.string(), maxBytes);
    };
    if (auto plain = checkPlainFile(path); !plain) return failure(plain);
    std::ifstream stream(path, std::ios::binary);
    if (!stream) return fail(ErrorCode::Io, "{} cannot be opened for reading", path.string());
    std::string text;
    std::error_code error;
    const auto size = std::filesystem::file_size(path, error);
    if (!error && size > maxBytes) return tooLarge();
    if (!error) text.reserve(static_cast<std::size_t>(size));
    char buffer[1 << 16];
    while (stream.read(buffer, sizeof buffer) || stream.gcount() > 0) {
        text.append(buffer, static_cast<std::size_t>(stream.gcount()));
        if (text.size() > maxBytes) return tooLarge();
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
        const auto first = line.find_first_not_of(separator == '\t' ? " " : " \t", begin);
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

CsvReader::CsvReader(std::string_view text, std::size_t skipRows, char separator) : text_(text), separator_(separator) {
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
    if (text_.starts_with(kByteOrderMark)) text_.remove_prefix(kByteOrderMark.size());
    while (line_ < skipRows && takeLine()) ++line_;
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
    blanks_ = 0;
    while (const auto line = takeLine()) {
        ++line_;
        const bool tabs = separator_ == '\t';
        blanks_ += trimmed(*line).empty() && (!tabs || line->find('\t') != std::string_view::npos) ? 1 : 0;
        if (isBlankOrComment(*line)) continue;
        if (separator_ == '\0') separator_ = separatorOf(*line);
        cutRow(*line, separator_, fields_);
        return true;
    }
    return false;
}

NamedRows::NamedRows(std::string_view text, std::string_view name, std::string_view columns, std::string_view row)
    : reader_(text), name_(name), columns_(columns), row_(row), empty_(!reader_.next()), header_(reader_.fields()) {}

std::optional<std::size_t> NamedRows::find(std::initializer_list<std::string_view> names) {
    const auto found = std::find_first_of(names.begin(), names.end(), header_.begin(), header_.end());
    if (found == names.end()) return std::nullopt;
    const auto column = static_cast<std::size_t>(std::ranges::find(header_, *found) - header_.begin());
    needed_ = std::max(needed_, column + 1);
    return column;
}

Result<std::size_t> NamedRows::column(std::initializer_list<std::string_view> names) {
    if (empty_) return fail(ErrorCode::ParseError, "{}: the file is empty; {}", name_, columns_);
    if (const auto found = find(names)) return *found;
    return refuse("no column '{}'; {}", *names.begin(), columns_);
}

Result<bool> NamedRows::next() {
    if (!reader_.next()) {
        if (any_) return false;
        return fail(ErrorCode::ParseError, "{}: nothing after the header line; {} was expected", name_, row_);
    }
    any_ = true;
    const auto fields = reader_.fields().size();
    if (fields >= needed_) return true;
    return refuse("{} fields; at least {} were expected, as in the header", fields, needed_);
}

}  // namespace tacto
