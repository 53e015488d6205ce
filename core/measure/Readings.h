// Readings.h - the readings of one quantity, from many pulses or trains. Private to core/measure.
//
// Thread-safety: none; one owner.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "core/base/LargeReserve.h"
#include "core/base/Statistics.h"

namespace tacto {

class Readings {
public:
    /// `most`: how many will be added at most.
    explicit Readings(std::size_t most) { reserveLarge(values_, most); }

    /// What was not measured (NaN) is left out.
    void add(double reading) {
        if (!std::isnan(reading)) values_.push_back(reading);
    }
    [[nodiscard]] Statistics statistics() const { return statisticsOf(values_); }

private:
    std::vector<double> values_;
};

}  // namespace tacto
