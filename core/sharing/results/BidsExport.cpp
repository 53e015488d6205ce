#include "core/sharing/results/BidsExport.h"

#include "core/sharing/results/StudyResults.h"

namespace tacto {

Result<void> exportBids(Study& study, const BidsWith& with, const std::filesystem::path& out,
                        std::string_view version) {
    const auto record = readStudyRecord(study);
    if (!record) return failure(record);
    const auto files = bidsFiles(sharedStudy(*record), with, version);
    if (!files) return failure(files);
    if (auto free = checkBidsFolder(out); !free) return free;
    if (auto noted = study.exported(std::filesystem::absolute(out), "bids"); !noted) return noted;
    return writeBids(*files, out);
}

}  // namespace tacto
