#include <array>

#include "core/formats/csv/CsvColumns.h"
#include "core/formats/csv/CsvMakers.h"

namespace tacto {

namespace {

bool isPicoScope(const CsvHead& head) {
    // "Time", "Zeit", "Temps", by the language of the program
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

}  // namespace tacto
