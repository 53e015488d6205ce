// The tables of LeCroy's oscilloscopes.
#include "core/formats/csv/CsvColumns.h"
#include "core/formats/csv/CsvMakers.h"

namespace tacto {

namespace {

bool isLeCroy(const CsvHead& head) {
    return head.header.size() > 2 && folded(head.header.front().fields.front()).starts_with("lecroy") &&
           lineCalled(head, "Segments") != nullptr && folded(head.header.back().fields.front()) == "time";
}

Result<CsvDraft> leCroy(const CsvHead& head, std::string_view file) {
    const auto segments = numberCalled(head, "Segments");
    if (!segments || *segments != 1) {
        return fail(ErrorCode::Unsupported, "{}:{}: {} segments; one per file was expected: export each by itself",
                    file, lineCalled(head, "Segments")->number, wordCalled(head, "Segments"));
    }
    const auto& line = head.header.back();
    const auto names = namesIn(line);
    CsvDraft draft(line, line);
    draft.addOther(names.front());
    for (std::size_t c = 1; c < names.size(); ++c) {
        draft.addChannel(names[c], "");
        draft.layout.warnings.push_back(unitNotStated(file, line, names[c]));
    }
    return draft;
}

}  // namespace

const CsvMaker kLeCroyCsv{CsvDialect::LeCroy, "csv-lecroy", "LeCroy CSV", isLeCroy, leCroy};

}  // namespace tacto
