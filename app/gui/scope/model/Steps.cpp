#include "app/gui/scope/model/Steps.h"

#include <array>
#include <cmath>

namespace tacto::gui {

namespace {

constexpr std::array<int, 3> kMantissas{1, 2, 5};

/// Step number n: 0 is 1, 1 is 2, 2 is 5, 3 is 10, -1 is 0.5. Decades are powers of ten made exactly, so that a step
/// is the same number however it is reached.
double stepNumber(int n) {
    const int decade = n >= 0 ? n / 3 : -((2 - n) / 3);
    const auto mantissa = static_cast<double>(kMantissas[static_cast<std::size_t>(n - 3 * decade)]);
    return decade >= 0 ? mantissa * std::pow(10.0, decade) : mantissa / std::pow(10.0, -decade);
}

int numberNotBelow(double value) {
    int n = 3 * static_cast<int>(std::floor(std::log10(value))) - 1;
    while (stepNumber(n) < value * (1 - 1e-9)) ++n;
    return n;
}

}  // namespace

double stepNotBelow(double value) { return stepNumber(numberNotBelow(value)); }

double stepAlong(double value, int steps) {
    const int upper = numberNotBelow(value);
    const bool between = stepNumber(upper) > value * (1 + 1e-9);
    return stepNumber(upper + steps - (between && steps > 0 ? 1 : 0));
}

std::vector<double> stepsBetween(double low, double high) {
    std::vector<double> steps;
    for (int n = numberNotBelow(low); stepNumber(n) <= high * (1 + 1e-9); ++n) steps.push_back(stepNumber(n));
    return steps;
}

}  // namespace tacto::gui
