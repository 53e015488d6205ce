// BidsFiles.h - a study as a BIDS 1.11.1 dataset of behavioural files (https://bids-specification.readthedocs.io).
//
// Every column is in its file's sidecar, missing values are n/a, there is neither `onset` nor `duration` (they would
// make the trials `_events.tsv`), and nothing is dated. Labels are in random order, the same at each export, and stay
// when more participants are enrolled. Questionnaires are behavioural files, because `phenotype/` has one row a person.
//
// Thread-safety: pure functions, but for writeBids(), which writes a folder.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/Result.h"
#include "core/sharing/BidsStudy.h"

namespace tacto {

/// The personal data exported besides the group, only when they are asked for.
struct BidsWith {
    bool age = false, sex = false, handedness = false;
};
/// "age,sex,handedness", any of them. Errors: InvalidArgument naming any other word.
[[nodiscard]] Result<BidsWith> bidsWithFrom(std::string_view list);

struct BidsFile {
    std::string path;  ///< the path within the dataset, "sub-02/sub-02_sessions.tsv"
    std::string text;
};

/// The label of the `enrolled`-th participant (from 1): "03". Errors: InvalidArgument for 0, of which or of places.
[[nodiscard]] Result<std::string> bidsLabel(const BidsStudy& study, std::size_t enrolled);

/// All files, in the order of their paths. `version` is the program's. Errors: InvalidArgument for a participant or a
/// session whose number is 0 or comes twice.
[[nodiscard]] Result<std::vector<BidsFile>> bidsFiles(const BidsStudy& study, const BidsWith& with,
                                                      std::string_view version);

/// Errors: InvalidArgument for a folder that is not empty, or a path that is not a folder.
[[nodiscard]] Result<void> checkBidsFolder(const std::filesystem::path& folder);

/// Writes them to `folder`, which is new or empty. Errors: as checkBidsFolder(); Io.
[[nodiscard]] Result<void> writeBids(const std::vector<BidsFile>& files, const std::filesystem::path& folder);

}  // namespace tacto
