#include "core/analysis/statistics/InformationTransfer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace tacto {

double informationTransfer(std::span<const std::vector<double>> table) {
    double total = 0;
    std::vector<double> rows(table.size(), 0.0), columns;
    for (std::size_t i = 0; i < table.size(); ++i) {
        columns.resize(std::max(columns.size(), table[i].size()), 0.0);
        for (std::size_t j = 0; j < table[i].size(); ++j) {
            rows[i] += table[i][j];
            columns[j] += table[i][j];
            total += table[i][j];
        }
    }
    if (!(total > 0)) return std::numeric_limits<double>::quiet_NaN();
    double bits = 0;
    for (std::size_t i = 0; i < table.size(); ++i) {
        for (std::size_t j = 0; j < table[i].size(); ++j) {
            if (table[i][j] > 0) bits += table[i][j] / total * std::log2(table[i][j] * total / (rows[i] * columns[j]));
        }
    }
    return bits;
}

double informationBias(std::size_t rows, std::size_t columns, std::size_t n) noexcept {
    if (n == 0 || rows == 0 || columns == 0) return std::numeric_limits<double>::quiet_NaN();
    return static_cast<double>((rows - 1) * (columns - 1)) / (2 * static_cast<double>(n) * std::numbers::ln2);
}

}  // namespace tacto
