#include "core/study/LedgerEnd.h"

#include <nlohmann/json.hpp>

#include "core/base/Csv.h"
#include "core/base/JsonFields.h"
#include "core/base/WholeFile.h"
#include "core/session/Durable.h"
#include "core/session/SessionReader.h"
#include "core/study/Gates.h"

namespace tacto {

namespace fs = std::filesystem;

void noteLedgerEnd(const fs::path& file, const LedgerEnd& end) {
    static_cast<void>(writeWholeFile(file, dumpJson({{"row", end.row}, {"head", end.head}}) + '\n'));
    syncFolderOf(file);
}

Result<void> reachesEnd(const SessionReader& ledger, const fs::path& file) {
    std::error_code error;
    if (fs::symlink_status(file, error).type() == fs::file_type::not_found) return {};
    const auto text = readTextFile(file);
    const auto json = text ? parseJson(*text, file.string()) : failure(text);
    const auto row = json ? static_cast<std::int64_t>(countOr(*json, "row")) : 0;
    const auto head = json ? textOr(*json, "head") : std::string();
    if (row < 1 || head.empty()) {
        return fail(kGateRefused, "{} does not say how far the study's ledger goes; put it back from your copy",
                    file.string());
    }
    if (const auto hash = ledger.hashOf(row); hash && *hash == head) return {};
    return fail(kGateRefused,
                "row {} of the study's ledger is not the one that was written on this computer: the ledger was cut "
                "short or recomputed, or is an older copy; put back the newest",
                row);
}

}  // namespace tacto
