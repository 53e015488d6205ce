// CsvFormat.h - tables of text: the dialects of oscilloscopes (CsvLayout.h), and plain `time_s,voltage_v,current_a`.
//
// Thread-safety: as CaptureFormat.
#pragma once

#include "core/formats/CaptureFormat.h"
#include "core/formats/csv/CsvLayout.h"

namespace tacto {

class CsvFormat final : public CaptureFormat {
public:
    explicit CsvFormat(CsvDialect dialect) noexcept : dialect_(dialect) {}

    std::string_view id() const noexcept override;
    std::string_view name() const noexcept override;
    std::vector<std::string_view> suffixes() const override {
        return {dialect_ == CsvDialect::LabView ? ".lvm" : ".csv"};
    }
    /// Plain accepts any text. A .txt file may be a table, but not every .txt in a folder is a capture.
    bool recognises(const std::filesystem::path& path, std::string_view head) const override;
    Result<CaptureReading> read(const std::filesystem::path& path, const ReadOptions& options,
                                const ReadWatch& watch) const override;

    /// Only Plain is written: see writeCapture() in core/measure/CaptureFile.h.
    bool canWrite() const noexcept override { return dialect_ == CsvDialect::Plain; }
    Result<void> write(const std::filesystem::path& path, const Capture& capture) const override;

private:
    CsvDialect dialect_;
};

/// Reads a table in any known dialect. All values become V and A. Such files do not hold the input range, resolution
/// and trigger moment. These stay unknown, so that no sample is known to be clipped (see core/measure/Clipping.h),
/// unless the options state a range. A field that is empty or says nan or 9.9E+37 (isNoValue()) is a missing sample:
/// dropped with a warning at the end of the record, NaN elsewhere; pulses that touch it are not measured. Errors:
/// NotFound; Io, also if the samples do not fit into memory; ParseError naming file, line and what was expected: a
/// field that is not a number, a row of the wrong length, no time column, an unknown unit, time that does not rise in
/// even steps (± half a step), fewer than two rows; InvalidArgument for options that do not fit; Unsupported if the
/// file is not one record over time (segments, a spectrum); Stopped. The sentence ends with options that read the
/// table, if any (CsvAdvice.h).
[[nodiscard]] Result<CaptureReading> readCapture(const std::filesystem::path& path, const ReadOptions& options = {},
                                                 const ReadWatch& watch = {});

/// Does the same for a table in memory; messages use `name` in place of a file name.
[[nodiscard]] Result<CaptureReading> parseCapture(std::string_view text, std::string_view name,
                                                  const ReadOptions& options = {}, const ReadWatch& watch = {});

}  // namespace tacto
