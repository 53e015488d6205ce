// CsvRows.h - the rows of a table, some thousands at a time.
//
// Rows of nothing but numbers are read in one pass; a row with anything else (empty fields, quotes, blank lines) is cut
// into fields first. Both mean the same.
//
// Thread-safety: none; one owner.
#pragma once

#include <cstdint>

#include "core/formats/TextBlocks.h"
#include "core/formats/csv/CsvLayout.h"

namespace tacto {

/// Columns that are asked for, of consecutive rows.
struct RowBatch {
    static constexpr std::size_t kRows = 4096;
    std::size_t rows = 0;
    std::vector<double> times;                 ///< as the file has them; empty where no column is one
    std::vector<std::vector<double>> others;   ///< values of the layout's other columns of times
    std::vector<std::vector<float>> channels;  ///< in V, A or 1; not finite where the field is empty or says so
    std::vector<std::size_t> lines;            ///< in the file, from 1
};

class CsvRows {
public:
    /// `layout` and `blocks` must outlive this; `blocks` stands at its beginning.
    CsvRows(const CsvLayout& layout, char separator, char point, TextBlocks& blocks);

    /// The next rows; none at the end. Looks at `watch` once in every block.
    /// Errors: Io, Stopped; ParseError for a field that is not a number, a row too short or too long.
    [[nodiscard]] Result<const RowBatch*> next(const ReadWatch& watch);

    /// Bytes of text per row so far, for an estimate of what is to come; 0 before the first.
    [[nodiscard]] double bytesPerRow() const noexcept;
    /// Whether some value was infinite: beyond the instrument's range, not missing.
    [[nodiscard]] bool sawInfinite() const noexcept { return sawInfinite_; }
    /// Samples so far of the layout's channel `index` that are SCPI's mark of no value.
    [[nodiscard]] std::size_t noValues(std::size_t index) const {
        return uses_[layout_.channels[index].number - 1].noValues;
    }
    /// The line before which the layout says that the rows end; 0 where the file ends.
    [[nodiscard]] std::size_t endLine() const noexcept { return endLine_; }

private:
    /// A column of the file; what is read from it waits here until the batch is full.
    struct Use {
        bool ignored = true;
        std::vector<double> values{};
        std::size_t channel = kTime;  ///< its channel in the batch
        double factor = 1;
        std::size_t noValues = 0;
        bool stamps = false;  ///< dates and times
        static constexpr std::size_t kTime = static_cast<std::size_t>(-1);
        static constexpr std::size_t kOther = kTime / 2;  ///< added to the number of another column of times
    };
    /// Takes rows from text_ until the batch is full or the block is used up.
    [[nodiscard]] Result<void> takeRows();
    /// Reads the row at `text` into batch row `row`; the start of the next line, or null when it is not a plain row.
    [[nodiscard]] const char* takePlainRow(const char* text, const char* end, std::size_t row);
    [[nodiscard]] const char* takeStampOf(const char* text, const char* end, double& value) const;
    [[nodiscard]] Result<void> takeFields(std::string_view line, std::size_t row);
    /// The values that wait, into the batch.
    void deliver();

    const CsvLayout& layout_;
    const char separator_;
    const char point_;
    TextBlocks& blocks_;
    std::vector<Use> uses_;
    RowBatch batch_;
    std::vector<std::string_view> fields_;
    std::string_view text_;  ///< what the block has left
    std::size_t line_;       ///< line of the text's first byte
    std::size_t skip_;       ///< bytes before the first row
    std::uint64_t bytes_ = 0;
    std::uint64_t rows_ = 0;
    bool sawInfinite_ = false;
    std::size_t endLine_ = 0;
};

// Reads a capture out of a table with a known layout.

/// Reads all rows in one pass, holding the samples and one block; of a long table whose times are not plainly even the
/// times a second time, and holds them. Rows at the end in which no channel has a value are
/// left out, other missing values are NaN; both with a warning, as stamps that are coarse, stray, or disagree with the
/// header's interval.
/// Errors: Io, Stopped; ParseError naming the line where a field or row is wrong, a time is missing or time does not
/// rise in even steps (within half a step), and for fewer than two rows.
[[nodiscard]] Result<CaptureReading> readCsvTable(TextBlocks& blocks, const CsvHead& head, const CsvLayout& layout,
                                                  const ReadWatch& watch);

}  // namespace tacto
