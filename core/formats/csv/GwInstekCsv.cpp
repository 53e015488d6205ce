// The tables of GW Instek's oscilloscopes. Each trace has two fields in every line of keys (`Source,CH1,Source,CH2,`)
// and in every row: time and volts (Detail), or the value and nothing (Fast). Fast values are in steps of 1/25
// division. The GDS-1000 series does not state its mode.
#include "core/formats/csv/CsvColumns.h"
#include "core/formats/csv/CsvMakers.h"

namespace tacto {

namespace {

constexpr double kStepsPerDivision = 25;

/// Returns the field for trace `k` in line `key`.
std::string_view ofTrace(const CsvHead& head, std::string_view key, std::size_t k) {
    return fieldIn(lineCalled(head, key), 2 * k + 1);
}

bool isGwInstek(const CsvHead& head) {
    return head.firstRow && !head.header.empty() && lineCalled(head, "Memory Length") != nullptr &&
           lineCalled(head, "Sampling Period") != nullptr &&
           folded(head.header.back().fields.front()) == "waveform data";
}

Result<CsvDraft> gwInstek(const CsvHead& head, std::string_view file) {
    const auto traces = filled(*lineCalled(head, "Memory Length")) / 2;
    auto mode = folded(wordCalled(head, "Mode"));
    const bool isStated = !mode.empty();
    if (!isStated) mode = filled(*head.firstRow) == 2 * traces ? "detail" : "fast";
    if (mode != "detail" && mode != "fast") {
        return fail(ErrorCode::ParseError, "{}: the mode of saving is '{}'; Detail or Fast was expected", file,
                    wordCalled(head, "Mode"));
    }
    CsvDraft draft(*lineCalled(head, "Memory Length"), head.header.back());
    for (std::size_t k = 0; k < traces; ++k) {
        std::string name(ofTrace(head, "Source", k));
        if (name.empty()) name = fmt::format("CH{}", k + 1);
        if (mode == "detail") draft.addOther(k == 0 ? "time" : fmt::format("time of {}", name));
        draft.addChannel(std::move(name), ofTrace(head, "Vertical Units", k));
        if (mode == "detail") continue;
        const auto scale = fieldNumber(ofTrace(head, "Vertical Scale", k), head.point);
        if (!scale || !(*scale > 0)) {
            return fail(ErrorCode::ParseError, "{}: the vertical scale of '{}' is '{}'; a number above 0 was expected",
                        file, draft.columns.back().name, ofTrace(head, "Vertical Scale", k));
        }
        draft.columns.back().factor *= *scale / kStepsPerDivision;
        if (k + 1 < traces) draft.addOther("");
    }
    draft.layout.rows = numberCalled(head, "Memory Length");
    if (mode == "detail") {
        draft.layout.interval_s = numberCalled(head, "Sampling Period");
        return draft;
    }
    const double middle_s = numberCalled(head, "Horizontal Position").value_or(0);
    // Without a stated mode, the memory is longer than the ten divisions of the screen.
    const double half_s = isStated
                              ? 5 * numberCalled(head, "Horizontal Scale").value_or(0)
                              : draft.layout.rows.value_or(0) / 2 * numberCalled(head, "Sampling Period").value_or(0);
    draft.countRows(numberCalled(head, "Sampling Period"), middle_s - half_s, wordCalled(head, "Sampling Period"),
                    file);
    return draft;
}

}  // namespace

const CsvMaker kGwInstekCsv{CsvDialect::GwInstek, "csv-gwinstek", "GW Instek CSV", isGwInstek, gwInstek};

}  // namespace tacto
