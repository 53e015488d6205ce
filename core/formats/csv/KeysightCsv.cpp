// The tables of Keysight's (Agilent's) oscilloscopes: InfiniiVision and Infiniium.
#include "core/base/LocaleFreeText.h"
#include "core/formats/csv/CsvColumns.h"
#include "core/formats/csv/CsvMakers.h"

namespace tacto {

namespace {

constexpr std::string_view kOneSegment = "one segment per file was expected; export each by itself";

/// Returns the line `x-axis,1,2`, which may follow a line about segments.
const CsvLine* axisLine(const CsvHead& head) {
    for (std::size_t i = 0; i + 1 < head.header.size() && i < 2; ++i) {
        if (folded(head.header[i].fields.front()) == "x-axis" &&
            folded(head.header[i + 1].fields.front()) == "second") {
            return &head.header[i];
        }
    }
    return nullptr;
}

bool isInfiniium(const CsvHead& head) {
    return head.firstRow && lineCalled(head, "XInc") != nullptr && lineCalled(head, "XOrg") != nullptr &&
           lineCalled(head, "Points") != nullptr;
}

bool isKeysight(const CsvHead& head) { return axisLine(head) != nullptr || isInfiniium(head); }

CsvDraft infiniiVision(const CsvHead& head) {
    const auto* const axis = axisLine(head);
    auto draft = twoLineDraft(axis[0], axis[1], filled(axis[0]));
    constexpr std::string_view kSegments = "points/segment";
    if (const std::string_view first = head.header.front().fields.front(); folded(first).starts_with(kSegments)) {
        draft.layout.rows = parseNumber(first.substr(std::min(first.size(), first.find('=') + 1)));
        draft.layout.otherRows = kOneSegment;
    }
    return draft;
}

/// Reads values alone, or each after its time. Every source has its own column of keys.
Result<CsvDraft> infiniium(const CsvHead& head, std::string_view file) {
    const auto& increments = *lineCalled(head, "XInc");
    const auto sources = filled(increments) - 1;
    const auto columns = filled(*head.firstRow);
    const bool hasTime = columns == sources + 1;
    if (sources == 0 || (columns != sources && !hasTime)) {
        return fail(ErrorCode::ParseError,
                    "{}:{}: {} columns for {} sources; one for each, or the time before them, "
                    "were expected",
                    file, head.firstRow->number, columns, sources);
    }
    for (std::size_t c = 2; c < filled(increments); ++c) {
        if (increments.fields[c] != increments.fields[1]) {
            return fail(ErrorCode::Unsupported,
                        "{}:{}: the sources have samples {} and {} s apart; sources of one interval were expected",
                        file, increments.number, increments.fields[1], increments.fields[c]);
        }
    }
    CsvDraft draft(increments, increments);
    draft.startAt(*head.firstRow);
    if (hasTime) draft.addOther("time");
    const auto* names = lineCalled(head, "Source");
    const auto* units = lineCalled(head, "YUnits");
    for (std::size_t c = 1; c <= sources; ++c) {
        const std::string name(fieldIn(names, c));
        draft.addChannel(name.empty() ? fmt::format("CH{}", c) : name, fieldIn(units, c));
    }
    draft.layout.rows = numberCalled(head, "Points");
    if (numberCalled(head, "Segments").value_or(0) > 1) draft.layout.otherRows = kOneSegment;
    if (hasTime) {
        draft.layout.interval_s = numberCalled(head, "XInc");
        return draft;
    }
    const auto origin_s = numberCalled(head, "XOrg");
    draft.countRows(origin_s ? numberCalled(head, "XInc") : std::nullopt, origin_s.value_or(0),
                    wordCalled(head, "XInc"), file);
    return draft;
}

Result<CsvDraft> keysight(const CsvHead& head, std::string_view file) {
    if (axisLine(head) != nullptr) return infiniiVision(head);
    return infiniium(head, file);
}

}  // namespace

const CsvMaker kKeysightCsv{CsvDialect::Keysight, "csv-keysight", "Keysight CSV", isKeysight, keysight};

}  // namespace tacto
