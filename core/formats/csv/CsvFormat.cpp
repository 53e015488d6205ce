#include "core/formats/csv/CsvFormat.h"

#include "core/formats/csv/CsvAdvice.h"
#include "core/formats/csv/CsvColumns.h"
#include "core/formats/csv/CsvMakers.h"
#include "core/formats/csv/CsvRows.h"
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

/// Plain accepts any text, so it is tried last.
CsvDialect dialectOf(const CsvHead& head) {
    for (const auto& maker : csvMakers()) {
        if (isOfDialect(maker.dialect, head)) return maker.dialect;
    }
    return CsvDialect::Plain;
}

/// Returns the beginning of a text, in whole lines, in which a header is searched.
std::string_view headOf(std::string_view text) {
    if (text.size() <= kHeadBytes) return text;
    const auto end = text.rfind('\n', kHeadBytes);
    return end == std::string_view::npos ? text : text.substr(0, end + 1);
}

bool isText(std::string_view head) { return head.find('\0') == std::string_view::npos; }

/// Returns the dialect that the options name, or else the table's own.
CsvDialect dialectFor(const CsvHead& head, const ReadOptions& options) {
    if (options.format == known(CsvDialect::Plain).id) return CsvDialect::Plain;
    for (const auto& maker : csvMakers()) {
        if (maker.id == options.format) return maker.dialect;
    }
    return dialectOf(head);
}

/// Reads the table from the beginning of `blocks`; `text` is its first part.
Result<CaptureReading> readOnce(TextBlocks& blocks, std::string_view text, CsvDialect dialect, const CsvHead& head,
                                const ReadOptions& options, const ReadWatch& watch) {
    const auto layout = layOut(dialect, head, options, blocks.name());
    if (!layout) return failure(layout);
    // If columns were chosen, scaled or timed by options, the header no longer describes them.
    const bool asWritten =
        options.columns.empty() && options.units.empty() && options.probeFactors.empty() && !options.rate;
    const auto header = asWritten ? headerIn(text) : std::nullopt;
    auto reading = readCsvTable(blocks, head, *layout, watch);
    if (reading) {
        if (header) takeHeader(reading->capture, *header);
        reading->formatId = known(dialect).id;
        reading->formatName = known(dialect).name;
    }
    return reading;
}

/// Adds to `refusal` the options that were tried and do read the table. Errors: Stopped.
tl::unexpected<Error> withAdvice(Error refusal, TextBlocks& blocks, const std::string& text, CsvDialect dialect,
                                 const ReadOptions& options, const ReadWatch& watch) {
    const bool isOfTable = refusal.code == ErrorCode::ParseError || refusal.code == ErrorCode::InvalidArgument;
    if (!isOfTable || refusal.message.find(kRateInstead) != std::string::npos)
        return tl::unexpected(std::move(refusal));
    constexpr std::uint64_t kLong = 32UL * 1024 * 1024;
    std::size_t readings = blocks.size() > kLong ? 3 : 40;  // how often all rows may be read
    for (const auto& advice : adviceToTry(text, dialect, options, blocks.name())) {
        const auto head = readCaptureHead(text, advice.options.skipRows);
        if (head.header.empty() && !head.firstRow) continue;
        const auto tried = dialectFor(head, advice.options);
        if (!layOut(tried, head, advice.options, blocks.name())) continue;
        if (readings-- == 0 || !blocks.rewind()) break;
        const auto reading = readOnce(blocks, text, tried, head, advice.options, {{}, watch.stop});
        if (reading) {
            refusal.message += "; " + advice.words;
            break;
        }
        if (reading.error().code == ErrorCode::Stopped) return failure(reading);
    }
    return tl::unexpected(std::move(refusal));
}

Result<CaptureReading> readTable(TextBlocks blocks, std::optional<CsvDialect> dialect, const ReadOptions& options,
                                 const ReadWatch& watch) {
    const auto block = blocks.next();
    if (!block) return failure(block);
    const std::string text(headOf(*block));
    if (!isText(text)) {
        return fail(ErrorCode::ParseError,
                    "{}: not a text in UTF-8, in UTF-16 with its mark, or in ASCII; a table of numbers was expected",
                    blocks.name());
    }
    const auto head = readCaptureHead(text, options.skipRows);
    if (!dialect) dialect = dialectFor(head, options);
    if (auto back = blocks.rewind(); !back) return failure(back);
    auto reading = readOnce(blocks, text, *dialect, head, options, watch);
    if (reading) return reading;
    return withAdvice(std::move(reading.error()), blocks, text, *dialect, options, watch);
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
    return isText(head) && isOfDialect(dialect_, readCaptureHead(headOf(head), 0));
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
