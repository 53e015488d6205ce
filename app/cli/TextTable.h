// TextTable.h - a table for the terminal: each column as wide as what stands in it.
//
// Thread-safety: none; one owner.
#pragma once

#include <string>
#include <vector>

namespace tacto::cli {

class TextTable {
public:
    /// A heading that begins with '>' stands to the right with its column, as numbers do; the mark is not printed.
    /// Headings that are all empty are not printed.
    explicit TextTable(std::vector<std::string> headings);
    /// There must be as many cells as headings.
    void add(std::vector<std::string> cells);
    /// A line between two rows, as wide as it is.
    void addLine(const std::string& line);
    /// Prints the headings, too, after an empty line.
    void print() const;

private:
    bool hasHeadings_ = false;
    std::vector<bool> toTheRight_;
    std::vector<std::vector<std::string>> rows_;  ///< printable; the headings first, a line as a row of one cell
};

}  // namespace tacto::cli
