// LabVIEW measurement files (*.lvm): keys of the file, keys of a segment, then a table. NI, "Specification for the
// LabVIEW Measurement File (.lvm)".
#include "core/formats/csv/CsvColumns.h"
#include "core/formats/csv/CsvMakers.h"

namespace tacto {

namespace {

constexpr std::string_view kBegin = "LabVIEW Measurement";

bool isLabView(const CsvHead& head) {
    return !head.header.empty() && folded(head.header.front().fields.front()) == folded(kBegin);
}

Result<CsvDraft> labView(const CsvHead& head, std::string_view file) {
    const auto expected = [&](std::string_view key, std::string_view wanted) {
        const auto* line = lineCalled(head, key);
        return fail(ErrorCode::ParseError, "{}:{}: {} is '{}'; {} was expected", file,
                    line == nullptr ? head.header.front().number : line->number, key, wordCalled(head, key), wanted);
    };
    const auto* names = lineCalled(head, "X_Value");
    if (names == nullptr) return expected("X_Value", "a line of names that begins so, before the numbers,");
    const auto columns = folded(wordCalled(head, "X_Columns"));
    if (columns != "no" && columns != "one")
        return expected("X_Columns", "No or One (one column of times for all channels)");
    if (const auto dimension = folded(wordCalled(head, "X_Dimension")); !dimension.empty() && dimension != "time")
        return expected("X_Dimension", "Time");
    const auto channels = numberCalled(head, "Channels");
    const auto width = names->fields.size();
    if (!channels || !(*channels >= 1 && *channels < static_cast<double>(width)))
        return expected("Channels", fmt::format("a number up to that of the names, {},", width - 1));
    CsvDraft draft(*names, *names);
    draft.addOther(names->fields.front());
    const auto* units = lineCalled(head, "Y_Unit_Label");
    for (std::size_t c = 1; c < width; ++c) {
        if (static_cast<double>(c) <= *channels) draft.addChannel(names->fields[c], fieldIn(units, c));
    }
    draft.layout.interval_s = numberCalled(head, "Delta_X");
    draft.layout.rows = numberCalled(head, "Samples");
    draft.layout.endsAt = "Channels";
    draft.layout.mayEndInText = true;
    if (columns == "one") return draft;
    const auto start = numberCalled(head, "X0");
    draft.countRows(draft.layout.interval_s, start.value_or(0), wordCalled(head, "Delta_X"), file);
    return draft;
}

}  // namespace

const CsvMaker kLabViewCsv{CsvDialect::LabView, "csv-labview", "LabVIEW measurement", isLabView, labView};

}  // namespace tacto
