#include "core/acquisition/Standstill.h"

#include <cmath>
#include <cstring>

#include "core/acquisition/StreamHealth.h"

namespace tacto {

void Standstill::feed(const SampleBlock& block) noexcept {
    const std::size_t bytes = last_.size() * sizeof(double);
    for (std::size_t i = 0; i < block.t_s.size(); ++i) {
        const double* values = block.values.data() + i * last_.size();
        newest_s_ = block.t_s[i];
        if (std::memcmp(values, last_.data(), bytes) == 0) {
            ++repeats_;
            continue;
        }
        std::memcpy(last_.data(), values, bytes);
        repeated_ += repeats_;
        ++changed_;
        repeats_ = 0;
        since_s_ = newest_s_;
    }
}

std::optional<double> Standstill::since() const noexcept {
    constexpr double kByChance = 1e-9;
    if (!(newest_s_ - since_s_ > StreamHealth::kStale_s)) return std::nullopt;
    const double share = static_cast<double>(repeated_ + 1) / static_cast<double>(repeated_ + changed_ + 2);
    if (static_cast<double>(repeats_) * std::log(share) > std::log(kByChance)) return std::nullopt;
    return since_s_;
}

}  // namespace tacto
