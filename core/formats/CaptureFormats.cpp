#include "core/formats/CaptureFormats.h"

#include <algorithm>
#include <fmt/ranges.h>
#include <system_error>

#include "core/base/LocaleFreeText.h"
#include "core/base/Utf16.h"
#include "core/formats/IsfFormat.h"
#include "core/formats/TextBlocks.h"
#include "core/formats/WavFormat.h"
#include "core/formats/csv/CsvFormat.h"
#include "core/formats/csv/CsvMakers.h"

namespace tacto {

namespace {

std::string suffixOf(const std::filesystem::path& path) { return lowered(path.extension().string()); }

std::vector<std::string_view> suffixesOf(const std::vector<std::unique_ptr<CaptureFormat>>& formats,
                                         bool writableOnly) {
    std::vector<std::string_view> all;
    for (const auto& format : formats) {
        if (writableOnly && !format->canWrite()) continue;
        for (const auto suffix : format->suffixes()) {
            if (std::ranges::find(all, suffix) == all.end()) all.push_back(suffix);
        }
    }
    return all;
}

std::string_view behindLines(std::string_view text, std::size_t lines) {
    for (; lines > 0; --lines) {
        const auto end = text.find('\n');
        if (end == std::string_view::npos) return {};
        text.remove_prefix(end + 1);
    }
    return text;
}

}  // namespace

void CaptureFormats::add(std::unique_ptr<CaptureFormat> format) { formats_.push_back(std::move(format)); }

std::vector<std::string_view> CaptureFormats::suffixes() const { return suffixesOf(formats_, false); }
std::vector<std::string_view> CaptureFormats::writableSuffixes() const { return suffixesOf(formats_, true); }

bool CaptureFormats::knowsSuffix(const std::filesystem::path& path) const {
    const auto known = suffixes();
    return std::ranges::find(known, suffixOf(path)) != known.end();
}

Result<const CaptureFormat*> CaptureFormats::formatOf(const std::filesystem::path& path,
                                                      const ReadOptions& options) const {
    std::vector<std::string_view> ids;
    std::vector<std::string_view> names;
    for (const auto& format : formats_) {
        if (!options.format.empty() && format->id() == options.format) return format.get();
        ids.push_back(format->id());
        names.push_back(format->name());
    }
    if (!options.format.empty()) {
        return invalid("format '{}' is not known; known are {}", options.format, fmt::join(ids, ", "));
    }
    const auto head = readHead(path);
    if (!head) return failure(head);
    const auto text = asUtf8(*head);
    const auto looked = behindLines(text, options.skipRows);
    for (const auto& format : formats_) {
        if (format->recognises(path, looked)) return format.get();
    }
    return fail(ErrorCode::ParseError, "{}: the format is not recognised; known are {}", path.string(),
                fmt::join(names, ", "));
}

Result<CaptureReading> CaptureFormats::read(const std::filesystem::path& path, const ReadOptions& options,
                                            const ReadWatch& watch) const {
    const auto format = formatOf(path, options);
    if (!format) return failure(format);
    auto reading = readWithinMemory(path.string(), [&] { return (*format)->read(path, options, watch); });
    if (reading) {
        reading->formatId = (*format)->id();
        reading->formatName = (*format)->name();
    }
    return reading;
}

Result<const CaptureFormat*> CaptureFormats::writerOf(const std::filesystem::path& path) const {
    const auto suffix = suffixOf(path);
    for (const auto& format : formats_) {
        const auto its = format->suffixes();
        if (format->canWrite() && std::ranges::find(its, suffix) != its.end()) return format.get();
    }
    return invalid("{}: captures are not written as '{}'; {} are the suffixes that are", path.string(), suffix,
                   fmt::join(writableSuffixes(), ", "));
}

Result<void> CaptureFormats::write(const std::filesystem::path& path, const Capture& capture) const {
    const auto format = writerOf(path);
    return format ? (*format)->write(path, capture) : failure(format);
}

void addOwnFormats(CaptureFormats& formats) {
    formats.add(std::make_unique<WavFormat>());
    formats.add(std::make_unique<IsfFormat>());
    for (const auto& maker : csvMakers()) formats.add(std::make_unique<CsvFormat>(maker.dialect));
    formats.add(std::make_unique<CsvFormat>(CsvDialect::Plain));
}

std::shared_ptr<const CaptureFormats> ownCaptureFormats() {
    auto formats = std::make_shared<CaptureFormats>();
    addOwnFormats(*formats);
    return formats;
}

}  // namespace tacto
