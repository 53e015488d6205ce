// The tables of Owon's oscilloscopes.
#include "core/formats/csv/CsvColumns.h"
#include "core/formats/csv/CsvMakers.h"

namespace tacto {

namespace {

bool isOwon(const CsvHead& head) {
    return !head.header.empty() && folded(head.header.back().fields.front()) == "index" &&
           lineCalled(head, "Time interval") != nullptr;
}

Result<CsvDraft> owon(const CsvHead& head, std::string_view file) {
    const auto& line = head.header.back();
    const auto names = namesIn(line);
    CsvDraft draft(line, line);
    for (std::size_t c = 0; c < names.size(); ++c) {
        auto column = columnNamed(names[c]);
        constexpr std::string_view kVoltage = "_Voltage";
        if (column.name.ends_with(kVoltage)) column.name.resize(column.name.size() - kVoltage.size());
        draft.addOther(names[c]);
        if (c > 0) draft.columns.push_back({column.name, c + 1, column.unit, column.factor, column.unknownUnit});
    }
    const auto stated = wordCalled(head, "Time interval");
    draft.countRows(secondsIn(stated, head.point), 0, stated, file);
    draft.layout.times = RowTimes::Index;
    return draft;
}

}  // namespace

const CsvMaker kOwonCsv{CsvDialect::Owon, "csv-owon", "Owon CSV", isOwon, owon};

}  // namespace tacto
