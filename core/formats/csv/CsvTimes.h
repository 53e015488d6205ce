// CsvTimes.h - finds the rate and start of a table: from the options, else from the header if the stamps agree, else
// from the stamps.
//
// The stamps of a long table are not kept, only bounds on their distance from even steps. If these bounds do not show
// that the steps are even, the stamps are read again and kept.
//
// Thread-safety: none; one owner.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/formats/CaptureFormat.h"
#include "core/formats/csv/CsvLayout.h"

namespace tacto {

/// Bounds the distance of stamps from a straight line. It stores the extremes of runs of stamps: a few bits per stamp.
class LineOfStamps {
public:
    /// The line begins at `first` and rises by `step`, which must be close to the lines to be compared later.
    LineOfStamps(double first, double step) noexcept : first_(first), step_(step) {}

    /// Adds the stamp with this index; indices must rise.
    void add(std::size_t index, double stamp);
    /// Returns an upper bound for a stamp's distance from the line that rises by `step`, or infinity if unknown.
    [[nodiscard]] double farthestAtMost(double step) const noexcept;

    /// Ends a run and returns the number of runs, for a later dropBehind().
    [[nodiscard]] std::size_t mark() noexcept;
    void dropBehind(std::size_t mark) { runs_.resize(mark, {}); }

private:
    static constexpr std::size_t kRun = 256;
    struct Run {
        std::size_t from = 0, to = 0;
        double low = 0, high = 0;  ///< distances above the line
    };
    double first_;
    double step_;
    std::vector<Run> runs_;
    bool ended_ = true;  // true if the last run has ended
};

class CsvTimes {
public:
    /// All stamps of a table up to this length are kept.
    static constexpr std::size_t kKept = 4096;

    explicit CsvTimes(const CsvLayout& layout) noexcept : layout_(layout) {}

    /// Adds stamps as in the file, with their line numbers.
    void add(std::span<const double> stamps, std::span<const std::size_t> lines);

    /// Remembers the present state for dropBehindKept().
    void keep() noexcept;
    void dropBehindKept();

    /// Returns whether into() needs every stamp, as they are not plainly even. If so, add all again from the start.
    [[nodiscard]] bool needsAll() const;
    void startAgain();
    /// Adds stamps again; ignores those after the last valid row.
    void addAgain(std::span<const double> stamps);
    /// Returns whether every stamp of a valid row is held.
    [[nodiscard]] bool hasAll() const noexcept { return stamps_.size() == seen_.rows; }
    /// Returns whether every stamp agrees with the header's interval.
    [[nodiscard]] bool keepToStated() const noexcept;
    /// Returns the stamps of valid rows, in seconds, or in samples if they are an index.
    [[nodiscard]] std::span<const double> stamps() const noexcept { return stamps_; }

    /// Sets rate and start, with warnings. At least two stamps must have been added, unless the layout has none;
    /// needsAll() must be false. Errors: ParseError naming `file` and the line at which a time is missing or does not
    /// rise evenly.
    [[nodiscard]] Result<void> into(CaptureReading& reading, const std::string& file) const;

private:
    static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
    /// Results of all stamps so far.
    struct Seen {
        std::size_t rows = 0;
        double last = 0;
        double farthestStated = 0;  ///< largest distance from the line with the header's interval
        std::size_t mark = 0;       ///< a mark in line_
    };
    /// Returns the header's interval, if the stamps are compared with it.
    [[nodiscard]] std::optional<double> stated() const noexcept;
    [[nodiscard]] double step() const noexcept {
        return (seen_.last - stamps_.front()) / static_cast<double>(seen_.rows - 1);
    }
    [[nodiscard]] Result<void> setTimes(CaptureReading& reading, const std::string& file) const;
    [[nodiscard]] std::size_t lineOf(std::size_t row) const;

    const CsvLayout& layout_;
    std::vector<double> stamps_;  ///< in s or samples: the first kKept stamps, or all of them
    Seen seen_, kept_;
    std::optional<LineOfStamps> line_;  ///< line through the stamps after the first kKept
    /// Row and line number, if the line does not directly follow the previous row's.
    std::vector<std::pair<std::size_t, std::size_t>> jumps_;
    std::size_t nextLine_ = 0;
    std::size_t missingRow_ = kNone;  ///< first row without a finite stamp
};

}  // namespace tacto
