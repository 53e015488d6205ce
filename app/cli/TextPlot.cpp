#include "app/cli/TextPlot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <optional>
#include <vector>

#include "core/base/Printable.h"

namespace tacto::cli {

namespace {

/// Returns the smallest round number from `value` upwards: one of `leads` times a power of ten.
double roundUp(double value, std::initializer_list<double> leads) noexcept {
    if (!(value > 0) || !std::isfinite(value)) return 1;
    const double power = std::pow(10.0, std::floor(std::log10(value)));
    for (const double lead : leads) {
        if (value <= lead * power * (1 + 1e-9)) return lead * power;
    }
    return 10 * power;
}

bool isDrawn(float value) noexcept { return std::isfinite(value) && value >= 0; }

class Canvas {
public:
    Canvas(const TextPlot& plot, int columns, int rows)
        : plot_(plot), columns_(std::clamp(columns, kMinColumns, kMaxColumns)), rows_(std::max(rows, 3)) {
        double most = 0;
        for (const float value : plot.values) most = isDrawn(value) ? std::max(most, double{value}) : most;
        top_ = roundUp(most, {1, 2, 2.5, 4, 5, 8});
        labels_ = {"0", fmt::format("{:g}", top_ / 2), fmt::format("{:g}", top_)};
        for (const auto& label : labels_) margin_ = std::max(margin_, static_cast<int>(label.size()));
        width_ = columns_ - margin_ - 2;
    }

    std::string text() const {
        std::string all = clipped(plot_.title) + "\n";
        const auto picture = curve();
        const int middle = (rows_ - 1) / 2;
        for (int row = rows_ - 1; row >= 0; --row) {
            const bool even = rows_ % 2 == 1;  // only then is there a middle row
            const std::string label = row == 0                ? labels_[0]
                                      : row == rows_ - 1      ? labels_[2]
                                      : even && row == middle ? labels_[1]
                                                              : "";
            all += trimmedEnd(fmt::format("{:>{}} {}{}", label, margin_, label.empty() ? '|' : '+',
                                          picture[static_cast<std::size_t>(row)])) +
                   "\n";
        }
        return all + axis();
    }

private:
    double length() const noexcept { return plot_.step * static_cast<double>(plot_.values.size()); }
    int rowOf(float value) const noexcept { return static_cast<int>(std::lround(double{value} / top_ * (rows_ - 1))); }
    int columnOf(double x) const noexcept { return std::clamp(static_cast<int>(x / length() * width_), 0, width_ - 1); }

    /// Each column shows all its values and the step from the previous value.
    std::vector<std::string> curve() const {
        std::vector<std::string> rows(static_cast<std::size_t>(rows_),
                                      std::string(static_cast<std::size_t>(width_), ' '));
        const auto count = plot_.values.size();
        const auto width = static_cast<std::size_t>(width_);
        std::optional<float> before;
        for (std::size_t column = 0; column < width && count > 0; ++column) {
            const std::size_t from = column * count / width;
            const std::size_t to = std::max(from + 1, (column + 1) * count / width);
            auto low = before;
            auto high = before;
            bool any = false;
            for (std::size_t i = from; i < std::min(to, count); ++i) {
                const float value = plot_.values[i];
                before = isDrawn(value) ? std::optional(value) : std::nullopt;
                if (!before) continue;
                any = true;
                low = std::min(low.value_or(value), value);
                high = std::max(high.value_or(value), value);
            }
            if (!any) continue;
            for (int row = rowOf(*low); row <= rowOf(*high); ++row) rows[static_cast<std::size_t>(row)][column] = '*';
        }
        return rows;
    }

    std::string axis() const {
        const auto left = static_cast<std::size_t>(margin_) + 1;
        std::string line(static_cast<std::size_t>(width_) + 1, '-');
        std::string labels(static_cast<std::size_t>(columns_), ' ');
        line[0] = '+';
        const double every = roundUp(length() / 6, {1, 2, 5});
        const bool hasLength = length() > 0 && std::isfinite(length());
        std::size_t free = 0;  // the first free column in `labels`
        for (int i = 0; hasLength && i * every <= length() * (1 + 1e-9); ++i) {
            // One column to the right of the corner, like the curve.
            const auto at = static_cast<std::size_t>(i == 0 ? 0 : columnOf(i * every) + 1);
            line[at] = '+';
            const auto label = fmt::format("{:g}", i * every);
            const auto centred = left + at - std::min(left + at, label.size() / 2);
            const auto begin = std::min(centred, labels.size() - label.size());
            if (begin < free) continue;
            labels.replace(begin, label.size(), label);
            free = begin + label.size() + 1;
        }
        std::string all = std::string(left, ' ') + line + "\n";
        if (hasLength && plot_.mark >= 0 && plot_.mark <= length()) all += pointer(left);
        return all + trimmedEnd(labels) + "\n" + clipped(std::string(left, ' ') + plot_.xTitle) + "\n";
    }

    /// Draws "^ text", or "text ^" if the first does not fit.
    std::string pointer(std::size_t left) const {
        const auto at = left + 1 + static_cast<std::size_t>(columnOf(plot_.mark));
        const auto& text = plot_.markText;
        if (at + 2 + text.size() <= static_cast<std::size_t>(columns_))
            return trimmedEnd(std::string(at, ' ') + "^ " + text) + "\n";
        if (text.size() + 1 <= at) return std::string(at - text.size() - 1, ' ') + text + " ^\n";
        return std::string(at, ' ') + "^\n";
    }

    std::string clipped(const std::string& text) const {
        return trimmedEnd(text.substr(0, static_cast<std::size_t>(columns_)));
    }
    static std::string trimmedEnd(std::string text) {
        text.erase(text.find_last_not_of(' ') + 1);
        return text;
    }

    const TextPlot& plot_;
    const int columns_;
    const int rows_;
    double top_ = 1;
    std::array<std::string, 3> labels_;
    int margin_ = 0;
    int width_ = 0;
};

}  // namespace

std::string draw(const TextPlot& plot, int columns, int rows) {
    // Done before the texts are placed: replacing control characters later would make a text longer than its place.
    TextPlot harmless = plot;
    for (auto* text : {&harmless.title, &harmless.xTitle, &harmless.markText}) *text = printable(*text);
    return Canvas(harmless, columns, rows).text();
}

}  // namespace tacto::cli
