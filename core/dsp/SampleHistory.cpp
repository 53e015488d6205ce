#include "core/dsp/SampleHistory.h"

#include <algorithm>

namespace tacto {

SampleHistory::SampleHistory(std::size_t width, std::size_t capacity)
    : width_(width), capacity_(std::max<std::size_t>(capacity, 2)), t_(2 * capacity_), values_(2 * capacity_ * width) {}

void SampleHistory::push(double t_s, const double* values) noexcept {
    if (end_ - begin_ == capacity_) ++begin_;
    if (end_ - offset_ == t_.size()) {
        const auto kept = static_cast<std::ptrdiff_t>(begin_ - offset_);
        std::copy(t_.begin() + kept, t_.end(), t_.begin());
        std::copy(values_.begin() + kept * static_cast<std::ptrdiff_t>(width_), values_.end(), values_.begin());
        offset_ = begin_;
    }
    t_[end_ - offset_] = t_s;
    std::copy(values, values + width_, values_.begin() + static_cast<std::ptrdiff_t>((end_ - offset_) * width_));
    ++end_;
}

void SampleHistory::release(std::size_t number) noexcept { begin_ = std::clamp(number, begin_, end_); }

void SampleHistory::clear() noexcept { offset_ = begin_ = end_ = 0; }

}  // namespace tacto
