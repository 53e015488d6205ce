// TextPlot.h - draws a curve with characters for a terminal, with axes and units, at most as wide as the caller asks.
// Uses only ASCII, so that one byte is one column on every terminal.
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
    double step = 1;                ///< x between two values; the first is at 0; each value holds until the next
    std::span<const float> values;  ///< 0 or more; a negative value or NaN leaves its place blank
    double mark = std::numeric_limits<double>::quiet_NaN();  ///< an x to mark with a pointer from below; NaN: none
    std::string markText;                                    ///< next to the pointer
};

inline constexpr int kMinColumns = 40;
inline constexpr int kMaxColumns = 80;

/// Returns lines ending in '\n', none longer than `columns` (limited to 40 to 80), with `rows` of curve, at least 3.
/// The y axis ends at the first of 1, 2, 2.5, 4, 5, 8 times a power of ten that holds every value.
[[nodiscard]] std::string draw(const TextPlot& plot, int columns = kMaxColumns, int rows = 13);

}  // namespace tacto::cli
