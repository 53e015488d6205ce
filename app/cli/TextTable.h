// TextTable.h - a table for the terminal; each column is as wide as its contents.
//
// Thread-safety: none; one owner.
#pragma once

#include <string>
#include <vector>

namespace tacto::cli {

class TextTable {
public:
    /// A heading that begins with '>' (not printed) aligns its column to the right, as for numbers. If all headings are
    /// empty, none are printed.
    explicit TextTable(std::vector<std::string> headings);
    /// `cells` must have as many entries as there are headings.
    void add(std::vector<std::string> cells);
    /// Adds a line between two rows; it does not change the column widths.
    void addLine(const std::string& line);
    /// Prints the table after an empty line, with the headings.
    void print() const;

private:
    bool hasHeadings_ = false;
    std::vector<bool> toTheRight_;
    std::vector<std::vector<std::string>> rows_;  ///< printable; the headings come first; a line is a row with one cell
};

}  // namespace tacto::cli
