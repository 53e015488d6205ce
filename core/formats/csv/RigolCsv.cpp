// The tables of Rigol's oscilloscopes, which differ from series to series.
#include <algorithm>
#include <fmt/ranges.h>

#include "core/formats/csv/CsvColumns.h"
#include "core/formats/csv/CsvMakers.h"

namespace tacto {

namespace {

std::string fieldAt(const CsvLine& line, std::size_t index) { return folded(fieldIn(&line, index)); }

std::string withoutBlanks(std::string_view text) {
    auto word = folded(text);
    std::erase(word, ' ');
    return word;
}

/// Returns the index of the field "t0 = -25s" or "tInc = 2e-06s" in the line, or the line's width if there is none.
std::size_t fieldGiving(const CsvLine& line, std::string_view key) {
    const auto found = std::ranges::find_if(
        line.fields, [&](const std::string& field) { return withoutBlanks(field).starts_with(key); });
    return static_cast<std::size_t>(found - line.fields.begin());
}

/// Returns whether the header is `X,CH1,Start,Increment`, or the same without X if that column is switched off.
bool hasIncrement(const CsvHead& head) {
    const auto& names = head.header[0];
    const auto width = filled(names);
    if (width < 3 || fieldAt(names, width - 2) != "start" || fieldAt(names, width - 1) != "increment") return false;
    if (fieldAt(names, 0) == "x") return head.header.size() > 1 && fieldAt(head.header[1], 0) == "sequence";
    return head.firstRow && head.header.size() <= 2 && filled(*head.firstRow) == width - 2;
}

bool hasSeconds(const CsvHead& head) {
    if (head.header.size() < 2 || fieldAt(head.header[1], 0) != "second") return false;
    const auto first = fieldAt(head.header[0], 0);
    return first == "x" || first.empty() || (first == "time" && fieldAt(head.header[0], 1).starts_with("x("));
}

bool hasMemoryTimes(const CsvHead& head) {
    const auto& line = head.header.front();
    return head.header.size() == 1 && fieldGiving(line, "t0=") > 0 && fieldGiving(line, "tinc=") < line.fields.size() &&
           fieldGiving(line, "t0=") < line.fields.size();
}

/// Returns whether X has no unit but the other columns have theirs: X is then in seconds (DS1000D).
bool hasUnitsInNames(const CsvHead& head) {
    const auto& line = head.header.front();
    const auto width = filled(line);
    if (head.header.size() != 1 || width < 2 || fieldAt(line, 0) != "x") return false;
    return std::all_of(line.fields.begin() + 1, line.fields.begin() + static_cast<std::ptrdiff_t>(width),
                       [](const auto& field) { return !columnNamed(field).unit.empty(); });
}

bool isUltraScope(const CsvHead& head) {
    return lineCalled(head, "Number of Data points") != nullptr && lineCalled(head, "Channel Data") != nullptr &&
           isTimeColumn(columnNamed(head.header.back().fields.front()));
}

bool isRigol(const CsvHead& head) {
    return !head.header.empty() && (hasIncrement(head) || hasSeconds(head) || hasMemoryTimes(head) ||
                                    hasUnitsInNames(head) || isUltraScope(head));
}

/// Start and increment follow the units. Without a line of units, both are unknown.
CsvDraft startAndIncrement(const CsvHead& head, std::string_view file) {
    const auto& names = head.header[0];
    const auto* units = head.header.size() > 1 ? &head.header[1] : nullptr;
    const auto width = filled(names) - 2;
    const bool hasIndex = fieldAt(names, 0) == "x";
    CsvDraft draft(names, units != nullptr ? *units : names);
    if (hasIndex) draft.addOther(names.fields.front());
    for (std::size_t c = hasIndex ? 1 : 0; c < width; ++c) {
        draft.addChannel(names.fields[c], fieldIn(units, c));
        if (units == nullptr) draft.layout.warnings.push_back(unitNotStated(file, names, names.fields[c]));
    }
    const auto start_s = fieldNumber(fieldIn(units, width), head.point);
    draft.countRows(start_s ? fieldNumber(fieldIn(units, width + 1), head.point) : std::nullopt, start_s.value_or(0),
                    "", file);
    if (units == nullptr) {
        draft.layout.noInterval = fmt::format(
            "{}:{}: no line of units, start and increment below the names; one, as in Volt,-0.006,1e-05, was expected",
            file, names.number);
    } else if (!draft.layout.interval_s) {
        draft.layout.noInterval = fmt::format(
            "{}:{}: start and increment are '{}'; two numbers, the increment above 0, were expected", file,
            units->number,
            fmt::join(units->fields.begin() + static_cast<std::ptrdiff_t>(std::min(width, units->fields.size())),
                      units->fields.end(), ","));
    } else if (hasIndex) {
        draft.layout.times = RowTimes::Index;
    }
    return draft;
}

/// "X(CH1)" holds the channel's name in brackets.
CsvDraft seconds(const CsvHead& head) {
    auto names = head.header[0];
    for (auto& name : names.fields) {
        if (folded(name).starts_with("x(") && name.ends_with(')')) name = name.substr(2, name.size() - 3);
    }
    return twoLineDraft(names, head.header[1], filled(names));
}

Result<CsvDraft> memoryTimes(const CsvHead& head, std::string_view file) {
    const auto& line = head.header.front();
    const auto first = std::min(fieldGiving(line, "t0="), fieldGiving(line, "tinc="));
    const auto width = filled(line);
    if (width != first + 2) {
        return fail(ErrorCode::ParseError,
                    "{}:{}: the header is '{}'; all channels before one t0 and one tInc were "
                    "expected, as in CH1(V),CH2(V),t0 = 0s, tInc = 1e-06s",
                    file, line.number, fmt::join(line.fields, ","));
    }
    const auto valueOf = [&](std::string_view key) {
        const std::string_view field = line.fields[fieldGiving(line, key)];
        return secondsIn(field.substr(field.find('=') + 1), head.point);
    };
    CsvDraft draft(line, line);
    for (std::size_t c = 0; c < first; ++c) draft.addNamed(line.fields[c]);
    const auto start_s = valueOf("t0=");
    draft.countRows(start_s ? valueOf("tinc=") : std::nullopt, start_s.value_or(0),
                    fmt::format("{}, {}", line.fields[first], line.fields[first + 1]), file);
    return draft;
}

CsvDraft unitsInNames(const CsvHead& head) {
    const auto& line = head.header.front();
    CsvDraft draft(line, line);
    draft.addOther(line.fields.front());
    for (std::size_t c = 1; c < filled(line); ++c) draft.addNamed(line.fields[c]);
    return draft;
}

/// Reads tables of Rigol's PC program: names in the line "Channel Data", time and units in the last line.
CsvDraft ultraScope(const CsvHead& head) {
    const auto& last = head.header.back();
    const auto& names = *lineCalled(head, "Channel Data");
    CsvDraft draft(last, last);
    draft.layout.timeFactor = columnNamed(last.fields.front()).factor;
    draft.addOther("time");
    for (std::size_t c = 1; c < filled(last); ++c) {
        const auto column = columnNamed(last.fields[c]);
        auto name = c < filled(names) ? names.fields[c] : fmt::format("CH{}", c);
        draft.addOther(name);
        draft.columns.push_back({std::move(name), c + 1, column.unit, column.factor, column.unknownUnit});
    }
    if (const auto rate = numberCalled(head, "Sampling Frequency (Hz)"); rate && *rate > 0) {
        draft.layout.interval_s = 1 / *rate;
    }
    draft.layout.rows = numberCalled(head, "Number of Data points");
    return draft;
}

Result<CsvDraft> rigol(const CsvHead& head, std::string_view file) {
    if (hasIncrement(head)) return startAndIncrement(head, file);
    if (hasSeconds(head)) return seconds(head);
    if (hasMemoryTimes(head)) return memoryTimes(head, file);
    if (hasUnitsInNames(head)) return unitsInNames(head);
    return ultraScope(head);
}

}  // namespace

const CsvMaker kRigolCsv{CsvDialect::Rigol, "csv-rigol", "Rigol CSV", isRigol, rigol};

}  // namespace tacto
