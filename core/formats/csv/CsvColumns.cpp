#include "core/formats/csv/CsvColumns.h"

#include <algorithm>
#include <cmath>

#include "core/base/CsvNumber.h"
#include "core/base/GivenOnce.h"
#include "core/base/Text.h"

namespace tacto {

namespace {

/// `text` with its unit behind `mark`: "C1 in V", "t / s".
std::optional<CsvColumn> withUnitBehind(std::string_view text, std::string_view mark) {
    const auto at = text.rfind(mark);
    if (at == std::string_view::npos) return std::nullopt;
    const auto unit = spelledUnit(text.substr(at + mark.size()));
    if (!unit || unit->unit.empty()) return std::nullopt;
    return CsvColumn{std::string(trimmed(text.substr(0, at))), std::string(unit->unit), unit->factor, ""};
}

bool isDigits(std::string_view text) {
    return !text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos;
}

/// A number and what stands behind it.
std::optional<std::pair<double, std::string_view>> numberAndRest(std::string_view text, char point) {
    text = trimmed(text);
    double value = 0;
    const char* const behind = takeNumber(text.data(), text.data() + text.size(), point, value);
    if (behind == nullptr) return std::nullopt;
    return std::pair(value, trimmed(text.substr(static_cast<std::size_t>(behind - text.data()))));
}

}  // namespace

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
    for (const std::string_view between : {" in ", " / "}) {
        if (auto column = withUnitBehind(text, between)) return *std::move(column);
    }
    if (text.starts_with("in ")) {  // the unit of a column without a name, which is the time
        if (const auto unit = spelledUnit(text.substr(3)); unit && unit->unit == "s") {
            return {"time", "s", unit->factor, ""};
        }
    }
    if (text.size() > 3 && text.starts_with("CH") && isDigits(text.substr(2, text.size() - 3)) &&
        (text.back() == 'V' || text.back() == 'A')) {
        return {std::string(text.substr(0, text.size() - 1)), std::string(1, text.back()), 1, ""};
    }
    return {std::string(text), "", 1, ""};
}

bool isTimeColumn(const CsvColumn& column) {
    if (column.unit == "s") return true;
    const auto name = folded(column.name);
    return column.unit.empty() && column.unknownUnit.empty() &&
           (name == "time" || name == "t" || name == "seconds" || name == "second");
}

bool isIndexColumn(const CsvColumn& column) {
    const auto name = folded(column.name);
    return column.unit.empty() && column.unknownUnit.empty() &&
           (name == "index" || name == "sample" || name == "samples" || name == "sequence" || name == "nr");
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
        if (name.ends_with(':') || name.ends_with('=')) name.pop_back();
        return trimmed(name) == folded(key);
    });
    return found == head.header.end() ? nullptr : &*found;
}

std::string_view wordCalled(const CsvHead& head, std::string_view key) {
    const auto* line = lineCalled(head, key);
    return line == nullptr || line->fields.size() < 2 ? std::string_view() : line->fields[1];
}

std::optional<double> numberCalled(const CsvHead& head, std::string_view key) {
    auto text = wordCalled(head, key);
    if (const auto colon = text.rfind(':'); colon != std::string_view::npos) text.remove_prefix(colon + 1);
    const auto number = numberAndRest(text, head.point);
    return number && number->second.empty() ? std::optional(number->first) : std::nullopt;
}

std::optional<std::string_view> remarkCalled(const CsvHead& head, std::string_view key) {
    for (const std::string_view remark : head.remarks) {
        const auto mark = remark.find_first_of(":=");
        if (mark != std::string_view::npos && folded(remark.substr(0, mark)) == folded(key)) {
            return trimmed(remark.substr(mark + 1));
        }
    }
    return std::nullopt;
}

std::optional<double> secondsIn(std::string_view text, char point) {
    const auto number = numberAndRest(text, point);
    if (!number) return std::nullopt;
    const auto unit = spelledUnit(number->second);
    if (!unit || (unit->unit != "s" && !number->second.empty())) return std::nullopt;
    return number->first * unit->factor;
}

std::optional<double> hertzIn(std::string_view text, char point) {
    const auto number = numberAndRest(text, point);
    if (!number) return std::nullopt;
    auto unit = folded(number->second);
    double factor = 1;
    if (!unit.empty()) {
        constexpr std::string_view kPrefixes = "kmg";
        if (const auto prefix = kPrefixes.find(unit.front()); prefix != std::string_view::npos) {
            factor = std::pow(1000.0, static_cast<double>(prefix + 1));
            unit.erase(0, 1);
        }
        if (unit != "hz" && unit != "sa/s" && unit != "s/s") return std::nullopt;
    }
    return number->first * factor;
}

std::size_t filled(const CsvLine& line) {
    auto width = line.fields.size();
    while (width > 0 && line.fields[width - 1].empty()) --width;
    return width;
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
    }
    if (const auto* second = secondIn(names))
        return fail(ErrorCode::ParseError, "{}:{}: {}", file, line.number, givenTwice("column '{}'", *second));
    return names;
}

}  // namespace tacto
