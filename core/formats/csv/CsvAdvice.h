// CsvAdvice.h - suggests options that would read a table that was refused.
#pragma once

#include <functional>

#include "core/formats/csv/CsvLayout.h"

namespace tacto {

/// A set of options that may be able to read a table.
struct CsvAdvice {
    ReadOptions options;
    /// The options to add, as typed, and their effect: "--time-column 1 reads it".
    std::string words;
};

/// End of the sentences about uneven times. They already suggest a rate if one may help.
constexpr std::string_view kRateInstead = "; where the samples are even all the same, --sample-rate ";

/// Returns options to try on the table that begins with `text` (whole lines) and has `dialect`, the smallest change
/// first. If no time column was found, they include a rate: the rate that the file states, or else 1 Hz, with the word
/// HZ in the text.
[[nodiscard]] std::vector<CsvAdvice> adviceToTry(std::string_view text, CsvDialect dialect, const ReadOptions& given,
                                                 std::string_view file);

}  // namespace tacto
