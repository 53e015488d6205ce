// BidsTable.h - one table of a BIDS dataset (tab-separated values) and its sidecar, which explains the columns.
#pragma once

#include <initializer_list>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/Units.h"
#include "core/sharing/BidsStudy.h"

namespace tacto {

/// The text of a cell: n/a for NaN, an empty text or a missing value.
struct BidsCell {
    std::string text;

    BidsCell(double value);
    BidsCell(std::size_t value);
    BidsCell(bool value);
    BidsCell(std::string_view value);
    BidsCell(const std::string& value) : BidsCell(std::string_view(value)) {}
    BidsCell(const char* value) : BidsCell(std::string_view(value)) {}
    BidsCell(std::optional<int> value);
    BidsCell(std::optional<bool> value);
    BidsCell(Milliamps value) : BidsCell(value.value()) {}
    BidsCell(Volts value) : BidsCell(value.value()) {}
    BidsCell(Ohms value) : BidsCell(value.value()) {}
};

struct BidsColumn {
    std::string name;
    std::string description;
    std::string units{};                                        ///< SI; empty for a column without unit
    std::vector<std::pair<std::string, std::string>> levels{};  ///< the words of the column, each with its meaning
};

class BidsTable {
public:
    explicit BidsTable(std::vector<BidsColumn> columns) : columns_(std::move(columns)) {}

    /// The number of cells must equal the number of columns.
    void add(std::initializer_list<BidsCell> cells) { add(std::vector<BidsCell>(cells)); }
    void add(std::vector<BidsCell> cells);
    [[nodiscard]] bool isEmpty() const noexcept { return rows_.empty(); }
    [[nodiscard]] std::string tsv() const;
    /// Returns description, units and levels of each column.
    [[nodiscard]] nlohmann::json sidecar() const;

private:
    std::vector<BidsColumn> columns_;
    std::vector<std::vector<BidsCell>> rows_;
};

// The tables of one session: trials, thresholds, ratings, side effects. With a massager they contain intensities and
// the measured vibration instead of currents, voltages and impedances.

[[nodiscard]] BidsTable identificationTable(const BidsSession& session, bool massager);
[[nodiscard]] BidsTable thresholdsTable(const BidsSession& session, bool massager);
[[nodiscard]] BidsTable ratingsTable(const BidsSession& session);
[[nodiscard]] BidsTable sideEffectsTable(const BidsSession& session, bool massager);

}  // namespace tacto
