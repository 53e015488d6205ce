// What going back in a study's ledger gives up, in words.
#include <algorithm>
#include <fmt/ranges.h>
#include <map>

#include "core/study/Study.h"

namespace tacto {

namespace {

/// "4 rows (1 left, 3 session-begun)".
std::string rowsText(std::int64_t lost, const std::vector<std::string>& names) {
    std::map<std::string, int> kinds;
    for (const auto& name : names) ++kinds[name];
    std::vector<std::string> parts;
    for (const auto& [name, count] : kinds) parts.push_back(fmt::format("{} {}", count, name));
    return (lost > 0 ? fmt::format("{} row{}", lost, lost == 1 ? "" : "s") : "rows whose number is not known") +
           (parts.empty() ? std::string() : fmt::format(" ({})", fmt::join(parts, ", ")));
}

}  // namespace

std::string goingBackText(const StudyGoingBack& back) {
    auto text = fmt::format("The study's ledger went back on {} to an older state. Lost: {}", utcText(back.at),
                            rowsText(back.lost, back.rows));
    if (!back.files.empty()) {
        text += fmt::format("; the records of {} session{}, which count nowhere", back.files.size(),
                            back.files.size() == 1 ? "" : "s");
    }
    return text + ".";
}

std::int64_t LedgerLoss::lost() const noexcept {
    return std::max({static_cast<std::int64_t>(rows.size()), newest - row, std::int64_t{0}});
}

std::string LedgerLoss::word() const { return lost() > 0 ? fmt::format("lose-{}-rows", lost()) : "lose-rows"; }

std::string LedgerLoss::sentence() const {
    auto text = fmt::format("this ledger ends with row {} of {}", row, utcText(ends));
    text += newest == 0 ? std::string(", and how far the newest went is not known")
                        : fmt::format("; the newest that is known ended with row {}{}", newest,
                                      newestAt.time_since_epoch().count() > 0 ? " of " + utcText(newestAt) : "");
    text += fmt::format(". Lost with it: {}", rowsText(lost(), rows));
    if (!files.empty()) text += fmt::format("; the records {}, which stay and count nowhere", fmt::join(files, ", "));
    if (!enrolled.empty()) text += fmt::format("; the enrolment of {}", fmt::join(enrolled, ", "));
    if (keysGone > 0)
        text += fmt::format("; {} participants of this ledger have no key any more, as after a withdrawal", keysGone);
    return text + ". Note again by hand the consents, exclusions and events of that time, and who left or withdrew";
}

}  // namespace tacto
