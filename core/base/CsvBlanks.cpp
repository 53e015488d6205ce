#include "core/base/CsvBlanks.h"

#include <algorithm>
#include <optional>

#include "core/base/Csv.h"
#include "core/base/CsvHead.h"
#include "core/base/Text.h"

namespace tacto {

namespace {

constexpr std::string_view kBlank = " \t\r";

/// Cut where `isBetween` says that the blanks from one place to another divide two fields.
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
        // Blanks beside a tab: the tab is one of them.
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
