// BidsFiles.h - a study as a BIDS 1.11.1 dataset of behavioural files (https://bids-specification.readthedocs.io).
//
// Each file has a sidecar that describes its columns; missing values are n/a; there are no dates, and no `onset` or
// `duration` (which would make the trials `_events.tsv`). Labels are in random order, the same in each export, and stay
// if more participants are enrolled. Questionnaires are behavioural files: `phenotype/` allows one row per person.
//
// Thread-safety: pure functions, except for writeBids(), which writes a folder.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/Result.h"
#include "core/sharing/BidsStudy.h"

namespace tacto {

/// Personal data that are exported on request only, in addition to the group.
struct BidsWith {
    bool age = false, sex = false, handedness = false;
};
/// Fewer people than this must not share what an export says of their age, sex and handedness together: in a study of
/// three to five people, each could be told by someone who knows them.
inline constexpr std::size_t kMinAlike = 3;

struct BidsAbout {
    std::string age, sex, handedness;
    bool operator==(const BidsAbout&) const = default;
};
/// What of it may be published.
struct SharedAbout {
    BidsWith columns;               ///< as asked for, without what had to be withheld
    std::vector<BidsAbout> people;  ///< in the order given; ages as ranges of years, "20-39" or, from 89 on, "80+"
    std::string withheld;           ///< one sentence without its full stop; empty if nothing is
};
/// Ages become ranges, as narrow as is possible, of 10, 20 or 40 years or one range for all; what kMinAlike people do
/// not share is withheld. `people` without the virtual participants, who have none.
[[nodiscard]] SharedAbout sharedAbout(std::vector<BidsAbout> people, const BidsWith& asked);
/// Parses a list of any of these words: "age,sex,handedness". Errors: InvalidArgument naming any other word.
[[nodiscard]] Result<BidsWith> bidsWithFrom(std::string_view list);

struct BidsFile {
    std::string path;  ///< within the dataset, "sub-02/sub-02_sessions.tsv"
    std::string text;
};

/// Returns what dataset_description.json says of every dataset of this program. `license` may be empty.
[[nodiscard]] nlohmann::json bidsDescription(std::string_view name, std::string_view license, std::string_view version);

/// Returns the label of the `enrolled`-th participant (from 1), "03". Errors: InvalidArgument if that or places is 0.
[[nodiscard]] Result<std::string> bidsLabel(const BidsStudy& study, std::size_t enrolled);

/// Returns all files, in the order of their paths. `version` is the program's version. Errors: InvalidArgument if a
/// participant or session has the number 0 or another's number.
[[nodiscard]] Result<std::vector<BidsFile>> bidsFiles(const BidsStudy& study, const BidsWith& with,
                                                      std::string_view version);

/// Errors: InvalidArgument for a folder that is not empty, or a path that is not a folder.
[[nodiscard]] Result<void> checkBidsFolder(const std::filesystem::path& folder);

/// Writes `files` to `folder`, which must be new or empty. Errors: as checkBidsFolder(); Io.
[[nodiscard]] Result<void> writeBids(const std::vector<BidsFile>& files, const std::filesystem::path& folder);

}  // namespace tacto
