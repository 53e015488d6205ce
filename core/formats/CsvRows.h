// CsvRows.h - the rows of a table, some thousands at a time.
//
// Most rows are nothing but numbers of a few digits. Those are converted between field ends that were found for many
// rows at once; numbers with exponents and blanks take a second way, and what is anything else (empty fields, quotes,
// nan, blank lines) a third. All mean the same.
//
// Thread-safety: none; one owner.
#pragma once

#include <cstdint>

#include "core/formats/CsvLayout.h"
#include "core/formats/FieldEnds.h"
#include "core/formats/TextBlocks.h"

namespace tacto {

/// Columns that are asked for, of consecutive rows.
struct RowBatch {
    static constexpr std::size_t kRows = 4096;
    std::size_t rows = 0;
    bool complete = false;                     ///< every value is known to be finite
    std::vector<double> times;                 ///< as the file has them; empty where no column is one
    std::vector<std::vector<float>> channels;  ///< in V, A or 1; not finite where the field is empty or says so
    std::vector<std::size_t> lines;            ///< in the file, from 1
};

class CsvRows {
public:
    /// `layout` and `blocks` must outlive this; `blocks` stands at its beginning.
    CsvRows(const CsvLayout& layout, char separator, char point, TextBlocks& blocks);

    /// The next rows; none at the end. Looks at `watch` once in every block.
    /// Errors: Io, Stopped; ParseError for a field that is no number, a row too short or too long.
    [[nodiscard]] Result<const RowBatch*> next(const ReadWatch& watch);

    /// Bytes of text per row so far, for an estimate of what is to come; 0 before the first.
    [[nodiscard]] double bytesPerRow() const noexcept;
    /// Whether some value was infinite: beyond the instrument's range, not missing.
    [[nodiscard]] bool sawInfinite() const noexcept { return sawInfinite_; }

private:
    /// A column of the file; what is read of it waits here until the batch is full.
    struct Use {
        bool ignored = true;
        std::vector<double> values{};
        std::size_t channel = kTime;  ///< in the batch
        double factor = 1;
        static constexpr std::size_t kTime = static_cast<std::size_t>(-1);
    };
    /// Takes rows from text_ until the batch is full or the block is used up.
    [[nodiscard]] Result<void> takeRows();
    /// Takes rows of short numbers from `text` on, as far as they go; where the first other one begins.
    [[nodiscard]] const char* takeShortRows(const char* text, const char* end);
    /// Reads the row at `text` into batch row `row`; the start of the next line, or null when it is no plain row.
    [[nodiscard]] const char* takePlainRow(const char* text, const char* end, std::size_t row);
    [[nodiscard]] Result<void> takeFields(std::string_view line, std::size_t row);
    /// The values that wait, into the batch.
    void deliver();

    const CsvLayout& layout_;
    const char separator_;
    const char point_;
    TextBlocks& blocks_;
    std::vector<Use> uses_;
    std::vector<double*> into_;  ///< of each column, its values; none is null
    FieldEnds ends_;
    RowBatch batch_;
    std::vector<std::string_view> fields_;
    std::string_view text_;  ///< of the block, not taken yet
    std::size_t line_;       ///< of the text's first byte
    std::size_t skip_;       ///< bytes before the first row
    std::uint64_t bytes_ = 0;
    std::uint64_t rows_ = 0;
    bool anyIgnored_ = false;
    bool ordinaryFactors_ = true;  ///< no short number leaves the range of a float by them
    bool sawInfinite_ = false;
};

}  // namespace tacto
