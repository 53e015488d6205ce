#include "core/study/LedgerEnd.h"

#include <nlohmann/json.hpp>

#include "core/base/Csv.h"
#include "core/base/JsonText.h"
#include "core/base/Text.h"
#include "core/base/WholeFile.h"
#include "core/session/SessionReader.h"
#include "core/study/Gates.h"

namespace tacto {

namespace fs = std::filesystem;

namespace {

std::optional<LedgerEnd> endIn(const nlohmann::json& json) {
    constexpr std::size_t kHashDigits = 64;
    LedgerEnd end;
    end.row = static_cast<std::int64_t>(countOr(json, "row"));
    end.head = textOr(json, "head");
    end.at = std::chrono::sys_seconds(std::chrono::seconds(static_cast<std::int64_t>(countOr(json, "at"))));
    for (const auto& name : valueOr(json, "rows"))
        if (name.is_string()) end.rows.push_back(name.get<std::string>());
    if (end.row < 1 || !isHex(end.head, kHashDigits)) return std::nullopt;
    return end;
}

}  // namespace

void noteLedgerEnd(const fs::path& file, const LedgerEnd& end) {
    const nlohmann::json said{
        {"row", end.row}, {"head", end.head}, {"at", end.at.time_since_epoch().count()}, {"rows", end.rows}};
    static_cast<void>(writeWholeFile(file, dumpJson(said) + '\n'));
    std::error_code ignored;
    fs::permissions(file, fs::perms::owner_read | fs::perms::owner_write, ignored);
    syncFolderOf(file);
}

Result<std::optional<LedgerEnd>> notedLedgerEnd(const fs::path& file) {
    std::error_code error;
    if (fs::symlink_status(file, error).type() == fs::file_type::not_found) return std::nullopt;
    const auto text = readTextFile(file);
    const auto json = text ? parseJson(*text, file.string()) : failure(text);
    if (auto end = json ? endIn(*json) : std::nullopt) return end;
    return fail(kGateRefused, "{} does not say how far the study's ledger goes", file.string());
}

std::optional<LedgerEnd> ledgerEndOf(const fs::path& session) {
    const auto reader = SessionReader::open(session);
    const auto events = reader ? reader->events() : Result<std::vector<SessionRow>>(failure(reader));
    if (!events) return std::nullopt;  // what cannot be read is found elsewhere
    for (const auto& row : *events)
        if (row.name == kLedgerEvent) return endIn(row.body);
    return std::nullopt;
}

bool reaches(const SessionReader& ledger, const LedgerEnd& end) {
    const auto hash = ledger.hashOf(end.row);
    return hash && *hash == end.head;
}

}  // namespace tacto
