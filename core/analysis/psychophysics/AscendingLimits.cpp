#include "core/analysis/psychophysics/AscendingLimits.h"

#include <algorithm>
#include <cmath>

#include "core/base/Random.h"

namespace tacto {

namespace {

constexpr double kRise = 0.05;          // share of the level
constexpr double kLargestRise_ma = 1;   // IEC 60601-2-10, 201.12.1.101
constexpr std::size_t kMaxLeading = 3;  // empty presentations at the beginning
constexpr std::size_t kOneEmptyOf = 5;
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

double medianOfLevels(std::vector<double> levels) {
    if (levels.empty()) return kNone;
    std::ranges::sort(levels);
    const std::size_t half = levels.size() / 2;
    return levels.size() % 2 == 1 ? levels[half] : (levels[half - 1] + levels[half]) / 2;
}

}  // namespace

Result<StrengthWord> strengthWordFrom(std::string_view text) {
    if (const auto known = valueFor(kStrengthWords, text)) return *known;
    return invalid("the answer is \"{}\"; nothing, weak, strong or too-strong is accepted", text);
}

Result<AscendingLimits> AscendingLimits::create(const LevelGrid& grid, std::uint64_t seed) {
    if (grid.unit() == LevelUnit::Current && grid.step() > kLargestRise_ma) {
        return invalid("levels would rise by the device's step of {} mA; at most {} mA at a time is accepted",
                       grid.step(), kLargestRise_ma);
    }
    return AscendingLimits(grid, seed);
}

AscendingLimits::AscendingLimits(const LevelGrid& grid, std::uint64_t seed)
    : grid_(grid), seed_(seed), ceiling_(grid.count()), limitedBy_(grid.limitedBy()) {
    beginSeries();
}

void AscendingLimits::beginSeries() {
    result_.series.emplace_back();
    Random random(seed_, fmt::format("ascending limits, series {}", result_.series.size()));
    leading_ = 1 + static_cast<std::size_t>(random.below(kMaxLeading));
    last_ = first_ = inFive_ = fives_ = 0;
    repeat_ = false;
    takenBack_.reset();
    chooseEmptyPlace();
    if (ceiling_ == 0) {
        end(SeriesEnd::Ceiling);
    } else {
        choose();
    }
}

void AscendingLimits::chooseEmptyPlace() {
    Random random(seed_, fmt::format("ascending limits, series {}, five {}", result_.series.size(), fives_));
    emptyPlace_ = static_cast<std::size_t>(random.below(kOneEmptyOf));
}

std::size_t AscendingLimits::above(std::size_t index) const noexcept {
    double rise = kRise * grid_.level(index);
    if (grid_.unit() == LevelUnit::Current) rise = std::min(rise, kLargestRise_ma);
    return std::min(index + std::max<std::size_t>(1, grid_.atOrBelow(rise)), ceiling_);
}

void AscendingLimits::choose() {
    if (leading_ > 0 || inFive_ == emptyPlace_) {
        index_ = 0;
    } else {
        index_ = repeat_ ? last_ : above(last_);
    }
}

std::optional<AscendingPresentation> AscendingLimits::next() const {
    if (done()) return std::nullopt;
    return AscendingPresentation{number_, result_.series.size(), grid_.level(index_)};
}

Result<void> AscendingLimits::answer(StrengthWord word) {
    if (std::ranges::find(kStrengthWords, word, &Word<StrengthWord>::value) == std::end(kStrengthWords)) {
        return invalid(
            "answer number {} is not a word; nothing, weak, strong or too-strong is "
            "accepted",
            static_cast<int>(word));
    }
    if (done()) return invalid("the ascending limits are complete; no answer is accepted");
    const auto series = result_.series.size();
    ++number_;
    if (index_ == 0) {
        answerEmpty(word);
    } else {
        answerLevel(word);
    }
    if (!done() && result_.series.size() == series) advance();
    return {};
}

/// Chooses the next presentation of the series.
void AscendingLimits::advance() {
    if (leading_ > 0) {
        --leading_;
    } else if (++inFive_ == kOneEmptyOf) {
        inFive_ = 0;
        ++fives_;
        chooseEmptyPlace();
    }
    choose();
}

bool AscendingLimits::doubtful() const noexcept {
    if (done() || takenBack_ == meant()) return false;
    return first_ == 0 || grid_.level(meant()) <= kFarBelow * grid_.level(tolerated_);
}

void AscendingLimits::takeBack() {
    if (done()) return;
    ++number_;
    takenBack_ = meant();
    repeat_ = repeat_ || (index_ == 0 && last_ > 0);
    advance();
}

void AscendingLimits::answerEmpty(StrengthWord word) {
    if (word == StrengthWord::Nothing) return;
    ++current().feltEmpty;
    if (word == StrengthWord::TooStrong) {
        current().feltEmpty = std::max<std::size_t>(current().feltEmpty, 2);
        calledTooStrong(last_);
    } else {
        repeat_ = last_ > 0;
    }
}

void AscendingLimits::answerLevel(StrengthWord word) {
    const double level = grid_.level(index_);
    if (repeat_ && first_ == last_) {  // the new answer replaces the previous one
        first_ = 0;
        current().felt = kNone;
    }
    repeat_ = false;
    last_ = index_;
    current().highest = std::max(current().highest, level);
    if (first_ == 0 && word != StrengthWord::Nothing) {
        first_ = index_;
        current().felt = level;
    }
    if (word == StrengthWord::TooStrong) return calledTooStrong(index_);
    tolerated_ = std::max(tolerated_, index_);
    if (index_ == ceiling_) end(SeriesEnd::Ceiling);
}

void AscendingLimits::calledTooStrong(std::size_t index) {
    if (index > 0) {
        current().tooStrong = grid_.level(index);
        ceiling_ = index - 1;
        limitedBy_ = LevelLimit::TooStrong;
    }
    end(SeriesEnd::TooStrong);
}

void AscendingLimits::refused(LevelLimit by) {
    if (done()) return;
    ++number_;
    limitedBy_ = by;
    if (index_ > 0) ceiling_ = index_ - 1;
    end(SeriesEnd::Ceiling);
}

void AscendingLimits::stop() {
    if (done()) return;
    ++number_;
    end(SeriesEnd::Stop);
}

void AscendingLimits::end(SeriesEnd how) {
    current().endedBy = how;
    current().ceiling = limitedBy_;
    if (result_.series.size() < kSeries) beginSeries();
}

AscendingResult AscendingLimits::result() const {
    AscendingResult out = result_;
    std::vector<double> felt;
    double highest = 0;
    for (const auto& series : out.series) {
        if (!std::isnan(series.felt)) felt.push_back(series.felt);
        highest = std::max(highest, series.highest);
        if (std::isnan(series.tooStrong)) continue;
        out.tooStrong = out.saidTooStrong ? std::min(out.tooStrong, series.tooStrong) : series.tooStrong;
        out.saidTooStrong = true;
    }
    if (!out.saidTooStrong && highest > 0) out.tooStrong = highest;
    out.felt = medianOfLevels(std::move(felt));
    return out;
}

}  // namespace tacto
