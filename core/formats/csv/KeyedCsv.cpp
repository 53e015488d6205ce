#include "core/formats/csv/KeyedCsv.h"

#include <algorithm>

#include "core/base/Text.h"
#include "core/formats/csv/CsvColumns.h"

namespace tacto {

std::pair<std::string, std::string> keyedValue(const CsvLine* line, std::size_t index) {
    if (line == nullptr) return {};
    std::vector<std::string_view> values;
    for (std::size_t c = 1; c < line->fields.size(); ++c) {
        const std::string_view field = line->fields[c];
        const bool hasSeveral = std::ranges::count(field, ':') > 1;  // "CH1:V CH2:V"
        for (const auto value : split(field, hasSeveral ? ' ' : ',')) values.push_back(value);
    }
    if (index >= values.size()) return {};
    const auto value = values[index];
    const auto colon = value.find(':');
    if (colon == std::string_view::npos) return {"", std::string(value)};
    return {std::string(trimmed(value.substr(0, colon))), std::string(trimmed(value.substr(colon + 1)))};
}

void readRecordKeys(const CsvHead& head, CsvLayout& layout) {
    layout.interval_s = numberCalled(head, "Sample Interval");
    if (!layout.interval_s) layout.interval_s = secondsIn(wordCalled(head, "Sample Interval"), head.point);
    if (const auto rate = hertzIn(wordCalled(head, "Sample Rate"), head.point); !layout.interval_s && rate) {
        layout.interval_s = 1 / *rate;
    }
    layout.rows = numberCalled(head, "Record Length");
}

Result<void> checkHorizontalUnit(const CsvHead& head, std::string_view file) {
    const auto spelled = wordCalled(head, "Horizontal Units");
    const auto unit = spelledUnit(spelled);
    if (spelled.empty() || (unit && unit->unit == "s" && unit->factor == 1)) return {};
    return fail(ErrorCode::Unsupported, "{}:{}: the horizontal unit is '{}'; s, of a record over time, was expected",
                file, lineCalled(head, "Horizontal Units")->number, spelled);
}

bool keysStandBesideRows(const CsvHead& head, std::size_t firstLine) {
    if (firstLine >= head.header.size()) return false;
    const auto& fields = head.header[firstLine].fields;
    return fields.size() >= 5 && !fields[3].empty() && !fields[4].empty() && fieldNumber(fields[3], head.point) &&
           fieldNumber(fields[4], head.point);
}

CsvDraft draftBesideKeys(const CsvHead& head, std::size_t firstLine) {
    CsvDraft draft(head.header.front(), head.header.front());
    draft.startAt(firstLine < head.header.size() ? head.header[firstLine] : *head.firstRow);
    draft.layout.timeColumn = 3;
    const std::string source(wordCalled(head, "Source"));
    draft.layout.names = {"key", "value", "blank", "time"};
    draft.addChannel(source.empty() ? "CH1" : source, keyedValue(lineCalled(head, "Vertical Units"), 0).second);
    readRecordKeys(head, draft.layout);
    return draft;
}

}  // namespace tacto
