// CsvTimes.h - rate and start of a table from its stamps, its header or the options, in that order of trust reversed:
// what the user says, then what the header states and the stamps do not contradict, then the stamps.
//
// Thread-safety: none; one owner.
#pragma once

#include "core/formats/CsvLayout.h"
#include "core/formats/EvenSteps.h"
#include "core/formats/TextBlocks.h"

namespace tacto {

class CsvTimes {
public:
    explicit CsvTimes(const CsvLayout& layout) noexcept : factor_(layout.timeFactor) {}

    /// Stamps as the file has them; `lines` are theirs.
    void add(std::span<const double> stamps, std::span<const std::size_t> lines);

    /// Remembers what was added so far, for dropBehindKept().
    void keep() noexcept {
        kept_ = even_.mark();
        keptMissingLine_ = missingLine_;
    }
    void dropBehindKept() {
        even_.takeBackTo(kept_);
        missingLine_ = keptMissingLine_;
    }

    /// Sets rate and start, with warnings. `rows` are those with values; `blocks` is read again where the stamps do not
    /// fit, to name the line.
    /// Errors: ParseError naming the line where a time is missing or does not rise evenly; Io, Stopped.
    [[nodiscard]] Result<void> into(CaptureReading& reading, TextBlocks& blocks, const CsvHead& head,
                                    const CsvLayout& layout, std::size_t rows, const ReadWatch& watch) const;

private:
    [[nodiscard]] Result<void> setTimes(CaptureReading& reading, TextBlocks& blocks, const CsvHead& head,
                                        const CsvLayout& layout, std::size_t rows, const ReadWatch& watch) const;

    double factor_;
    EvenSteps even_;
    std::size_t missingLine_ = 0;
    EvenSteps::Mark kept_;
    std::size_t keptMissingLine_ = 0;
};

}  // namespace tacto
