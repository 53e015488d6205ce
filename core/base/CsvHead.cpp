#include "core/base/CsvHead.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <optional>
#include <span>

#include "core/base/Csv.h"
#include "core/base/CsvStamp.h"
#include "core/base/LocaleFreeText.h"
#include "core/base/Utf16.h"

namespace tacto {

namespace {

/// Whether every comma is between digits, as a decimal comma is.
bool commasAreDecimal(std::string_view line) {
    const auto isDigit = [&](std::size_t i) { return i < line.size() && line[i] >= '0' && line[i] <= '9'; };
    for (auto at = line.find(','); at != std::string_view::npos; at = line.find(',', at + 1)) {
        if (at == 0 || !isDigit(at - 1) || !isDigit(at + 1)) return false;
    }
    return true;
}

/// Returns the separator of most of the first lines: a title line above the table may contain anything. Semicolons and
/// tabs win over commas, which are then decimal commas.
char separatorOf(const std::vector<std::string_view>& lines) {
    constexpr std::size_t kLooked = 40;
    std::size_t tabs = 0;
    std::size_t semicolons = 0;
    const auto seen = std::min(lines.size(), kLooked);
    for (const auto line : std::span(lines).first(seen)) {
        tabs += line.find('\t') != std::string_view::npos && commasAreDecimal(line) ? 1U : 0U;
        semicolons += line.find(';') != std::string_view::npos ? 1U : 0U;
    }
    const auto whole = std::span(lines).first(seen > 2 ? seen - 1 : seen);  // the last line may be cut off
    if (areApartByBlanks(whole)) return areApartByTabs(whole) ? '\t' : ' ';
    if (2 * tabs > seen) return '\t';
    return 2 * semicolons > seen ? ';' : ',';
}

/// Returns the separator, ignoring lines that begin with `;` (possible comments) if there are other lines.
char separatorWithout(const std::vector<std::string_view>& lines) {
    std::vector<std::string_view> others;
    std::ranges::copy_if(lines, std::back_inserter(others), [](auto line) { return !line.starts_with(';'); });
    return separatorOf(others.empty() ? lines : others);
}

struct Remark {
    std::size_t number;  // of the remark's line
    std::string_view words;
};

bool isRowOfNumbers(const std::vector<std::string>& fields, char point) {
    bool any = false;
    for (const auto& field : fields) {
        if (field.empty()) continue;
        const bool isNumber = fieldNumber(field, point).has_value();
        if (!isNumber && !fieldStamp(field, point)) return false;
        any = any || isNumber;
    }
    return any;
}

/// Whether `line`, which contains text and numbers, is a row like `row`: both have numbers and stamps in the same
/// columns, including the first column.
bool isRowLike(const CsvLine& line, const CsvLine& row, char point) {
    if (line.fields.size() != row.fields.size()) return false;
    const auto isRead = [&](const std::string& field) {
        return !field.empty() && (fieldNumber(field, point) || fieldStamp(field, point));
    };
    bool anyNumber = false;
    for (std::size_t c = 0; c < row.fields.size(); ++c) {
        if (isRead(row.fields[c])) {
            if (!line.fields[c].empty() && !isRead(line.fields[c])) return false;
            anyNumber = anyNumber || fieldNumber(line.fields[c], point).has_value();
        } else if (c == 0) {
            return false;
        }
    }
    return anyNumber && isRead(line.fields.front());
}

}  // namespace

bool isPassedOver(std::string_view line) { return isBlankOrComment(line) || trimmed(line).starts_with('%'); }

std::optional<double> fieldNumber(std::string_view field, char point) {
    const bool negative = field.starts_with('-');
    if (field.ends_with("∞") && field.size() <= std::string_view("-∞").size()) {
        return negative ? -std::numeric_limits<double>::infinity() : std::numeric_limits<double>::infinity();
    }
    double value = 0;
    const char* const end = field.data() + field.size();
    if (field.empty()) return std::nullopt;
    return takeNumber(field.data(), end, point, value) == end ? std::optional(value) : std::nullopt;
}

std::string_view withoutBrackets(std::string_view field) noexcept {
    field = trimmed(field);
    const bool round = field.starts_with('(') && field.ends_with(')'),
               square = field.starts_with('[') && field.ends_with(']');
    return round || square ? trimmed(field.substr(1, field.size() - 2)) : field;
}

CsvHead readCsvHead(std::string_view text, std::size_t skipRows) {
    struct Seen {
        std::size_t number;
        std::size_t offset;
        std::size_t behind;
    };
    std::vector<Seen> seen;
    std::vector<std::string_view> lines;
    std::size_t number = 0;
    std::vector<Remark> remarks;
    for (std::size_t at = 0; at < text.size();) {
        const auto end = std::min(text.find('\n', at), text.size());
        const auto behind = std::min(end + 1, text.size());
        const auto line = text.substr(at, end - at);
        ++number;
        if (number > skipRows) {
            if (!isPassedOver(line)) {
                seen.push_back({number, at, behind});
                lines.push_back(line);
            } else if (const auto words = trimmed(line); !words.empty()) {
                remarks.push_back({number, words});
            }
        }
        at = behind;
    }
    CsvHead head;
    head.separator = separatorWithout(lines);
    if (head.separator != ';') {
        std::size_t kept = 0;
        for (std::size_t i = 0; i < lines.size(); ++i) {
            if (lines[i].starts_with(';')) {
                remarks.push_back({seen[i].number, trimmed(lines[i])});
            } else {
                lines[kept] = lines[i];
                seen[kept++] = seen[i];
            }
        }
        lines.resize(kept);
        seen.resize(kept);
    }
    std::vector<std::string_view> fields;
    const auto lineAt = [&](std::size_t i) {
        cutRow(lines[i], head.separator, fields);
        CsvLine line{seen[i].number, seen[i].offset, seen[i].behind, {}};
        for (const auto field : fields) line.fields.push_back(latin1AsUtf8(field));
        return line;
    };
    const auto firstRow = [&](char point) -> std::optional<std::size_t> {
        for (std::size_t i = 0; i < lines.size(); ++i) {
            if (isRowOfNumbers(lineAt(i).fields, point)) return i;
        }
        return std::nullopt;
    };
    auto row = firstRow('.');
    if (head.separator != ',') {
        // The last line may be cut off in the middle; any earlier line decides.
        const auto withComma = firstRow(',');
        if (withComma && (!row || *withComma < *row)) {
            head.point = ',';
            row = withComma;
        }
        // Whole numbers are the same with either decimal mark; later lines may decide.
        constexpr std::size_t kLooked = 200;
        std::size_t commas = 0;
        std::size_t points = 0;
        for (std::size_t i = row.value_or(lines.size()); i < std::min(lines.size(), row.value_or(0) + kLooked); ++i) {
            for (const auto& field : lineAt(i).fields) {
                const bool hasComma = fieldNumber(field, ',').has_value();
                const bool hasPoint = fieldNumber(field, '.').has_value();
                commas += hasComma && !hasPoint ? 1U : 0U;
                points += hasPoint && !hasComma ? 1U : 0U;
            }
        }
        if (commas > points) head.point = ',';
    }
    if (!row && head.separator != ',' && !lines.empty()) {
        const auto like = lineAt(lines.size() > 1 ? lines.size() - 2 : 0);
        const auto numbers = [&](char point) {
            return std::ranges::count_if(like.fields,
                                         [&](const auto& field) { return fieldNumber(field, point).has_value(); });
        };
        if (numbers(',') > numbers('.')) head.point = ',';
    }
    // Looks for rows with text in one column, before the first row without text, or if all rows are like this.
    constexpr std::size_t kLikeRows = 3;
    const bool allHaveText = !row && lines.size() > kLikeRows;
    if (row || allHaveText) {
        const auto like = lineAt(row.value_or(lines.size() - 2));  // the last line may be cut off
        std::size_t first = row.value_or(lines.size() - 2);
        while (first > 0 && isRowLike(lineAt(first - 1), like, head.point)) --first;
        if (row || first + kLikeRows < lines.size()) row = first;
    }
    for (std::size_t i = 0; i < row.value_or(lines.size()); ++i) head.header.push_back(lineAt(i));
    if (row) head.firstRow = lineAt(*row);
    constexpr std::size_t kBody = 40;
    for (std::size_t i = row.value_or(lines.size()); i < lines.size() && head.body.size() < kBody; ++i) {
        head.body.push_back(lineAt(i));
    }
    if (head.body.size() > 2 && head.body.size() < kBody) head.body.pop_back();  // the last line may be cut off
    for (const auto& line : head.body) {
        const auto& key = line.fields.front();
        if (!key.empty() && !fieldNumber(key, head.point) && !fieldStamp(key, head.point)) head.beside.push_back(line);
    }
    if (row && head.separator == ' ') {
        for (std::size_t i = 0; i < *row; ++i) {
            auto& names = head.header[i].fields;
            names.clear();
            for (const auto name : namesApartByBlanks(lines[i], head.firstRow->fields.size()))
                names.push_back(latin1AsUtf8(name));
        }
    }
    std::ranges::sort(remarks, {}, &Remark::number);
    for (auto [line, words] : remarks) {
        if (row && line > seen[*row].number) break;
        while (!words.empty() && std::string_view("#%;").find(words.front()) != std::string_view::npos)
            words.remove_prefix(1);
        head.remarks.push_back(latin1AsUtf8(trimmed(words)));
    }
    return head;
}

namespace {

constexpr std::string_view kBlank = " \t\r";

/// Cuts a line at those runs of blanks for which `isBetween` says that they separate two fields.
template <class IsBetween>
void cutAt(std::string_view line, std::vector<std::string_view>& fields, IsBetween&& isBetween) {
    fields.clear();
    line = trimmed(line);
    std::size_t begin = 0;
    for (std::size_t at = 0; at < line.size();) {
        if (line[at] == '"') {
            at = std::min(line.find('"', at + 1), line.size() - 1) + 1;
            continue;
        }
        const auto behind = std::min(line.find_first_not_of(kBlank, at), line.size());
        if (behind > at && isBetween(line.substr(at, behind - at), line.substr(behind))) {
            fields.push_back(line.substr(begin, at - begin));
            begin = behind;
        }
        at = std::max(behind, at + 1);
    }
    if (begin < line.size()) fields.push_back(line.substr(begin));
    for (auto& field : fields) {
        if (field.size() >= 2 && field.front() == '"' && field.back() == '"')
            field = trimmed(field.substr(1, field.size() - 2));
    }
}

bool isRowOfTwo(std::string_view line) {
    std::vector<std::string_view> fields;
    cutRow(line, ' ', fields);
    const auto isNumber = [](std::string_view field) { return fieldNumber(field, '.') || fieldNumber(field, ','); };
    return fields.size() >= 2 && std::ranges::all_of(fields, isNumber);
}

}  // namespace

bool areApartByBlanks(std::span<const std::string_view> lines) {
    return 2 * static_cast<std::size_t>(std::ranges::count_if(lines, isRowOfTwo)) > lines.size();
}

bool areApartByTabs(std::span<const std::string_view> lines) {
    std::vector<std::string_view> fields;
    std::vector<bool> filled;
    std::optional<std::size_t> tabs;
    bool tabsAgree = true, widthsAgree = true, wordsHaveTabs = false;
    for (const auto line : lines) {
        if (!isRowOfTwo(line)) {
            wordsHaveTabs = wordsHaveTabs || trimmed(line).find('\t') != std::string_view::npos;
            continue;
        }
        // A tab next to a blank belongs to the blanks and is not a separator.
        if (line.find(" \t") != std::string_view::npos || line.find("\t ") != std::string_view::npos) return false;
        cutLine(line, '\t', fields);
        const auto its = fields.size();
        while (fields.size() > 1 && fields.back().empty()) fields.pop_back();
        tabsAgree = tabsAgree && its == tabs.value_or(its);
        widthsAgree = widthsAgree && (!tabs || fields.size() == filled.size());
        tabs = tabs.value_or(its);
        filled.resize(std::max(filled.size(), fields.size()));
        for (std::size_t i = 0; i < fields.size(); ++i) {
            if (fields[i].find_first_of(kBlank) != std::string_view::npos) return false;
            filled[i] = filled[i] || !fields[i].empty();
        }
    }
    if (filled.size() < 2 || !(tabsAgree || widthsAgree)) return false;
    const auto begin = std::ranges::find(filled, true);
    return (begin == filled.begin() || wordsHaveTabs) && std::find(begin, filled.end(), false) == filled.end();
}

void cutRow(std::string_view line, char separator, std::vector<std::string_view>& fields) {
    if (separator != ' ') return cutLine(line, separator, fields);
    cutAt(line, fields, [](std::string_view, std::string_view) { return true; });
}

std::vector<std::string_view> namesApartByBlanks(std::string_view line, std::size_t width) {
    std::vector<std::string_view> fields;
    const auto isWide = [](std::string_view blanks, std::string_view) {
        return blanks.size() > 1 || blanks.front() == '\t';
    };
    const auto isBeforeAName = [](std::string_view, std::string_view rest) {
        return rest.find_first_of("([/") != 0 && !rest.starts_with("in ");
    };
    const auto isAny = [](std::string_view, std::string_view) { return true; };
    cutAt(line, fields, isAny);
    if (fields.size() != width) cutAt(line, fields, isWide);
    if (fields.size() != width) cutAt(line, fields, isBeforeAName);
    if (fields.size() != width) cutAt(line, fields, isAny);
    return fields;
}

}  // namespace tacto
