// CsvAdvice.h - which options would read a table that was refused.
#pragma once

#include <functional>

#include "core/formats/csv/CsvLayout.h"

namespace tacto {

/// A set of options that may read a table.
struct CsvAdvice {
    ReadOptions options;
    /// What is added to the options given, as it is typed, and what it means: "--time-column 1 reads it".
    std::string words;
};

/// How the sentences about uneven times end: they themselves advise a rate where that is meant.
constexpr std::string_view kRateInstead = "; where the samples are even all the same, --sample-rate ";

/// Options worth a try on the table that begins with `text` (whole lines) and has `dialect`, the smallest change first.
/// A rate is among them where no column of times was found: the one that the file states, else the word HZ stands for
/// it, and the options hold 1 Hz.
[[nodiscard]] std::vector<CsvAdvice> adviceToTry(std::string_view text, CsvDialect dialect, const ReadOptions& given,
                                                 std::string_view file);

}  // namespace tacto
