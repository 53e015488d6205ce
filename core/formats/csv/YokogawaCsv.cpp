// The tables of Yokogawa's oscilloscopes and ScopeCorders.
#include "core/formats/csv/CsvColumns.h"
#include "core/formats/csv/CsvMakers.h"

namespace tacto {

namespace {

bool isYokogawa(const CsvHead& head) {
    return head.firstRow && lineCalled(head, "TraceName") != nullptr && lineCalled(head, "BlockSize") != nullptr &&
           (lineCalled(head, "HResolution") != nullptr || lineCalled(head, "SampleRate") != nullptr);
}

/// Returns the interval from HResolution, else from the rate, whose unit is in its own field ("100","MHz").
std::optional<double> intervalOf(const CsvHead& head) {
    if (const auto step = numberCalled(head, "HResolution")) return step;
    const auto* line = lineCalled(head, "SampleRate");
    if (line == nullptr || line->fields.size() < 2) return std::nullopt;
    auto rate = line->fields[1];
    if (line->fields.size() > 2 && line->fields[2].find_first_of("0123456789") == std::string::npos) {
        rate += " " + line->fields[2];
    }
    const auto hertz = hertzIn(rate, head.point);
    return hertz ? std::optional(1 / *hertz) : std::nullopt;
}

/// Rows may begin with an empty field, under the column of keys.
Result<CsvDraft> yokogawa(const CsvHead& head, std::string_view file) {
    const auto& names = *lineCalled(head, "TraceName");
    const auto* units = lineCalled(head, "VUnit") != nullptr ? lineCalled(head, "VUnit") : lineCalled(head, "Unit");
    const auto traces = filled(names) - 1;
    const auto& first = *head.firstRow;
    const std::size_t indent = first.fields.front().empty() ? 1 : 0;
    if (traces == 0 || filled(first) != traces + indent) {
        return fail(ErrorCode::ParseError, "{}:{}: {} values for {} traces; one for each, without times, was expected",
                    file, first.number, filled(first) - indent, traces);
    }
    CsvDraft draft(names, names);
    draft.startAt(first);
    if (indent == 1) draft.addOther("");
    for (std::size_t c = 1; c <= traces; ++c) draft.addChannel(names.fields[c], fieldIn(units, c));
    draft.layout.rows = numberCalled(head, "BlockSize");
    if (numberCalled(head, "BlockNumber").value_or(1) > 1) {
        draft.layout.otherRows = "one block per file was expected; save the waveforms of the history by themselves";
    }
    const auto interval = intervalOf(head);
    draft.countRows(
        interval, numberCalled(head, "HOffset").value_or(0),
        lineCalled(head, "HResolution") != nullptr ? wordCalled(head, "HResolution") : wordCalled(head, "SampleRate"),
        file);
    return draft;
}

}  // namespace

const CsvMaker kYokogawaCsv{CsvDialect::Yokogawa, "csv-yokogawa", "Yokogawa CSV", isYokogawa, yokogawa};

}  // namespace tacto
