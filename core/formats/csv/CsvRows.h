// CsvRows.h - reads the rows of a table, some thousands at a time.
//
// Rows with only numbers are read in one pass. Other rows (empty fields, quotes, blank lines) are first split into
// fields. The results are the same.
//
// Thread-safety: none; one owner.
#pragma once

#include <cstdint>

#include "core/formats/TextBlocks.h"
#include "core/formats/csv/CsvLayout.h"

namespace tacto {

/// The requested columns of consecutive rows.
struct RowBatch {
    static constexpr std::size_t kRows = 4096;
    std::size_t rows = 0;
    std::vector<double> times;                 ///< as in the file; empty if there is no time column
    std::vector<std::vector<double>> others;   ///< values in the layout's other time columns
    std::vector<std::vector<float>> channels;  ///< in V, A or 1; not finite if the field is empty or not finite
    std::vector<std::size_t> lines;            ///< line numbers in the file, from 1
};

class CsvRows {
public:
    /// `layout` and `blocks` must outlive this object; `blocks` must be at its beginning.
    CsvRows(const CsvLayout& layout, char separator, char point, TextBlocks& blocks);

    /// Returns the next rows; none at the end. Checks `watch` once per block. Errors: Io, Stopped; ParseError for a
    /// field that is not a number or a row that is too short or too long.
    [[nodiscard]] Result<const RowBatch*> next(const ReadWatch& watch);

    /// Returns the bytes of text per row so far, to estimate the remaining rows; 0 before the first row.
    [[nodiscard]] double bytesPerRow() const noexcept;
    /// Returns whether a value was infinite: beyond the instrument's range, not missing.
    [[nodiscard]] bool sawInfinite() const noexcept { return sawInfinite_; }
    /// Returns how many samples of the layout's channel `index` so far were SCPI's mark for no value.
    [[nodiscard]] std::size_t noValues(std::size_t index) const {
        return uses_[layout_.channels[index].number - 1].noValues;
    }
    /// Returns the line that ended the rows, as the layout says; 0 if the file ended them.
    [[nodiscard]] std::size_t endLine() const noexcept { return endLine_; }

private:
    /// A column of the file. Values read from it wait here until the batch is full.
    struct Use {
        bool ignored = true;
        std::vector<double> values{};
        std::size_t channel = kTime;  ///< channel in the batch
        double factor = 1;
        std::size_t noValues = 0;
        bool stamps = false;  ///< the column holds dates and times
        static constexpr std::size_t kTime = static_cast<std::size_t>(-1);
        static constexpr std::size_t kOther = kTime / 2;  ///< added to the number of a further time column
    };
    /// Reads rows from text_ until the batch is full or the block is used up.
    [[nodiscard]] Result<void> takeRows();
    /// Reads the row at `text` into batch row `row`. Returns the start of the next line; null if the row is not plain.
    [[nodiscard]] const char* takePlainRow(const char* text, const char* end, std::size_t row);
    [[nodiscard]] const char* takeStampOf(const char* text, const char* end, double& value) const;
    [[nodiscard]] Result<void> takeFields(std::string_view line, std::size_t row);
    /// Moves the waiting values into the batch.
    void deliver();

    const CsvLayout& layout_;
    const char separator_;
    const char point_;
    TextBlocks& blocks_;
    std::vector<Use> uses_;
    RowBatch batch_;
    std::vector<std::string_view> fields_;
    std::string_view text_;  ///< rest of the block
    std::size_t line_;       ///< line number of the text's first byte
    std::size_t skip_;       ///< bytes to skip before the first row
    std::uint64_t bytes_ = 0;
    std::uint64_t rows_ = 0;
    bool sawInfinite_ = false;
    std::size_t endLine_ = 0;
};

// Reads a capture from a table with a known layout.

/// Reads all rows in one pass, holding only the samples and one block. If a long table's times are not plainly even,
/// they are read again and held. Rows at the end without any value are dropped; other missing values are NaN. Both give
/// a warning; so do stamps that are coarse or stray, or that disagree with the header's interval. Errors: Io, Stopped;
/// ParseError naming the line if a field or row is wrong, a time is missing or time does not rise in even steps (within
/// half a step), and for fewer than two rows.
[[nodiscard]] Result<CaptureReading> readCsvTable(TextBlocks& blocks, const CsvHead& head, const CsvLayout& layout,
                                                  const ReadWatch& watch);

}  // namespace tacto
