#include "core/formats/csv/CsvMakers.h"

#include <algorithm>
#include <array>

#include "core/base/LocaleFreeText.h"
#include "core/formats/csv/CsvColumns.h"

namespace tacto {

std::pair<std::string, std::string> keyedValue(const CsvLine* line, std::size_t index) {
    if (line == nullptr) return {};
    std::vector<std::string_view> values;
    for (std::size_t c = 1; c < line->fields.size(); ++c) {
        const std::string_view field = line->fields[c];
        const bool hasSeveral = std::ranges::count(field, ':') > 1;  // "CH1:V CH2:V"
        for (const auto value : split(field, hasSeveral ? ' ' : ',')) values.push_back(value);
    }
    if (index >= values.size()) return {};
    const auto value = values[index];
    const auto colon = value.find(':');
    if (colon == std::string_view::npos) return {"", std::string(value)};
    return {std::string(trimmed(value.substr(0, colon))), std::string(trimmed(value.substr(colon + 1)))};
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
    return fail(ErrorCode::Unsupported, "{}:{}: the horizontal unit is '{}'; seconds (s) were expected", file,
                lineCalled(head, "Horizontal Units")->number, spelled);
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

namespace {

bool isPicoScope(const CsvHead& head) {
    // "Time", "Zeit", "Temps": depends on the language of the program
    return head.header.size() > 1 && isTimeColumn({head.header[0].fields.front(), "", 1, ""}) &&
           isLineOfUnits(head.header[1]) && head.header[1].fields.front().starts_with('(');
}

Result<CsvDraft> picoScope(const CsvHead& head, std::string_view /*file*/) {
    return twoLineDraft(head.header[0], head.header[1], filled(head.header[0]));
}

const CsvMaker* makerOf(CsvDialect dialect) noexcept {
    for (const auto& maker : csvMakers()) {
        if (maker.dialect == dialect) return &maker;
    }
    return nullptr;
}

}  // namespace

const CsvMaker kPicoScopeCsv{CsvDialect::PicoScope, "csv-picoscope", "PicoScope CSV", isPicoScope, picoScope};

std::span<const CsvMaker> csvMakers() noexcept {
    static const std::array kMakers{kRigolCsv,  kSiglentCsv, kTektronixCsv, kKeysightCsv, kPicoScopeCsv,
                                    kLeCroyCsv, kHantekCsv,  kOwonCsv,      kGwInstekCsv, kYokogawaCsv,
                                    kMicsigCsv, kSigrokCsv,  kLabViewCsv};
    return kMakers;
}

bool isOfDialect(CsvDialect dialect, const CsvHead& head) {
    const auto* maker = makerOf(dialect);
    return maker == nullptr || ((!head.header.empty() || head.firstRow) && maker->recognises(head));
}

Result<CsvLayout> layOut(CsvDialect dialect, const CsvHead& head, const ReadOptions& options, std::string_view file) {
    if (head.header.empty() && !head.firstRow) {
        return fail(ErrorCode::ParseError, "{}: the file is empty; a header line and rows of numbers were expected",
                    file);
    }
    if (!isOfDialect(dialect, head)) {
        const auto& first = head.header.empty() ? *head.firstRow : head.header.front();
        return fail(ErrorCode::ParseError, "{}:{}: '{}' does not begin a table of the format that was asked for", file,
                    first.number, first.fields.front());
    }
    const auto* maker = makerOf(dialect);
    auto draft = maker != nullptr ? maker->draft(head, file) : plainDraft(head, options, file);
    if (!draft) return failure(draft);
    return finished(*std::move(draft), head, options, file);
}

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
