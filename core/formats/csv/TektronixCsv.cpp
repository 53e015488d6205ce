// The tables of Tektronix' oscilloscopes, and of Micsig's, which look like TDS tables.
#include <algorithm>

#include "core/formats/csv/CsvColumns.h"
#include "core/formats/csv/CsvMakers.h"

namespace tacto {

namespace {

bool isTds(const CsvHead& head) {
    return folded(head.header.front().fields.front()) == "record length" && keysStandBesideRows(head, 0);
}

bool isTektronix(const CsvHead& head) {
    return !head.header.empty() &&
           (isTds(head) || (lineCalled(head, "TIME") != nullptr && lineCalled(head, "Sample Interval") != nullptr));
}

/// In `TIME,CH1,,TIME,D1,D0`, the digital channels have their own table next to the first.
Result<CsvDraft> tektronix(const CsvHead& head, std::string_view file) {
    if (auto timed = checkHorizontalUnit(head, file); !timed) return failure(timed);
    if (isTds(head)) return draftBesideKeys(head, 0);
    auto line = *lineCalled(head, "TIME");
    const auto width = filled(line);
    const auto blank = static_cast<std::size_t>(std::ranges::find(line.fields, std::string()) - line.fields.begin());
    const bool second = blank + 1 < width && folded(line.fields[blank + 1]) == "time";
    auto own = line;
    if (second) own.fields.resize(blank);
    const auto names = namesIn(own);
    const auto* units = lineCalled(head, "Vertical Units");
    CsvDraft draft(line, line);
    draft.addOther(names.front());
    std::string unit;
    for (std::size_t c = 1; c < names.size(); ++c) {
        // "CH1,CH1 Peak Detect" are two values of the same samples; the unit of the first holds for both.
        const bool isSecond = c > 1 && names[c].starts_with(names[c - 1] + " ");
        if (const auto stated = keyedValue(units, c - 1).second; !stated.empty() || !isSecond) unit = stated;
        draft.addChannel(names[c], unit);
    }
    if (second) {
        for (std::size_t c = blank; c < width; ++c) draft.addOther(line.fields[c]);
        draft.layout.warnings.push_back(
            fmt::format("{}:{}: the columns from {} on have times of their own and were "
                        "left out",
                        file, line.number, blank + 2));
    }
    readRecordKeys(head, draft.layout);
    return draft;
}

std::size_t firstMicsigRow(const CsvHead& head) {
    std::size_t line = 1;
    while (line < head.header.size() && !keysStandBesideRows(head, line)) ++line;
    return line;
}

bool isMicsig(const CsvHead& head) {
    return !head.header.empty() && folded(head.header.front().fields.front()) == "proid" &&
           head.header.front().fields.size() >= 5 && folded(head.header.front().fields[3]) == "time" &&
           (firstMicsigRow(head) < head.header.size() || head.firstRow);
}

Result<CsvDraft> micsig(const CsvHead& head, std::string_view file) {
    if (filled(head.header.front()) > 5) {
        return fail(ErrorCode::Unsupported,
                    "{}:{}: {} columns; the five of one channel were expected: export each channel by itself", file,
                    head.header.front().number, filled(head.header.front()));
    }
    return draftBesideKeys(head, firstMicsigRow(head));
}

}  // namespace

const CsvMaker kTektronixCsv{CsvDialect::Tektronix, "csv-tektronix", "Tektronix CSV", isTektronix, tektronix};
const CsvMaker kMicsigCsv{CsvDialect::Micsig, "csv-micsig", "Micsig CSV", isMicsig, micsig};

}  // namespace tacto
