// The tables of Hantek's oscilloscopes. Keys are in comments, and columns have no names.
#include <algorithm>

#include "core/base/LocaleFreeText.h"
#include "core/formats/csv/CsvColumns.h"
#include "core/formats/csv/CsvMakers.h"

namespace tacto {

namespace {

constexpr std::string_view kOneChannel = "one channel per file was expected; export each by itself";

/// Finds `,#voltbase=1000000(uV)`, which its comma keeps from being a comment; a logic analyser has `,#threshold=…`.
const CsvLine* baseLine(const CsvHead& head) {
    const auto found = std::ranges::find_if(head.header, [](const CsvLine& line) {
        return line.fields.size() > 1 && line.fields[0].empty() && line.fields[1].starts_with('#');
    });
    return found == head.header.end() ? nullptr : &*found;
}

bool hasTimes(const CsvHead& head) { return remarkCalled(head, "timebase") && baseLine(head) != nullptr; }
bool hasClock(const CsvHead& head) { return head.header.empty() && remarkCalled(head, "CLOCK").has_value(); }

bool isHantek(const CsvHead& head) { return head.firstRow && (hasTimes(head) || hasClock(head)); }

Result<CsvDraft> hantek(const CsvHead& head, std::string_view file) {
    const auto columns = filled(*head.firstRow);
    CsvDraft draft(*head.firstRow, *head.firstRow);
    draft.startAt(*head.firstRow);
    if (const auto size = remarkCalled(head, "SIZE")) {
        draft.layout.rows = parseNumber(*size);
        draft.layout.otherRows = kOneChannel;
    }
    if (hasTimes(head)) {
        if (baseLine(head)->fields[1].starts_with("#threshold")) {
            return fail(
                ErrorCode::Unsupported,
                "{}:{}: this channel is a logic analyzer's; an analog channel was expected (its head states #voltbase)",
                file, baseLine(head)->number);
        }
        draft.addOther("time");
        for (std::size_t c = 1; c < columns; ++c) draft.addChannel(fmt::format("CH{}", c), "V");
        return draft;
    }
    // The channels follow each other, with only comments between them.
    if (!draft.layout.rows) {
        return fail(ErrorCode::Unsupported, "{}: no number of samples; #SIZE= and a number were expected in a comment",
                    file);
    }
    const std::string name(remarkCalled(head, "CHANNEL").value_or("CH1"));
    const auto unit = remarkCalled(head, "UNITS").value_or("V");
    for (std::size_t c = 0; c < columns; ++c) draft.addChannel(c == 0 ? name : fmt::format("column {}", c + 1), unit);
    const auto clock = *remarkCalled(head, "CLOCK");
    draft.countRows(secondsIn(clock, head.point), 0, clock, file);
    return draft;
}

}  // namespace

const CsvMaker kHantekCsv{CsvDialect::Hantek, "csv-hantek", "Hantek CSV", isHantek, hantek};

}  // namespace tacto
