#include "core/formats/csv/CsvFormat.h"

#include "core/formats/csv/CsvMakers.h"
#include "core/formats/csv/CsvTable.h"
#include "core/measure/CaptureDescription.h"
#include "core/measure/CaptureFile.h"

namespace tacto {

namespace {

struct Known {
    CsvDialect dialect;
    std::string_view id;
    std::string_view name;
};

Known known(CsvDialect dialect) {
    for (const auto& maker : csvMakers()) {
        if (maker.dialect == dialect) return {dialect, maker.id, maker.name};
    }
    return {CsvDialect::Plain, "csv", "CSV"};
}

/// Plain takes any text and is the last.
CsvDialect dialectOf(const CsvHead& head) {
    for (const auto& maker : csvMakers()) {
        if (isOfDialect(maker.dialect, head)) return maker.dialect;
    }
    return CsvDialect::Plain;
}

/// The part of a first block that a header is looked for in: whole lines.
std::string_view headOf(std::string_view text) {
    if (text.size() <= kHeadBytes) return text;
    const auto end = text.rfind('\n', kHeadBytes);
    return end == std::string_view::npos ? text : text.substr(0, end + 1);
}

bool isText(std::string_view head) { return head.find('\0') == std::string_view::npos; }

Result<CaptureReading> readTable(TextBlocks blocks, std::optional<CsvDialect> dialect, const ReadOptions& options,
                                 const ReadWatch& watch) {
    const auto block = blocks.next();
    if (!block) return failure(block);
    const auto text = headOf(*block);
    if (!isText(text)) {
        return fail(ErrorCode::ParseError,
                    "{}: not a text in UTF-8, in UTF-16 with its mark, or in ASCII; a table of numbers was expected",
                    blocks.name());
    }
    const auto head = readCsvHead(text, options.skipRows);
    if (!dialect) dialect = dialectOf(head);
    const auto layout = layOut(*dialect, head, options, blocks.name());
    if (!layout) return failure(layout);
    // The numbers of columns that were chosen, scaled or timed by hand are not those that the header is about.
    const bool asWritten =
        options.columns.empty() && options.units.empty() && options.probeFactors.empty() && !options.rate;
    const auto header = asWritten ? headerIn(text) : std::nullopt;
    if (auto back = blocks.rewind(); !back) return failure(back);
    auto reading = readCsvTable(blocks, head, *layout, watch);
    if (reading) {
        if (header) takeHeader(reading->capture, *header);
        reading->formatId = known(*dialect).id;
        reading->formatName = known(*dialect).name;
    }
    return reading;
}

Result<CaptureReading> readFile(const std::filesystem::path& path, std::optional<CsvDialect> dialect,
                                const ReadOptions& options, const ReadWatch& watch) {
    auto blocks = TextBlocks::ofFile(path);
    if (!blocks) return failure(blocks);
    return readTable(std::move(*blocks), dialect, options, watch);
}

}  // namespace

std::string_view CsvFormat::id() const noexcept { return known(dialect_).id; }
std::string_view CsvFormat::name() const noexcept { return known(dialect_).name; }

bool CsvFormat::recognises(const std::filesystem::path& /*path*/, std::string_view head) const {
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
    if (head.starts_with(kByteOrderMark)) head.remove_prefix(kByteOrderMark.size());
    return isText(head) && isOfDialect(dialect_, readCsvHead(headOf(head), 0));
}

Result<CaptureReading> CsvFormat::read(const std::filesystem::path& path, const ReadOptions& options,
                                       const ReadWatch& watch) const {
    return readFile(path, dialect_, options, watch);
}

Result<void> CsvFormat::write(const std::filesystem::path& path, const Capture& capture) const {
    return canWrite() ? writeCapture(path, capture) : CaptureFormat::write(path, capture);
}

Result<CaptureReading> readCapture(const std::filesystem::path& path, const ReadOptions& options,
                                   const ReadWatch& watch) {
    return readWithinMemory(path.string(), [&] { return readFile(path, std::nullopt, options, watch); });
}

Result<CaptureReading> parseCapture(std::string_view text, std::string_view name, const ReadOptions& options,
                                    const ReadWatch& watch) {
    return readWithinMemory(name,
                            [&] { return readTable(TextBlocks::ofText(text, name), std::nullopt, options, watch); });
}

}  // namespace tacto
