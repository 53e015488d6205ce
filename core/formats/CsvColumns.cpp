#include "core/formats/CsvColumns.h"

#include <algorithm>

#include "core/base/Text.h"

namespace tacto {

CsvColumn columnNamed(std::string_view text) {
    const auto bracket = text.find_first_of("([");
    if (bracket != std::string_view::npos && bracket > 0 && (text.ends_with(')') || text.ends_with(']'))) {
        const auto spelled = text.substr(bracket + 1, text.size() - bracket - 2);
        std::string name(trimmed(text.substr(0, bracket)));
        if (const auto unit = spelledUnit(spelled)) return {std::move(name), std::string(unit->unit), unit->factor, ""};
        return {std::move(name), "", 1, std::string(spelled)};
    }
    const auto mark = text.rfind('_');
    if (mark != std::string_view::npos && mark > 0 && mark + 1 < text.size()) {
        const auto unit = spelledUnit(text.substr(mark + 1));
        if (unit && !unit->unit.empty()) {
            return {std::string(text.substr(0, mark)), std::string(unit->unit), unit->factor, ""};
        }
    }
    return {std::string(text), "", 1, ""};
}

bool isTimeColumn(const CsvColumn& column) {
    if (column.unit == "s") return true;
    const auto name = folded(column.name);
    return column.unit.empty() && column.unknownUnit.empty() &&
           (name == "time" || name == "t" || name == "seconds" || name == "second");
}

std::optional<SpelledUnit> unitField(std::string_view field) {
    if (field.size() >= 2 && (field.front() == '(' || field.front() == '[')) field = field.substr(1, field.size() - 2);
    return spelledUnit(field);
}

bool isLineOfUnits(const CsvLine& line) {
    bool any = false;
    for (const auto& field : line.fields) {
        const auto unit = unitField(field);
        // "a" and "s" name channels as well as units: a line of units has the one of time in it.
        if (!unit) return false;
        any = any || unit->unit == "s";
    }
    return any;
}

const CsvLine* lineCalled(const CsvHead& head, std::string_view key) {
    const auto found = std::ranges::find_if(head.header, [&](const CsvLine& line) {
        auto name = folded(line.fields.front());
        if (name.ends_with(':')) name.pop_back();
        return name == folded(key);
    });
    return found == head.header.end() ? nullptr : &*found;
}

std::optional<double> numberCalled(const CsvHead& head, std::string_view key) {
    const auto* line = lineCalled(head, key);
    if (line == nullptr || line->fields.size() < 2) return std::nullopt;
    std::string_view text = line->fields[1];
    if (const auto colon = text.rfind(':'); colon != std::string_view::npos) text.remove_prefix(colon + 1);
    return parseNumber(text);
}

Result<std::vector<std::string>> namesIn(const CsvLine& line, std::string_view file) {
    std::vector<std::string> names = line.fields;
    while (!names.empty() && names.back().empty()) names.pop_back();
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (names[i].empty()) {
            return fail(ErrorCode::ParseError,
                        "{}:{}: column {} has no name; a header line naming every column was expected", file,
                        line.number, i + 1);
        }
        const auto before = names.begin() + static_cast<std::ptrdiff_t>(i);
        if (std::find(names.begin(), before, names[i]) != before) {
            return fail(ErrorCode::ParseError, "{}:{}: column '{}' appears twice; names must differ", file, line.number,
                        names[i]);
        }
    }
    return names;
}

}  // namespace tacto
