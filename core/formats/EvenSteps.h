// EvenSteps.h - whether time stamps rise in even steps, decided while they pass by, in two numbers per 256 of them.
//
// Stamps are compared with a straight line of the step that the first of them have. The line that counts, from the
// first stamp to the last, is known only at the end; how far it has moved away from the other by each stretch is known
// then too, and the stretch's lowest and highest stamp say whether all of it is within the tolerance.
//
// Thread-safety: none; one owner.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace tacto {

class EvenSteps {
public:
    /// Where the stamps stood at some time: those behind it can be taken back.
    struct Mark {
        std::size_t count = 0;
        double last = 0;
        double low = 0;
        double high = 0;
    };

    /// Adds stamps, each times `factor`.
    void add(std::span<const double> stamps, double factor) {
        if (count_ == 0 && stamps.size() > 1) {
            reference_ = (stamps.back() - stamps.front()) * factor / static_cast<double>(stamps.size() - 1);
        }
        while (!stamps.empty()) {
            if (count_ == 0) first_ = stamps.front() * factor;
            if (count_ == 1 && reference_ == 0) reference_ = stamps.front() * factor - first_;
            const auto here = stamps.first(std::min(stamps.size(), kStretch - count_ % kStretch));
            double low = low_, high = high_;
            auto k = static_cast<double>(count_);
            for (const double stamp : here) {
                const double off = stamp * factor - first_ - k * reference_;
                // Written so that a NaN stays and fails the comparison at the end.
                low = low <= off ? low : off;
                high = high >= off ? high : off;
                k += 1;
            }
            low_ = low;
            high_ = high;
            last_ = here.back() * factor;
            count_ += here.size();
            if (count_ % kStretch == 0) close();
            stamps = stamps.subspan(here.size());
        }
    }

    [[nodiscard]] double first() const noexcept { return first_; }
    [[nodiscard]] double last() const noexcept { return last_; }
    /// Of at least two stamps.
    [[nodiscard]] double step() const noexcept { return (last_ - first_) / static_cast<double>(count_ - 1); }

    /// True when every stamp k is surely within `tolerance` steps of first + k * step. False when one may not be: then
    /// the stamps have to be looked at again.
    [[nodiscard]] bool surelyFits(double step, double tolerance) const noexcept {
        if (!(step > 0)) return false;
        const double drift = step - reference_;
        const auto fits = [&](std::size_t stretch, double low, double high) {
            const double begun = static_cast<double>(stretch * kStretch) * drift;
            const double ended = static_cast<double>(stretch * kStretch + kStretch - 1) * drift;
            return low - std::max(begun, ended) >= -tolerance * step &&
                   high - std::min(begun, ended) <= tolerance * step;
        };
        for (std::size_t i = 0; i < lows_.size(); ++i) {
            if (!fits(i, lows_[i], highs_[i])) return false;
        }
        return count_ % kStretch == 0 || fits(lows_.size(), low_, high_);
    }

    [[nodiscard]] Mark mark() const noexcept { return {count_, last_, low_, high_}; }
    void takeBackTo(const Mark& mark) {
        count_ = mark.count;
        last_ = mark.last;
        low_ = mark.low;
        high_ = mark.high;
        lows_.resize(count_ / kStretch);
        highs_.resize(count_ / kStretch);
    }

private:
    static constexpr std::size_t kStretch = 256;
    void close() {
        lows_.push_back(low_);
        highs_.push_back(high_);
        low_ = kNone;
        high_ = -kNone;
    }

    static constexpr double kNone = 1e308;
    double first_ = 0;
    double last_ = 0;
    double reference_ = 0;  ///< the step of the line that stamps are compared with
    double low_ = kNone;    ///< of the stretch at hand, against that line
    double high_ = -kNone;
    std::vector<double> lows_, highs_;  ///< of the stretches before it
    std::size_t count_ = 0;
};

}  // namespace tacto
