// CsvTimes.h - rate and start of a table: what the options say, else what the header states and the stamps do not
// contradict, else what the stamps say.
//
// The stamps of a long table are not kept: how far any of them is from an even step is, within bounds. Where those do
// not tell that the steps are even, the stamps are asked for once more, and kept.
//
// Thread-safety: none; one owner.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/formats/CaptureFormat.h"
#include "core/formats/csv/CsvLayout.h"

namespace tacto {

/// Tells how far stamps are from a straight line, by the extremes of runs of them: a few bits for each stamp.
class LineOfStamps {
public:
    /// The line begins at `first` and rises by `step`, which is close to the lines that will be asked about.
    LineOfStamps(double first, double step) noexcept : first_(first), step_(step) {}

    /// The stamp with this index; indices rise.
    void add(std::size_t index, double stamp);
    /// The largest distance of a stamp from the line that rises by `step`, but for rounding; infinite where not known.
    [[nodiscard]] double farthestAtMost(double step) const noexcept;

    /// Ends a run, and says how many there are: what dropBehind() goes back to.
    [[nodiscard]] std::size_t mark() noexcept;
    void dropBehind(std::size_t mark) { runs_.resize(mark, {}); }

private:
    static constexpr std::size_t kRun = 256;
    struct Run {
        std::size_t from = 0, to = 0;
        double low = 0, high = 0;  ///< above the line
    };
    double first_;
    double step_;
    std::vector<Run> runs_;
    bool ended_ = true;  // the last one
};

class CsvTimes {
public:
    /// Stamps of a table that is no longer than this are kept.
    static constexpr std::size_t kKept = 4096;

    explicit CsvTimes(const CsvLayout& layout) noexcept : layout_(layout) {}

    /// Stamps as the file has them; `lines` are theirs.
    void add(std::span<const double> stamps, std::span<const std::size_t> lines);

    /// Remembers what was added so far, for dropBehindKept().
    void keep() noexcept;
    void dropBehindKept();

    /// Whether into() needs every stamp, since they are not plainly even: then all are added again from the first on.
    [[nodiscard]] bool needsAll() const;
    void startAgain();
    /// Ignores stamps behind the last one that counts.
    void addAgain(std::span<const double> stamps);
    /// Whether every stamp that counts is there.
    [[nodiscard]] bool hasAll() const noexcept { return stamps_.size() == seen_.rows; }
    /// Whether every stamp stands where the header's interval puts it.
    [[nodiscard]] bool keepToStated() const noexcept;
    /// In seconds, or in samples where they are an index; for rows that count.
    [[nodiscard]] std::span<const double> stamps() const noexcept { return stamps_; }

    /// Sets rate and start, with warnings. At least two stamps were added, unless the layout has none. Not while
    /// needsAll().
    /// Errors: ParseError naming `file` and the line where a time is missing or does not rise evenly.
    [[nodiscard]] Result<void> into(CaptureReading& reading, const std::string& file) const;

private:
    static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
    /// What all stamps so far showed.
    struct Seen {
        std::size_t rows = 0;
        double last = 0;
        double farthestStated = 0;  ///< from the line that rises by the header's interval
        std::size_t mark = 0;       ///< a mark of line_
    };
    /// The header's interval, where the stamps are held against it.
    [[nodiscard]] std::optional<double> stated() const noexcept;
    [[nodiscard]] double step() const noexcept {
        return (seen_.last - stamps_.front()) / static_cast<double>(seen_.rows - 1);
    }
    [[nodiscard]] Result<void> setTimes(CaptureReading& reading, const std::string& file) const;
    [[nodiscard]] std::size_t lineOf(std::size_t row) const;

    const CsvLayout& layout_;
    std::vector<double> stamps_;  ///< in s or samples: the first kKept stamps, or all
    Seen seen_, kept_;
    std::optional<LineOfStamps> line_;  ///< the line of the stamps behind the first kKept
    /// Row and line, where the line is not the one behind the last row's.
    std::vector<std::pair<std::size_t, std::size_t>> jumps_;
    std::size_t nextLine_ = 0;
    std::size_t missingRow_ = kNone;  ///< the first without a finite stamp
};

}  // namespace tacto
