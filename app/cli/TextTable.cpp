#include "app/cli/TextTable.h"

#include <algorithm>

#include "app/cli/Say.h"

namespace tacto::cli {

namespace {

/// Counts characters, not bytes.
std::size_t lengthOf(const std::string& text) {
    return static_cast<std::size_t>(std::ranges::count_if(text, [](char c) { return (c & 0xC0) != 0x80; }));
}

}  // namespace

TextTable::TextTable(std::vector<std::string> headings) {
    for (auto& heading : headings) {
        toTheRight_.push_back(heading.starts_with('>'));
        if (toTheRight_.back()) heading.erase(0, 1);
    }
    if (std::ranges::any_of(headings, [](const auto& heading) { return !heading.empty(); })) add(std::move(headings));
    hasHeadings_ = !rows_.empty();
}

void TextTable::add(std::vector<std::string> cells) {
    for (auto& cell : cells) cell = printable(cell);
    cells.resize(toTheRight_.size());
    rows_.push_back(std::move(cells));
}

void TextTable::addLine(const std::string& line) { rows_.push_back({printable(line)}); }

void TextTable::print() const {
    std::vector<std::size_t> widths(toTheRight_.size());
    for (const auto& row : rows_) {
        if (row.size() != widths.size()) continue;
        for (std::size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], lengthOf(row[c]));
    }
    if (hasHeadings_) say("\n");
    for (const auto& row : rows_) {
        if (row.size() != widths.size()) {
            say("  {}\n", row.front());
            continue;
        }
        std::string line;
        for (std::size_t c = 0; c < row.size(); ++c) {
            const std::string blanks(widths[c] - lengthOf(row[c]), ' ');
            line += "  " + (toTheRight_[c] ? blanks + row[c] : row[c] + blanks);
        }
        line.erase(line.find_last_not_of(' ') + 1);
        say("{}\n", line);
    }
}

}  // namespace tacto::cli
