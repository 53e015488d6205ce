// WrittenTables.h - draws random tables as instruments and people write them, and keeps the numbers written.
//
// Thread-safety: pure functions.
#pragma once

#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "core/base/Random.h"
#include "core/formats/CaptureFormat.h"

namespace tacto::test {

struct WrittenTable {
    std::string text;  ///< content of the file; line ends and encoding are random too
    std::string format;
    double rate_hz = 0;
    double start_s = 0;
    struct Channel {
        std::string name;
        std::string unit;            ///< V, A or ""
        std::vector<double> values;  ///< in this unit
    };
    std::vector<Channel> channels;
    std::vector<std::string> leftOut;  ///< columns that a warning must name
};

/// Returns `text` with line ends and an encoding in common use, if the encoding has all its characters.
[[nodiscard]] std::string inSomeEncoding(const std::string& text, Random& random);

/// Draws a table with names, units in many spellings, separators and decimal signs; sometimes with a column of another
/// quantity, of text or of row numbers.
[[nodiscard]] WrittenTable plainTable(Random& random);
[[nodiscard]] WrittenTable tektronixBesideKeys(Random& random);
[[nodiscard]] WrittenTable gwInstekWithoutMode(Random& random);
[[nodiscard]] WrittenTable rigolWithoutIndex(Random& random);
[[nodiscard]] WrittenTable dsViewOscilloscope(Random& random);
[[nodiscard]] WrittenTable picoScopeOfSomeLanguage(Random& random);
[[nodiscard]] WrittenTable rohdeSchwarz(Random& random);
[[nodiscard]] WrittenTable timesForEachChannel(Random& random);
[[nodiscard]] WrittenTable stampedTable(Random& random);

/// Draws any of these tables.
[[nodiscard]] WrittenTable anyWrittenTable(Random& random);

/// Expects the written rate, start and channels, and a warning for each column that was left out.
void expectAsWritten(const Result<CaptureReading>& read, const WrittenTable& table);

}  // namespace tacto::test
