#include "core/formats/csv/KeyedCsv.h"

#include "core/base/Text.h"
#include "core/formats/csv/CsvColumns.h"

namespace tacto {

std::pair<std::string, std::string> keyedValue(const CsvLine* line, std::size_t index) {
    if (line == nullptr || index + 1 >= line->fields.size()) return {};
    const auto& field = line->fields[index + 1];
    const auto colon = field.find(':');
    if (colon == std::string::npos) return {"", field};
    return {std::string(trimmed(std::string_view(field).substr(0, colon))),
            std::string(trimmed(std::string_view(field).substr(colon + 1)))};
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
