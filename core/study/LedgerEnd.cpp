#include "core/study/LedgerEnd.h"

#include <algorithm>
#include <fmt/ranges.h>
#include <map>
#include <nlohmann/json.hpp>

#include "core/base/Csv.h"
#include "core/base/JsonText.h"
#include "core/base/LocaleFreeText.h"
#include "core/base/WholeFile.h"
#include "core/session/SessionReader.h"
#include "core/study/Gates.h"
#include "core/study/Study.h"

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
    if (!events) return std::nullopt;  // other checks report an unreadable file
    for (const auto& row : *events)
        if (row.name == kLedgerEvent) return endIn(row.body);
    return std::nullopt;
}

bool reaches(const SessionReader& ledger, const LedgerEnd& end) {
    const auto hash = ledger.hashOf(end.row);
    return hash && *hash == end.head;
}

namespace {

/// Returns text such as " (1 left, 3 session-begun)"; empty if there are no names.
std::string kindsText(const std::vector<std::string>& names) {
    std::map<std::string, int> kinds;
    for (const auto& name : names) ++kinds[name];
    std::vector<std::string> parts;
    for (const auto& [name, count] : kinds) parts.push_back(fmt::format("{} {}", count, name));
    return parts.empty() ? std::string() : fmt::format(" ({})", fmt::join(parts, ", "));
}

std::string countText(std::int64_t rows) { return fmt::format("{} row{}", rows, rows == 1 ? "" : "s"); }

/// Returns text such as "4 rows (1 left, 3 session-begun)"; "nothing" if no row is lost and others are taken over.
std::string rowsText(std::int64_t lost, const std::vector<std::string>& names, bool takesOthers) {
    if (lost <= 0 && takesOthers) return "nothing";
    return (lost > 0 ? countText(lost) : "rows whose number is not known") + kindsText(names);
}

std::string takenText(const std::vector<std::string>& unsealed) {
    if (unsealed.empty()) return {};
    return fmt::format("; taken over: {} not written with the study's key{}", countText(std::ssize(unsealed)),
                       kindsText(unsealed));
}

}  // namespace

std::string goingBackText(const StudyGoingBack& back) {
    auto text = fmt::format("The study's ledger went back on {} to an older state. Lost: {}", utcText(back.at),
                            rowsText(back.lost, back.rows, !back.unsealed.empty()));
    if (!back.files.empty()) {
        text += fmt::format("; the records of {} session{}, which count nowhere", back.files.size(),
                            back.files.size() == 1 ? "" : "s");
    }
    return text + takenText(back.unsealed) + ".";
}

std::int64_t LedgerLoss::lost() const noexcept {
    return std::max({static_cast<std::int64_t>(rows.size()), newest - row, std::int64_t{0}});
}

std::string LedgerLoss::word() const {
    if (lost() > 0) return fmt::format("lose-{}-rows", lost());
    return unsealed.empty() ? "lose-rows" : fmt::format("take-{}-rows", unsealed.size());
}

std::string LedgerLoss::sentence() const {
    auto text = fmt::format("this ledger ends with row {} of {}", row, utcText(ends));
    text += newest == 0 ? std::string(", and how far the newest went is not known")
                        : fmt::format("; the newest that is known ended with row {}{}", newest,
                                      newestAt.time_since_epoch().count() > 0 ? " of " + utcText(newestAt) : "");
    text += fmt::format(". Lost with it: {}", rowsText(lost(), rows, !unsealed.empty()));
    if (!files.empty()) text += fmt::format("; the records {}, which stay and count nowhere", fmt::join(files, ", "));
    if (!enrolled.empty()) text += fmt::format("; the enrolment of {}", fmt::join(enrolled, ", "));
    if (keysGone > 0)
        text += fmt::format("; {} participants of this ledger have no key any more, as after a withdrawal", keysGone);
    text += takenText(unsealed);
    if (withdrawn > 0)
        text += fmt::format("; the keys of {} participants who withdrew by this ledger, and all records of theirs",
                            withdrawn);
    return text + ". Note again by hand the consents, exclusions and events of that time, and who left or withdrew";
}

}  // namespace tacto
