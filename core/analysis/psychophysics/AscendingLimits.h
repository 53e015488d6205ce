// AscendingLimits.h - three series of rising levels, until the participant says "too strong" (pilot.md section 4).
//
// Safety comes first; the threshold is rough, because anticipation and habituation shift it. Each series starts from
// nothing: 1 to 3 empty presentations, then up by one device step, or by 5 % of the level (rounded down to the grid)
// where that is more, at most 1 mA. In each five later presentations one, drawn from the seed, is empty. After an empty
// one that was felt the last level is presented again, and its new answer replaces the one before; a second felt empty
// one marks the series. "Too strong" ends the series, whatever was presented, and keeps every later level below it;
// said about an empty presentation it counts for the last level of the series and marks it.
//
// The same settings, seed and answers give the same presentations, so a record replays.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "core/analysis/psychophysics/LevelGrid.h"

namespace tacto {

/// A participant's words for one presentation.
enum class StrengthWord { Nothing, Weak, Strong, TooStrong };
inline constexpr Word<StrengthWord> kStrengthWords[] = {{"nothing", StrengthWord::Nothing},
                                                        {"weak", StrengthWord::Weak},
                                                        {"strong", StrengthWord::Strong},
                                                        {"too-strong", StrengthWord::TooStrong}};
[[nodiscard]] constexpr std::string_view nameOf(StrengthWord word) noexcept { return wordFor(kStrengthWords, word); }
/// Errors: InvalidArgument naming the text and the words.
[[nodiscard]] Result<StrengthWord> strengthWordFrom(std::string_view text);

enum class SeriesEnd { Open, TooStrong, Ceiling, Stop };
inline constexpr Word<SeriesEnd> kSeriesEnds[] = {{"open", SeriesEnd::Open},
                                                  {"too-strong", SeriesEnd::TooStrong},
                                                  {"ceiling", SeriesEnd::Ceiling},
                                                  {"stop", SeriesEnd::Stop}};
[[nodiscard]] constexpr std::string_view nameOf(SeriesEnd end) noexcept { return wordFor(kSeriesEnds, end); }

/// Three trains at the shortest interval, 1 to 2 s after the one before; an empty one is as long.
struct AscendingPresentation {
    std::size_t number = 0;  ///< from 1, over all series
    std::size_t series = 0;  ///< from 1
    double level = 0;        ///< 0: empty
    [[nodiscard]] bool empty() const noexcept { return level == 0; }
};

struct AscendingSeries {
    double felt = std::numeric_limits<double>::quiet_NaN();  ///< first level felt; NaN: none
    double tooStrong = std::numeric_limits<double>::quiet_NaN();
    double highest = 0;  ///< the highest level that was answered
    SeriesEnd endedBy = SeriesEnd::Open;
    LevelLimit ceiling = LevelLimit::Device;  ///< the kind of ceiling, where it ended the series
    std::size_t feltEmpty = 0;
    [[nodiscard]] bool marked() const noexcept { return feltEmpty >= 2; }
};

struct AscendingResult {
    double felt = std::numeric_limits<double>::quiet_NaN();  ///< F: median of the series'; NaN: nothing was felt
    /// U: lowest level called too strong, else the highest that was answered; NaN before any was.
    double tooStrong = std::numeric_limits<double>::quiet_NaN();
    bool saidTooStrong = false;
    std::vector<AscendingSeries> series;
};

class AscendingLimits {
public:
    static constexpr std::size_t kSeries = 3;

    /// Errors: InvalidArgument for a grid of currents whose step exceeds 1 mA, naming it.
    [[nodiscard]] static Result<AscendingLimits> create(const LevelGrid& grid, std::uint64_t seed);

    /// The next presentation: the same until it is answered; nothing when done().
    [[nodiscard]] std::optional<AscendingPresentation> next() const;
    /// Errors: InvalidArgument for a value that is not a word, or when nothing is asked for; nothing has changed then.
    [[nodiscard]] Result<void> answer(StrengthWord word);
    /// The presentation was refused by `by`: the series ends at its ceiling. Without effect when done().
    void refused(LevelLimit by);
    /// The participant, or the operator, stopped: the series ends, the presentation is void. Without effect when
    /// done().
    void stop();
    [[nodiscard]] bool done() const noexcept {
        return result_.series.size() == kSeries && current().endedBy != SeriesEnd::Open;
    }
    /// The result of the answers so far.
    [[nodiscard]] AscendingResult result() const;

private:
    AscendingLimits(const LevelGrid& grid, std::uint64_t seed);
    [[nodiscard]] const AscendingSeries& current() const noexcept { return result_.series.back(); }
    [[nodiscard]] AscendingSeries& current() noexcept { return result_.series.back(); }
    [[nodiscard]] std::size_t above(std::size_t index) const noexcept;
    void beginSeries();
    void chooseEmptyPlace();
    void choose();
    void answerEmpty(StrengthWord word);
    void answerLevel(StrengthWord word);
    void calledTooStrong(std::size_t index);
    void end(SeriesEnd how);

    LevelGrid grid_;
    std::uint64_t seed_;
    std::size_t ceiling_;   // Index; falls to below what was called too strong
    LevelLimit limitedBy_;  // the reason for ceiling_
    AscendingResult result_;
    std::size_t number_ = 1;      // The presentation that is asked for
    std::size_t index_ = 0;       // The level's index; 0: empty
    std::size_t last_ = 0;        // Last level of this series
    std::size_t first_ = 0;       // First level felt in this series; 0: none
    std::size_t leading_ = 0;     // Empty presentations still due at the beginning
    std::size_t inFive_ = 0;      // Place in the current five
    std::size_t emptyPlace_ = 0;  // Which of the five is empty
    std::size_t fives_ = 0;
    bool repeat_ = false;  // `last_` is presented again
};

}  // namespace tacto
