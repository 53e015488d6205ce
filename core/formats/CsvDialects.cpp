#include <algorithm>
#include <cctype>
#include <fmt/ranges.h>

#include "core/base/Text.h"
#include "core/formats/CsvColumns.h"
#include "core/formats/CsvDraft.h"

namespace tacto {

namespace {

bool hasField(const CsvLine& line, std::size_t index, std::string_view text) {
    return index < line.fields.size() && folded(line.fields[index]) == text;
}

/// Names in one line, units in the next; the first column is time. Empty fields at the end are no columns.
CsvDraft twoLines(const CsvLine& names, const CsvLine& units, std::size_t width) {
    CsvDraft draft(names, units);
    draft.layout.names.assign(names.fields.begin(), names.fields.begin() + static_cast<std::ptrdiff_t>(width));
    const auto time = unitField(units.fields.front());
    draft.layout.timeFactor = time ? time->factor : 1;
    for (std::size_t c = 1; c < width; ++c) {
        std::string name = names.fields[c];
        if (std::ranges::all_of(name, [](unsigned char letter) { return std::isdigit(letter) != 0; })) {
            name.insert(0, "CH");  // "1" would be the number of a column
        }
        const std::string spelled = c < units.fields.size() ? units.fields[c] : "";
        const auto unit = unitField(spelled);
        draft.columns.push_back({std::move(name), c + 1, unit ? std::string(unit->unit) : "", unit ? unit->factor : 1,
                                 unit ? "" : spelled});
    }
    return draft;
}

std::size_t filled(const CsvLine& line) {
    auto width = line.fields.size();
    while (width > 0 && line.fields[width - 1].empty()) --width;
    return width;
}

Result<CsvDraft> rigol(const CsvHead& head, std::string_view file) {
    const auto& names = head.header[0];
    const auto& units = head.header[1];
    if (!hasField(units, 0, "sequence")) return twoLines(names, units, filled(names));
    const auto start =
        std::ranges::find_if(names.fields, [](const std::string& name) { return folded(name) == "start"; });
    const auto width = static_cast<std::size_t>(start - names.fields.begin());
    auto draft = twoLines(names, units, width);
    const auto number = [&](std::size_t column) {
        return column < units.fields.size() ? fieldNumber(units.fields[column], head.point) : std::nullopt;
    };
    const auto start_s = number(width);
    const auto interval_s = number(width + 1);
    if (!start_s || !interval_s || !(*interval_s > 0)) {
        return fail(ErrorCode::ParseError,
                    "{}:{}: start and increment are '{}'; two numbers, the increment above 0, were expected", file,
                    units.number,
                    fmt::join(units.fields.begin() + static_cast<std::ptrdiff_t>(std::min(width, units.fields.size())),
                              units.fields.end(), ","));
    }
    draft.layout.times = RowTimes::Index;
    draft.layout.start_s = *start_s;
    draft.layout.interval_s = *interval_s;
    return draft;
}

/// "CH1:V,CH2:mV" or "V,mV": what a line of keys says of column `index` (0 is the first channel).
std::pair<std::string, std::string> keyed(const CsvLine* line, std::size_t index) {
    if (line == nullptr || index + 1 >= line->fields.size()) return {};
    const auto& field = line->fields[index + 1];
    const auto colon = field.find(':');
    if (colon == std::string::npos) return {"", field};
    return {std::string(trimmed(field.substr(0, colon))), std::string(trimmed(field.substr(colon + 1)))};
}

CsvDraft siglent(const CsvHead& head) {
    const auto& last = head.header.back();
    const auto* units = lineCalled(head, "Vertical Units");
    const auto* source = lineCalled(head, "Source");
    CsvDraft draft(last, last);
    const auto width = filled(last);
    draft.layout.names.assign(last.fields.begin(), last.fields.begin() + static_cast<std::ptrdiff_t>(width));
    for (std::size_t c = 1; c < width; ++c) {
        auto [name, spelled] = keyed(units, c - 1);
        if (source != nullptr && c < source->fields.size() && !source->fields[c].empty()) name = source->fields[c];
        if (name.empty()) name = fmt::format("CH{}", c);
        if (const auto own = spelledUnit(last.fields[c]); own && !own->unit.empty()) spelled = last.fields[c];
        const auto unit = spelledUnit(spelled);
        draft.columns.push_back({std::move(name), c + 1, unit ? std::string(unit->unit) : "", unit ? unit->factor : 1,
                                 unit ? "" : spelled});
    }
    draft.layout.interval_s = numberCalled(head, "Sample Interval");
    draft.layout.rows = numberCalled(head, "Record Length");
    return draft;
}

bool isTds(const CsvHead& head) {
    const auto& fields = head.header.front().fields;
    return folded(fields[0]) == "record length" && fields.size() >= 5 && !fields[3].empty() && !fields[4].empty() &&
           fieldNumber(fields[3], head.point) && fieldNumber(fields[4], head.point);
}

/// Keys stand beside the first rows; every row has its time and value in columns 4 and 5.
CsvDraft tds(const CsvHead& head) {
    const auto& first = head.header.front();
    CsvDraft draft(first, first);
    draft.layout.dataOffset = first.offset;
    draft.layout.dataLine = first.number;
    draft.layout.timeColumn = 3;
    const auto* source = lineCalled(head, "Source");
    const auto [none, spelled] = keyed(lineCalled(head, "Vertical Units"), 0);
    const auto unit = spelledUnit(spelled);
    auto name =
        source != nullptr && source->fields.size() > 1 && !source->fields[1].empty() ? source->fields[1] : "CH1";
    draft.layout.names = {"key", "value", "blank", "time", name};
    draft.columns.push_back(
        {std::move(name), 5, unit ? std::string(unit->unit) : "", unit ? unit->factor : 1, unit ? "" : spelled});
    draft.layout.interval_s = numberCalled(head, "Sample Interval");
    draft.layout.rows = numberCalled(head, "Record Length");
    return draft;
}

Result<CsvDraft> tektronix(const CsvHead& head, std::string_view file) {
    if (isTds(head)) return tds(head);
    const auto& line = *lineCalled(head, "TIME");
    const auto names = namesIn(line, file);
    if (!names) return failure(names);
    const auto* units = lineCalled(head, "Vertical Units");
    CsvDraft draft(line, line);
    draft.layout.names = *names;
    for (std::size_t c = 1; c < names->size(); ++c) {
        const auto [none, spelled] = keyed(units, c - 1);
        const auto unit = spelledUnit(spelled);
        draft.columns.push_back(
            {(*names)[c], c + 1, unit ? std::string(unit->unit) : "", unit ? unit->factor : 1, unit ? "" : spelled});
    }
    draft.layout.interval_s = numberCalled(head, "Sample Interval");
    draft.layout.rows = numberCalled(head, "Record Length");
    return draft;
}

}  // namespace

bool isOfDialect(CsvDialect dialect, const CsvHead& head) {
    if (dialect == CsvDialect::Plain) return true;
    if (head.header.empty()) return false;
    const auto& first = head.header.front();
    const auto second = head.header.size() > 1 ? head.header[1] : CsvLine{};
    switch (dialect) {
        case CsvDialect::Rigol:
            if (!hasField(first, 0, "x")) return false;
            return hasField(second, 0, "second") ||
                   (hasField(second, 0, "sequence") &&
                    std::ranges::any_of(first.fields, [](const auto& name) { return folded(name) == "start"; }));
        case CsvDialect::Siglent:
            return lineCalled(head, "Record Length") != nullptr && lineCalled(head, "Sample Interval") != nullptr &&
                   hasField(head.header.back(), 0, "second");
        case CsvDialect::Tektronix:
            return isTds(head) ||
                   (lineCalled(head, "TIME") != nullptr && lineCalled(head, "Sample Interval") != nullptr);
        case CsvDialect::Keysight:
            return hasField(first, 0, "x-axis") && hasField(second, 0, "second");
        case CsvDialect::PicoScope:
            return hasField(first, 0, "time") && isLineOfUnits(second) && second.fields.front().starts_with('(');
        case CsvDialect::Plain:
            return true;
    }
    return false;
}

Result<CsvLayout> layOut(CsvDialect dialect, const CsvHead& head, const ReadOptions& options, std::string_view file) {
    if (head.header.empty() && !head.firstRow) {
        return fail(ErrorCode::ParseError, "{}: the file is empty; a header line and rows of numbers were expected",
                    file);
    }
    if (!isOfDialect(dialect, head)) {
        const auto& first = head.header.empty() ? *head.firstRow : head.header.front();
        return fail(ErrorCode::ParseError, "{}:{}: '{}' does not begin a table of the format that was asked for", file,
                    first.number, first.fields.front());
    }
    const auto draft = [&]() -> Result<CsvDraft> {
        switch (dialect) {
            case CsvDialect::Rigol:
                return rigol(head, file);
            case CsvDialect::Siglent:
                return siglent(head);
            case CsvDialect::Tektronix:
                return tektronix(head, file);
            case CsvDialect::Keysight:
            case CsvDialect::PicoScope:
                return twoLines(head.header[0], head.header[1], filled(head.header[0]));
            case CsvDialect::Plain:
                break;
        }
        return plainDraft(head, options, file);
    }();
    if (!draft) return failure(draft);
    return finished(*draft, options, file);
}

}  // namespace tacto
