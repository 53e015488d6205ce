// TextPlot.h - a curve drawn with characters, for a terminal: axes, units, at most as wide as the caller asks. ASCII
// only, so that a column is a byte wherever it is shown.
//
// Thread-safety: pure functions.
#pragma once

#include <limits>
#include <span>
#include <string>

namespace tacto::cli {

struct TextPlot {
    std::string title;              ///< above the y axis, with its unit: "voltage magnitude (V)"
    std::string xTitle;             ///< below the x axis, with its unit: "time (us)"
    double step = 1;                ///< x from one value to the next; the first is at 0, and each holds until the next
    std::span<const float> values;  ///< 0 or more; one that is negative or no number leaves its place blank
    double mark = std::numeric_limits<double>::quiet_NaN();  ///< an x to point at from below; NaN: none
    std::string markText;                                    ///< beside the pointer
};

inline constexpr int kMinColumns = 40;
inline constexpr int kMaxColumns = 80;

/// The drawing, lines ending in '\n', none longer than `columns` (taken as 40 to 80). `rows` of curve, at least 3. The
/// y axis begins at 0 and ends at the first of 1, 2, 2.5, 4, 5, 8 times a power of ten that holds every value.
[[nodiscard]] std::string draw(const TextPlot& plot, int columns = kMaxColumns, int rows = 13);

}  // namespace tacto::cli
