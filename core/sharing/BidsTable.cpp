#include "core/sharing/BidsTable.h"

#include <cassert>
#include <cmath>
#include <fmt/format.h>

namespace tacto {

namespace {

constexpr std::string_view kMissing = "n/a";

/// A tab or a line's end in a text would begin another cell.
std::string oneCell(std::string_view value) {
    if (value.empty()) return std::string(kMissing);
    std::string out(value);
    for (char& c : out) {
        if (static_cast<unsigned char>(c) < ' ') c = ' ';
    }
    return out;
}

}  // namespace

BidsCell::BidsCell(double value) : text(std::isfinite(value) ? fmt::format("{:.6g}", value) : std::string(kMissing)) {}
BidsCell::BidsCell(std::size_t value) : text(fmt::format("{}", value)) {}
BidsCell::BidsCell(bool value) : text(value ? "true" : "false") {}
BidsCell::BidsCell(std::string_view value) : text(oneCell(value)) {}
BidsCell::BidsCell(std::optional<int> value) : text(value ? fmt::format("{}", *value) : std::string(kMissing)) {}
BidsCell::BidsCell(std::optional<bool> value) : text(!value ? kMissing : *value ? "true" : "false") {}

void BidsTable::add(std::vector<BidsCell> cells) {
    assert(cells.size() == columns_.size());
    rows_.push_back(std::move(cells));
}

std::string BidsTable::tsv() const {
    std::string out;
    for (const auto& column : columns_) out += (&column == &columns_.front() ? "" : "\t") + column.name;
    out += '\n';
    for (const auto& row : rows_) {
        for (const auto& cell : row) out += (&cell == &row.front() ? "" : "\t") + cell.text;
        out += '\n';
    }
    return out;
}

nlohmann::json BidsTable::sidecar() const {
    auto out = nlohmann::json::object();
    for (const auto& column : columns_) {
        nlohmann::json about{{"Description", column.description}};
        if (!column.units.empty()) about["Units"] = column.units;
        for (const auto& [level, meaning] : column.levels) about["Levels"][level] = meaning;
        out[column.name] = std::move(about);
    }
    return out;
}

}  // namespace tacto
