#include "core/safety/ExposureMeter.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tacto {

namespace {
void add(ExposureMeter::Sums& sums, const BookedTrain& train, Seconds window) noexcept {
    const bool second = window.count() <= 1;
    sums.overRange += second ? train.overRange.in1s : train.overRange.in5s;
    sums.at500 += second ? train.at500.in1s : train.at500.in5s;
    sums.lowestHz = std::min(sums.lowestHz, train.hz);
    ++sums.trains;
}
ExposureMeter::Sums nothing() noexcept {
    ExposureMeter::Sums sums;
    sums.lowestHz = std::numeric_limits<double>::infinity();
    return sums;
}
}  // namespace

ExposureMeter::ExposureMeter(std::size_t capacity) : ring_(std::max<std::size_t>(capacity, 1)) {}

const BookedTrain& ExposureMeter::entry(std::size_t age) const noexcept { return ring_[(first_ + age) % ring_.size()]; }

void ExposureMeter::forget(Instant now, double stretch) noexcept {
    const Instant longest = toInstant(kLongestWindow * stretch);
    while (size_ > 0 && entry(0).latest + longest <= now) {
        first_ = (first_ + 1) % ring_.size();
        --size_;
    }
}

void ExposureMeter::book(const BookedTrain& train) noexcept {
    if (!canBook()) return;
    ring_[(first_ + size_) % ring_.size()] = train;
    ++size_;
}

ExposureMeter::Sums ExposureMeter::couldShare(Seconds window, Instant now, double stretch) const noexcept {
    Sums sums = nothing();
    const Instant span = toInstant(window * stretch);
    for (std::size_t i = 0; i < size_; ++i) {
        const BookedTrain& train = entry(i);
        // A window that ends inside the new train begins at most `span` before now.
        if (train.latest + span > now) add(sums, train, window);
    }
    return sums;
}

ExposureMeter::Sums ExposureMeter::booked(Seconds window, Instant now) const noexcept {
    Sums sums = nothing();
    const Instant span = toInstant(window);
    for (std::size_t i = 0; i < size_; ++i) {
        const BookedTrain& train = entry(i);
        if (train.earliest > now - span && train.earliest <= now) add(sums, train, window);
    }
    return sums;
}

double ExposureMeter::largest(Quantity quantity, JudgedAt judged, Instant now) const noexcept {
    double largest = 0;
    for (std::size_t i = 0; i < size_; ++i) {
        const BookedTrain& train = entry(i);
        if (train.earliest <= now - toInstant(kLongestWindow) || train.earliest > now) continue;
        const double value = (judged == JudgedAt::Ohm500 ? train.at500 : train.overRange).at(quantity);
        if (std::isnan(value) || value > largest) largest = value;  // NaN is kept: nothing compares above it
    }
    return largest;
}

}  // namespace tacto
