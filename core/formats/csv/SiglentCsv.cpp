// The tables of Siglent's oscilloscopes, including those sold under other names.
#include <algorithm>

#include "core/formats/csv/CsvColumns.h"
#include "core/formats/csv/CsvMakers.h"

namespace tacto {

namespace {

bool isSiglent(const CsvHead& head) {
    if (head.header.empty() || folded(head.header.back().fields.front()) != "second") return false;
    if (lineCalled(head, "Record Length") != nullptr) {
        return lineCalled(head, "Sample Interval") != nullptr || lineCalled(head, "Sample Rate") != nullptr;
    }
    // A file saved on the instrument has the sources and then the units, or only the units.
    const auto lines = head.header.size();
    return isLineOfUnits(head.header.back()) &&
           (lines == 1 || (lines == 2 && folded(head.header.front().fields.front()) == "source"));
}

Result<CsvDraft> siglent(const CsvHead& head, std::string_view file) {
    if (auto timed = checkHorizontalUnit(head, file); !timed) return failure(timed);
    const auto& last = head.header.back();
    const auto* units = lineCalled(head, "Vertical Units");
    const auto* scales = lineCalled(head, "Vertical Scale");  // "CH1: 0.05" also names the channel
    const auto* source = lineCalled(head, "Source");
    CsvDraft draft(last, last);
    draft.addOther(last.fields.front());
    for (std::size_t c = 1; c < filled(last); ++c) {
        auto [name, spelled] = keyedValue(units, c - 1);
        if (name.empty()) name = keyedValue(scales, c - 1).first;
        if (source != nullptr && c < source->fields.size() && !source->fields[c].empty()) name = source->fields[c];
        if (name.empty()) name = fmt::format("CH{}", c);
        if (const auto own = spelledUnit(last.fields[c]); own && !own->unit.empty()) spelled = last.fields[c];
        draft.addChannel(std::move(name), spelled);
    }
    readRecordKeys(head, draft.layout);
    return draft;
}

}  // namespace

const CsvMaker kSiglentCsv{CsvDialect::Siglent, "csv-siglent", "Siglent CSV", isSiglent, siglent};

}  // namespace tacto
