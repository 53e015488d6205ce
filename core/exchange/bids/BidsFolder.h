// BidsFolder.h - what the files of an exported BIDS dataset share: its labels, the beginning of each sidecar, and words
// of our sessions in BIDS's own.
//
// Thread-safety: as ExportSource.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "core/exchange/ExportSource.h"
#include "core/sharing/BidsTable.h"

namespace tacto {

class BidsFolder {
public:
    BidsFolder(const ExportSource& source, std::filesystem::path root);

    /// "sim" if a device was simulated, "bench" on a load, else the participant outside a study or "participant".
    [[nodiscard]] const std::string& label() const noexcept { return label_; }
    [[nodiscard]] std::string subject() const { return "sub-" + label_; }
    /// The path of "DATATYPE/sub-LL_task-PROTOCOL_SUFFIX", whose folder is made. Errors: Io.
    [[nodiscard]] Result<std::filesystem::path> path(std::string_view datatype, std::string_view suffix) const;
    /// What every sidecar says: task, whether simulated, marks, session and chain head.
    [[nodiscard]] nlohmann::json sidecar(bool simulated) const;

    /// `path`: within the dataset, or one that path() made. Errors: Io.
    [[nodiscard]] Result<void> writeText(const std::filesystem::path& path, std::string_view text) const;
    [[nodiscard]] Result<void> writeJson(const std::filesystem::path& path, const nlohmann::json& value) const;

private:
    const ExportSource& source_;
    const std::filesystem::path root_;
    std::string label_, task_;
};

/// Keeps letters and digits; `otherwise` if there are none.
[[nodiscard]] std::string bidsLabelOf(std::string_view text, std::string_view otherwise);
/// Returns a unit as BIDS writes it: "m/s^2" for "m/s2".
[[nodiscard]] std::string bidsUnit(std::string_view unit);
/// Returns the column of a table of the session. Numbers have a unit, 1 if no other: what has one is a number in BIDS.
[[nodiscard]] BidsColumn bidsColumn(const ResultColumn& column);

}  // namespace tacto
