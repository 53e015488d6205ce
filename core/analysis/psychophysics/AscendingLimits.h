// AscendingLimits.h - three series of rising levels until the participant says "too strong" (pilot.md section 4).
//
// Safety comes first. The threshold is only rough, because anticipation and habituation shift it. Each series starts
// with 1 to 3 empty presentations. Then the level rises by one device step or by 5 % (rounded down to the grid),
// whichever is more, but by at most 1 mA. One of every five later presentations, chosen from the seed, is empty. If an
// empty one was felt, the last level is presented again and its new answer replaces the previous one; a second felt
// empty presentation marks the series. "Too strong" ends the series after any presentation and keeps all later levels
// below it. After an empty presentation, the word applies to the last level, and the series is marked.
// Perhaps the participant did not mean it: at half or less of a level that was tolerated before, or while nothing was
// felt in the series, the caller asks once. If they did not, the answer is taken back and the level is presented again.
//
// The same settings, seed and answers give the same presentations, so a recorded series can be replayed.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "core/analysis/psychophysics/LevelGrid.h"

namespace tacto {

/// The words a participant can use for one presentation.
enum class StrengthWord { Nothing, Weak, Strong, TooStrong };
inline constexpr Word<StrengthWord> kStrengthWords[] = {{"nothing", StrengthWord::Nothing},
                                                        {"weak", StrengthWord::Weak},
                                                        {"strong", StrengthWord::Strong},
                                                        {"too-strong", StrengthWord::TooStrong}};
[[nodiscard]] constexpr std::string_view nameOf(StrengthWord word) noexcept { return wordFor(kStrengthWords, word); }
/// Errors: InvalidArgument naming the text and the accepted words.
[[nodiscard]] Result<StrengthWord> strengthWordFrom(std::string_view text);

enum class SeriesEnd { Open, TooStrong, Ceiling, Stop };
inline constexpr Word<SeriesEnd> kSeriesEnds[] = {{"open", SeriesEnd::Open},
                                                  {"too-strong", SeriesEnd::TooStrong},
                                                  {"ceiling", SeriesEnd::Ceiling},
                                                  {"stop", SeriesEnd::Stop}};
[[nodiscard]] constexpr std::string_view nameOf(SeriesEnd end) noexcept { return wordFor(kSeriesEnds, end); }

/// Three trains at the shortest interval, 1 to 2 s after the previous presentation. Empty ones last equally long.
struct AscendingPresentation {
    std::size_t number = 0;  ///< from 1, over all series
    std::size_t series = 0;  ///< from 1
    double level = 0;        ///< 0: an empty presentation
    [[nodiscard]] bool empty() const noexcept { return level == 0; }
};

struct AscendingSeries {
    double felt = std::numeric_limits<double>::quiet_NaN();  ///< first level that was felt; NaN: none
    double tooStrong = std::numeric_limits<double>::quiet_NaN();
    double highest = 0;  ///< the highest level that was answered
    SeriesEnd endedBy = SeriesEnd::Open;
    LevelLimit ceiling = LevelLimit::Device;  ///< which ceiling, if a ceiling ended the series
    std::size_t feltEmpty = 0;
    [[nodiscard]] bool marked() const noexcept { return feltEmpty >= 2; }
};

struct AscendingResult {
    double felt = std::numeric_limits<double>::quiet_NaN();  ///< median of the series' first felt levels; NaN: none
    /// Lowest level called too strong, else the highest level that was answered; NaN before the first answer.
    double tooStrong = std::numeric_limits<double>::quiet_NaN();
    bool saidTooStrong = false;
    std::vector<AscendingSeries> series;
};

class AscendingLimits {
public:
    static constexpr std::size_t kSeries = 3;
    static constexpr double kFarBelow = 0.5;  ///< share of the highest tolerated level

    /// Errors: InvalidArgument for a grid of currents with a step above 1 mA.
    [[nodiscard]] static Result<AscendingLimits> create(const LevelGrid& grid, std::uint64_t seed);

    /// The next presentation, unchanged until it is answered; nothing if done().
    [[nodiscard]] std::optional<AscendingPresentation> next() const;
    /// Errors: InvalidArgument for a value that is not a word, or if no answer is expected; nothing has changed then.
    [[nodiscard]] Result<void> answer(StrengthWord word);
    /// True if "too strong" about the open presentation would be doubtful; false if it was taken back at this level.
    [[nodiscard]] bool doubtful() const noexcept;
    /// Reports that the participant said "too strong" about the open presentation by a slip. No effect if done().
    void takeBack();
    /// Reports that `by` refused the presentation: its ceiling ends the series. No effect if done().
    void refused(LevelLimit by);
    /// Reports that the participant or the operator stopped: the series ends and the open presentation is not
    /// evaluated. No effect if done().
    void stop();
    [[nodiscard]] bool done() const noexcept {
        return result_.series.size() == kSeries && current().endedBy != SeriesEnd::Open;
    }
    /// Returns the result of the answers given so far.
    [[nodiscard]] AscendingResult result() const;

private:
    AscendingLimits(const LevelGrid& grid, std::uint64_t seed);
    [[nodiscard]] const AscendingSeries& current() const noexcept { return result_.series.back(); }
    [[nodiscard]] AscendingSeries& current() noexcept { return result_.series.back(); }
    [[nodiscard]] std::size_t above(std::size_t index) const noexcept;
    void beginSeries();
    void chooseEmptyPlace();
    void choose();
    void advance();
    /// Index of the level that "too strong" is about; 0: none.
    [[nodiscard]] std::size_t meant() const noexcept { return index_ > 0 ? index_ : last_; }
    void answerEmpty(StrengthWord word);
    void answerLevel(StrengthWord word);
    void calledTooStrong(std::size_t index);
    void end(SeriesEnd how);

    LevelGrid grid_;
    std::uint64_t seed_;
    std::size_t ceiling_;   // Highest allowed index; stays below what was too strong
    LevelLimit limitedBy_;  // What sets ceiling_
    AscendingResult result_;
    std::size_t number_ = 1;      // Number of the open presentation
    std::size_t index_ = 0;       // Index of its level; 0: empty
    std::size_t last_ = 0;        // Index of the last level of this series
    std::size_t first_ = 0;       // Index of the first level felt in this series; 0: none
    std::size_t leading_ = 0;     // Empty presentations still to come at the beginning
    std::size_t inFive_ = 0;      // Position in the current group of five
    std::size_t emptyPlace_ = 0;  // Position of the empty one in the group of five
    std::size_t fives_ = 0;
    bool repeat_ = false;                   // true if `last_` must be presented again
    std::size_t tolerated_ = 0;             // Highest index, of all series, that was not too strong
    std::optional<std::size_t> takenBack_;  // Index at which this series' last "too strong" was taken back
};

}  // namespace tacto
